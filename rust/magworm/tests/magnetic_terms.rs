//! Terms of the magnetic wrench, their factors in each environment, and the models of body magnets that act on each other.

mod base;

use base::base;
use magworm::internals::Draws;
use magworm::internals::lanes::{Space, Vector};
use magworm::internals::magnetic::{FarPair, MU_0, Magnet, SpatialPair, orders_by_distance};
use magworm::scene::{Parameter, Scene};
use magworm::{Batch, LaneChoice, Model};
use nalgebra::{Unit, UnitQuaternion, Vector3};
use std::sync::Arc;
use toml::Value;

/// Each term with the parameter that is a factor of it.
const TERMS: [(&str, Parameter); 4] = [
    ("horizontal_force", Parameter::HorizontalForce),
    ("vertical_force", Parameter::VerticalForce),
    ("torque", Parameter::Torque),
    ("mutual", Parameter::Mutual),
];

/// A pass beneath a robot whose magnets act on each other, with one term left out.
fn pass(dimensions: i64, without: Option<&str>) -> Scene {
    let motion = "{ kind = 'constant', x_m = -0.02, y_m = -0.022, speed_m_s = 0.2 }";
    let mut values = vec![
        ("dimensions".to_string(), Some(Value::from(dimensions))),
        ("drive.motion".to_string(), Some(motion.parse().expect("TOML"))),
        ("magnetic_terms.mutual".to_string(), Some(true.into())),
    ];
    values.extend(without.map(|term| (format!("magnetic_terms.{term}"), Some(false.into()))));
    base("robot").with_values(&values).expect("a scene")
}

fn batch(scene: &Scene, count: usize) -> Batch {
    let model = Arc::new(Model::compile(scene).expect("a model"));
    Batch::new(model, count, LaneChoice::Wide, Some(1))
}

/// Places of all nodes, bit for bit, where zeros have no sign.
fn nodes(batch: &Batch, environment: usize) -> Vec<u64> {
    batch.view(environment, |view| {
        let places = (0..batch.model().nodes()).flat_map(|node| view.node_m(node));
        places.map(|place| (place + 0.0).to_bits()).collect()
    })
}

/// Goes on for a fifth of a second.
fn run(mut batch: Batch) -> Batch {
    (0..batch.count()).for_each(|environment| batch.reset(environment, 0, 0, None));
    let steps = (0.2 / batch.model().step_s).round() as u32;
    batch.advance(steps);
    batch
}

#[test]
fn environments_with_factors_of_0_are_scenes_with_terms_off() {
    for dimensions in [2, 3] {
        let mut factors = batch(&pass(dimensions, None), 1 + TERMS.len());
        for (place, (_, parameter)) in TERMS.into_iter().enumerate() {
            let row = (1 + place) * Model::PARAMETERS.len();
            factors.factors_mut()[row + parameter as usize] = 0.0;
        }
        let factors = run(factors);
        let whole = nodes(&factors, 0);
        assert_eq!(whole, nodes(&run(batch(&pass(dimensions, None), 1)), 0));
        for (place, (term, _)) in TERMS.into_iter().enumerate() {
            let off = run(batch(&pass(dimensions, Some(term)), 1));
            let found = nodes(&factors, 1 + place);
            assert_eq!(found, nodes(&off, 0), "{term} in {dimensions} dimensions");
            assert_ne!(found, whole, "{term} in {dimensions} dimensions");
        }
    }
}

#[test]
fn a_factor_between_0_and_1_is_a_part_of_the_wrench() {
    let wrenches = |factor: f64| {
        let mut batch = batch(&pass(2, None), 1);
        batch.factors_mut()[Parameter::Mutual as usize] = factor;
        batch.reset(0, 0, 0, None);
        batch.view(0, |view| view.magnet_wrenches())
    };
    let [none, quarter, whole] = [0.0, 0.25, 1.0].map(wrenches);
    let mutual = |found: &[f64], k: usize| found[k] - none[k];
    assert!((0..whole.len()).any(|k| mutual(&whole, k).abs() > 1e-3));
    for k in 0..whole.len() {
        let error = mutual(&quarter, k) - 0.25 * mutual(&whole, k);
        assert!(error.abs() <= 1e-15, "{k}: {error:e}");
    }
}

#[test]
fn a_term_that_is_left_out_is_not_varied() {
    let vary = "[{ parameter = 'mutual', low = 0.5, high = 1 }]".parse().expect("TOML");
    let values = [("reset.vary".to_string(), Some(vary))];
    let error = base("robot").with_values(&values);
    assert_eq!(
        error.expect_err("no such term").to_string(),
        "reset.vary[0].parameter is \"mutual\"; allowed: a term that acts: magnetic_terms.mutual is false"
    );
}

#[test]
fn a_magnet_that_is_lost_is_in_no_pair() {
    let mut batch = batch(&pass(2, None), 2);
    let last = 2 * batch.model().magnets() - 1;
    batch.present_mut()[last] = false;
    // Of the drive nothing is felt.
    for term in [Parameter::HorizontalForce, Parameter::VerticalForce, Parameter::Torque] {
        let parameters = Model::PARAMETERS.len();
        batch.factors_mut()[term as usize] = 0.0;
        batch.factors_mut()[parameters + term as usize] = 0.0;
    }
    (0..2).for_each(|environment| batch.reset(environment, 0, 0, None));
    let [whole, damaged] = [0, 1].map(|k| batch.view(k, |view| view.magnet_wrenches()));
    // The middle one is drawn to both sides alike; one of the outer ones alone draws it to its own.
    assert!(whole[3].abs() < 1e-9 && (damaged[3] + 11.442e-3).abs() < 2e-5, "{damaged:?}");
    assert_eq!(damaged[6..], [0.0; 3]);
}

#[test]
fn a_scene_says_how_many_pairs_are_near() {
    let model = Model::compile(&pass(2, None)).expect("a model");
    let text = model.explain();
    let line = text.lines().find(|line| line.starts_with("mutual")).expect("a line");
    assert!(line.contains("2 near pairs, cuboids of order 3 or less"), "{line}");
    let off = Model::compile(&pass(2, Some("mutual"))).expect("a model").explain();
    assert!(off.contains("left out: magnetic_terms.mutual is false"), "{off}");
}

/// A magnet of 1 T with edges of up to 1 : 8, and a direction along one of them or oblique.
fn magnet(numbers: &mut impl FnMut() -> f64) -> Magnet {
    let mut edge_m = || 1e-3 * (8f64.ln() * numbers()).exp();
    let size_m = Vector3::new(edge_m(), edge_m(), edge_m());
    let direction = match (4.0 * numbers()) as usize {
        0 => Vector3::x(),
        1 => Vector3::y(),
        2 => Vector3::z(),
        _ => direction(numbers),
    };
    Magnet { size_m, remanence_t: direction }
}

fn direction(numbers: &mut impl FnMut() -> f64) -> Vector3<f64> {
    let (height, turn) = (2.0 * numbers() - 1.0, std::f64::consts::TAU * numbers());
    let flat = (1.0 - height * height).sqrt();
    Vector3::new(flat * turn.cos(), height, flat * turn.sin())
}

/// Two magnets in a random relation at a distance, and the force of one on the other with so many points an edge [N].
struct Pair {
    source: Magnet,
    target: Magnet,
    turn: UnitQuaternion<f64>,
    way: Vector3<f64>,
}

impl Pair {
    fn random(numbers: &mut impl FnMut() -> f64) -> Self {
        let (source, target) = (magnet(numbers), magnet(numbers));
        let axis = Unit::new_normalize(direction(numbers));
        let turn = UnitQuaternion::from_axis_angle(&axis, std::f64::consts::TAU * numbers());
        Self { source, target, turn, way: direction(numbers) }
    }

    fn force_n(&self, order: usize, distance_m: f64) -> Vector3<f64> {
        let axes = self.turn.to_rotation_matrix();
        let axes = [0, 1, 2].map(|k| axes.matrix().column(k).into_owned().into());
        let offset = (self.way * distance_m).into();
        let wrench = SpatialPair::new(&self.source, &self.target, order).wrench(offset, axes);
        Vector3::from_column_slice(&wrench[..3])
    }

    /// Force of two dipoles in line at that distance, the greatest there is.
    fn in_line_n(&self, distance_m: f64) -> f64 {
        let volumes = self.source.size_m.product() * self.target.size_m.product();
        6.0 * volumes / (4.0 * std::f64::consts::PI * MU_0) / distance_m.powi(4)
    }
}

/// Random numbers in [0, 1).
fn numbers() -> impl FnMut() -> f64 {
    let mut draws = Draws::new(16, 0);
    move || draws.uniform(0.0, 1.0)
}

#[test]
fn dipoles_are_off_by_no_more_than_their_bound() {
    let mut numbers = numbers();
    let mut closest: f64 = 0.0;
    for _ in 0..300 {
        let pair = Pair::random(&mut numbers);
        let touching_m = 0.5 * (pair.source.size_m.norm() + pair.target.size_m.norm());
        let distance_m = touching_m * (1.5 + 4.0 * numbers());
        let far = FarPair::new(&pair.source, &pair.target);
        let offset = Vector((pair.way * distance_m).into());
        let [a, b] = [pair.source.remanence_t, pair.turn * pair.target.remanence_t]
            .map(|direction| Vector(direction.into()));
        let (force, _) = far.wrench::<Space, f64>(offset, a, b, 1.0);
        let error_n = (Vector3::from(force.0) - pair.force_n(10, distance_m)).norm();
        let bound_n = far.error_n_t2(&pair.source, &pair.target, distance_m);
        assert!(error_n <= bound_n, "{error_n:e} N beyond {bound_n:e} N at {distance_m} m");
        closest = closest.max(error_n / bound_n);
    }
    // A bound that says something.
    assert!(closest > 0.2, "{closest}");
}

#[test]
fn orders_are_enough_from_their_distance_on() {
    let mut numbers = numbers();
    for _ in 0..200 {
        let pair = Pair::random(&mut numbers);
        let touching_m = 0.5 * (pair.source.size_m.norm() + pair.target.size_m.norm());
        for (order, from_m) in orders_by_distance(&pair.source, &pair.target) {
            let distance_m = from_m.max(1.02 * touching_m);
            let exact = pair.force_n(10, distance_m);
            let error_n = (pair.force_n(order, distance_m) - exact).norm();
            let share = error_n / pair.in_line_n(distance_m);
            assert!(share <= 2e-3, "order {order} at {distance_m} m: {share:e}");
        }
    }
}
