use magworm::lanes::Scalar;
use magworm::model::Model;
use magworm::reset::{Draws, reset, scene_start};
use magworm::scene::Scene;
use magworm::state::Block;
use magworm::step::advance;

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let heights: Vec<f64> = (-4..=4).map(|k| -0.022 + 1e-4 * f64::from(k)).collect();
    for edits in args[1..].iter() {
        let mut out = vec![];
        for &y in &heights {
            let mut all = vec![(
                "drive.motion".to_string(),
                Some(format!("{{kind='constant',x_m=-0.05,y_m={y},speed_m_s=0.1}}")),
            )];
            for edit in edits.split(';').filter(|e| !e.is_empty()) {
                let (k, v) = edit.split_once('=').unwrap();
                all.push((k.to_string(), Some(v.to_string())));
            }
            let edits: Vec<(String, Option<toml::Value>)> = all
                .into_iter()
                .map(|(k, v)| {
                    (
                        k,
                        v.map(|v| {
                            toml::from_str::<toml::Table>(&format!("x = {v}")).unwrap()["x"].clone()
                        }),
                    )
                })
                .collect();
            let scene = Scene::preset("paper-3").unwrap().with_values(&edits).unwrap();
            let model = Model::compile(&scene).unwrap();
            let mut block = Block::<1>::new(&model);
            reset(
                &model,
                &mut block,
                0,
                scene_start(&model),
                &[1.0; 7],
                &[true; 3],
                Draws::new(0, 0),
            );
            let rest = block.planar_pose(&model, 1, 0)[1];
            let start = block.planar_pose(&model, 2, 0)[0];
            let (mut peak, mut roll) = (0.0f64, 0.0f64);
            let mut most = 0;
            for _ in 0..(1.5 / model.step_s).round() as u32 {
                let b = block.counters.solves;
                advance(Scalar, &model, &mut block, 1);
                most = most.max(block.counters.solves - b);
                peak = peak.max(block.planar_pose(&model, 1, 0)[1] - rest);
                roll = roll.max(block.magnet_pose(&model, 1, 0).roll_rad().abs());
            }
            let c = block.counters;
            let n = c.steps as f64;
            let yaw = block.robot_pose(&model, 0)[2].to_degrees();
            out.push((
                1e3 * (start - block.planar_pose(&model, 2, 0)[0]),
                1e3 * peak,
                roll,
                c.solves as f64 / n,
                c.factorisations as f64 / n,
                c.divided,
                most,
                yaw,
            ));
        }
        let mean: f64 = out.iter().map(|o| o.0).sum::<f64>() / 9.0;
        println!(
            "{edits}: mean {mean:.4} mid {:.4} peak {:.4} roll {:.1e} yaw {:.4} solves {:.2} fac {:.2} div {} most {}  all {:?}",
            out[4].0,
            out[4].1,
            out[4].2,
            out[4].7,
            out[4].3,
            out[4].4,
            out[4].5,
            out[4].6,
            out.iter().map(|o| (o.0 * 1e3).round() / 1e3).collect::<Vec<_>>()
        );
    }
}
