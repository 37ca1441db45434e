use magworm::model::Model;
use magworm::scene::Scene;
use magworm::state::*;
use std::sync::Arc;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let mut sets: Vec<(String, Option<toml::Value>)> = vec![];
    for a in &args[2..] {
        let (k, v) = a.split_once('=').unwrap();
        let t: toml::Table = format!("v = {v}").parse().unwrap();
        sets.push((k.to_string(), Some(t["v"].clone())));
    }
    let scene = Scene::preset("paper-3").unwrap().with_values(&sets).unwrap();
    let m: toml::Table = if args[1] == "lift" {
        "kind='waypoints'\ntime_s=[0.0,0.5]\nx_m=[0.027,0.027]\ny_m=[-0.052,-0.022]"
    } else {
        "kind='constant'\nx_m=-0.05\ny_m=-0.022\nspeed_m_s=0.1"
    }
    .parse()
    .unwrap();
    let scene =
        scene.with_values(&[("drive.motion".to_string(), Some(toml::Value::Table(m)))]).unwrap();
    let model = Arc::new(Model::compile(&scene).unwrap());
    println!(
        "dofs {} hb {} nodes {}",
        model.coordinates.count,
        model.band.half_bandwidth(),
        model.nodes()
    );
    let mut b = Batch::new(model.clone(), 1, LaneChoice::Scalar, Some(1));
    b.reset(0, 0, 0, None);
    let t_end = if args[1] == "lift" { 0.8 } else { 1.5 };
    let n = (t_end / model.step_s) as u32;
    let chunk = n / 30;
    let mut peak = 0f64;
    let y0 = b.view(0, |v| v.magnet_pose(1)[1]);
    let x0 = b.view(0, |v| v.centre_x_m());
    let t = std::time::Instant::now();
    for k in 0..n {
        b.advance(1);
        b.view(0, |v| {
            let p: Vec<_> = (0..model.magnets()).map(|j| v.magnet_pose(j)).collect();
            peak = peak.max(p[1][1] - y0);
            if k % chunk == chunk - 1 {
                println!(
                    "t {:.3} drive {:?} c {:.3} st {:?} | {}",
                    v.time_s(),
                    v.drive_m(0).map(|d| (d[0] * 1e3).round()),
                    (v.centre_x_m() - x0) * 1e3,
                    v.status(),
                    p.iter()
                        .map(|q| format!(
                            "({:.2} {:.2} {:.1}°)",
                            q[0] * 1e3,
                            q[1] * 1e3,
                            q[2].to_degrees()
                        ))
                        .collect::<Vec<_>>()
                        .join(" ")
                        + " "
                        + &(0..model.contacts.len())
                            .map(|c| format!(
                                "{:.0}:{:.1}",
                                v.contact(c)[0],
                                v.contact(c)[1] / model.step_s * 1e3
                            ))
                            .collect::<Vec<_>>()
                            .join(" ")
                );
            }
        });
    }
    let c = b.counters();
    println!(
        "peak {:.3} mm stride {:.3} mm  {:?} {:.2?} solves/step {:.2}",
        peak * 1e3,
        -(b.view(0, |v| v.centre_x_m()) - x0) * 1e3,
        c,
        t.elapsed(),
        c.solves as f64 / c.steps as f64
    );
}
