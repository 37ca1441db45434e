//! Named bits.

use magworm::{Model, View};

/// What can be seen of one environment after a control step.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Record(pub Vec<(&'static str, u64)>);

impl Record {
    /// Adds numbers by their bits.
    pub fn add(&mut self, name: &'static str, values: &[f64]) {
        self.0.extend(values.iter().map(|value| (name, value.to_bits())));
    }

    /// Adds single-precision numbers by the bits of their values.
    pub fn add_f32(&mut self, name: &'static str, values: &[f32]) {
        self.0.extend(values.iter().map(|value| (name, f64::from(*value).to_bits())));
    }

    /// Adds what a view shows.
    pub fn look(&mut self, view: &View<'_>, model: &Model, contacts: usize) {
        for magnet in 0..model.magnets() {
            self.add("magnet pose", &view.magnet_pose(magnet));
            self.add("magnet velocity", &view.magnet_velocity(magnet));
        }
        (0..model.nodes()).for_each(|node| self.add("node", &view.node_m(node)));
        (0..contacts).for_each(|contact| self.add("contact", &view.contact(contact)));
        self.add("drive", &view.drive_place(0).unwrap_or_default());
        self.add("drive velocity", &view.drive_velocity());
        self.add("robot", &view.robot_pose());
        self.add("time", &[view.time_s()]);
        self.add("status", &[f64::from(view.status() as u8)]);
    }

    /// Asserts equal bits, or names the first that differ.
    #[track_caller]
    pub fn assert_equals(&self, other: &Self, place: &str) {
        assert_eq!(self.0.len(), other.0.len(), "{place}: different shapes");
        let differs = |(a, b): &(&(&str, u64), &(&str, u64))| a != b;
        if let Some(((name, a), (_, b))) = self.0.iter().zip(&other.0).find(differs) {
            let (x, y) = (f64::from_bits(*a), f64::from_bits(*b));
            panic!("{place}: {name} is {a:016x} ({x:e}) here and {b:016x} ({y:e}) there");
        }
    }
}
