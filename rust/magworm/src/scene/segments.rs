//! Any body as a list of segments: worms and rods are shorthands for one.

use super::{Body, Clamp, Magnet, Rod, Scene, Segment, SegmentMagnet, Segments, Worm};

/// Lengths below this part of a segment or an element are none: 0.049 + 0.005 misses 0.054 by rounding.
pub(super) const NOTHING: f64 = 1e-9;

/// The segments of a body, head first, as they are meshed.
pub(crate) struct Plan {
    /// The segments; the first one of a clamped body begins at its wall.
    pub segments: Vec<Segment>,
    /// Length that is meshed behind the wall of a clamped body [m].
    ///
    /// A clamp half an element behind the wall makes the clamped end second-order accurate: the curvature of the first free
    /// vertex then belongs to the stretch that starts at the wall.
    pub behind_wall_m: Option<f64>,
}

impl Plan {
    /// The plan of a scene's body.
    pub fn new(scene: &Scene) -> Self {
        match (&scene.body, &scene.magnet) {
            (Body::Worm(worm), magnet) => {
                let segments = magnet.as_ref().map_or_else(Vec::new, |m| worm_segments(worm, m));
                Self { segments, behind_wall_m: None }
            }
            (Body::Rod(rod), magnet) => rod_plan(rod, magnet.as_ref()),
            (Body::Segments(body), _) => {
                Self { segments: body.segment.clone(), behind_wall_m: wall_m(body) }
            }
        }
    }
}

impl Scene {
    /// The same scene with its body written as segments, to be changed one by one.
    ///
    /// It gives the same trajectories, bit for bit, but for clamped rods that hold magnets: these are meshed in elements
    /// of one length up to the wall, a clamped body of segments in those of its first segment. Observations are scaled
    /// by the mean pitch of the magnets.
    pub fn in_segments(&self) -> Self {
        let plan = Plan::new(self);
        let clamp = if plan.behind_wall_m.is_some() { Clamp::Head } else { Clamp::None };
        let body = Body::Segments(Segments { clamp, segment: plan.segments });
        Self { body, magnet: None, ..self.clone() }
    }
}

impl Segment {
    /// Lengths before and behind its magnet [m]; 0 where the magnet ends with it.
    pub(crate) fn ends_m(&self, magnet: &SegmentMagnet) -> [f64; 2] {
        let side_m = 0.5 * (self.length_m - magnet.length_m);
        [side_m + magnet.along_m, side_m - magnet.along_m]
            .map(|end_m| if end_m.abs() <= NOTHING * self.length_m { 0.0 } else { end_m })
    }
}

fn worm_segments(worm: &Worm, magnet: &Magnet) -> Vec<Segment> {
    let bridge = Segment {
        length_m: worm.pitch_m - worm.foot_length_m,
        thickness_m: worm.bridge_thickness_m,
        width_m: worm.width_m,
        foot: false,
        elements: worm.elements_per_bridge,
        magnet: None,
    };
    let mut segments = Vec::new();
    for foot in 0..worm.magnets {
        if foot > 0 {
            segments.push(bridge.clone());
        }
        let alternating = if foot.is_multiple_of(2) { 1 } else { -1 };
        let mut held = upright(magnet, worm.first_polarity * alternating);
        held.present = !worm.removed.contains(&foot);
        segments.push(Segment {
            length_m: worm.foot_length_m,
            thickness_m: worm.foot_thickness_m,
            width_m: worm.width_m,
            foot: true,
            elements: worm.elements_per_foot_end,
            magnet: Some(held),
        });
    }
    segments
}

fn rod_plan(rod: &Rod, magnet: Option<&Magnet>) -> Plan {
    let clamped = rod.clamp == Clamp::Head;
    let behind_wall_m = clamped.then(|| behind_wall_m(rod.length_m, rod.elements));
    let wall_m = behind_wall_m.unwrap_or(0.0);
    let size_m = (rod.length_m + wall_m) / rod.elements as f64;
    let segment = |length_m: f64, elements, magnet| Segment {
        length_m,
        thickness_m: rod.thickness_m,
        width_m: rod.width_m,
        foot: false,
        elements,
        magnet,
    };
    let mut segments = Vec::new();
    // Rubber from where the rod was reached to the next magnet or to its end.
    let rubber = |segments: &mut Vec<Segment>, reached_m: f64, end_m: f64| {
        let meshed_m = end_m - reached_m + if segments.is_empty() { wall_m } else { 0.0 };
        if meshed_m > NOTHING * size_m {
            let elements = ((meshed_m / size_m).round() as usize).max(1);
            segments.push(segment(end_m - reached_m, elements, None));
        }
    };
    let mut placed: Vec<_> = rod.magnets.iter().collect();
    placed.sort_by(|a, b| a.position_m.total_cmp(&b.position_m));
    let mut reached_m = 0.0;
    for (one, magnet) in placed.into_iter().zip(magnet.into_iter().cycle()) {
        let start_m = one.position_m - 0.5 * magnet.length_m;
        rubber(&mut segments, reached_m, start_m);
        segments.push(segment(magnet.length_m, 1, Some(upright(magnet, one.polarity))));
        reached_m = start_m + magnet.length_m;
    }
    rubber(&mut segments, reached_m, rod.length_m);
    Plan { segments, behind_wall_m }
}

/// A magnet along the thickness, in the middle of its segment.
fn upright(magnet: &Magnet, polarity: i8) -> SegmentMagnet {
    SegmentMagnet {
        length_m: magnet.length_m,
        width_m: magnet.width_m,
        height_m: magnet.height_m,
        remanence_t: magnet.remanence_t,
        density_kg_m3: magnet.density_kg_m3,
        angle_deg: if polarity > 0 { 0.0 } else { 180.0 },
        aside_deg: 0.0,
        along_m: 0.0,
        up_m: 0.0,
        aside_m: 0.0,
        present: true,
    }
}

fn wall_m(body: &Segments) -> Option<f64> {
    let first = body.segment.first().filter(|_| body.clamp == Clamp::Head)?;
    Some(behind_wall_m(first.length_m, first.elements))
}

/// Half an element of a length that begins with it.
fn behind_wall_m(length_m: f64, elements: usize) -> f64 {
    0.5 * length_m / (elements as f64 - 0.5)
}
