//! The mesh: nodes, rod elements, rigid magnets. Section changes and magnet ends fall on nodes.

use crate::scene::{Body, Clamp, Rod, Scene, Worm};

/// Nodes and elements along the rest body, head first.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Arc length of each node from the head end [m]; ascending.
    pub arc_m: Vec<f64>,
    /// One element between each node and the next.
    pub elements: Vec<Element>,
    /// The magnets, head first.
    pub magnets: Vec<MeshMagnet>,
    /// Points that may touch the ground.
    pub soles: Vec<Sole>,
    /// Nodes held in place, from the head.
    pub fixed_nodes: usize,
    /// Width of the body, out of the plane [m].
    pub width_m: f64,
}

/// A rod element.
#[derive(Clone, Copy, Debug)]
pub struct Element {
    /// Thickness of the section [m].
    pub thickness_m: f64,
    /// The magnet that makes it rigid.
    pub magnet: Option<usize>,
}

/// A magnet that fills one element.
#[derive(Clone, Copy, Debug)]
pub struct MeshMagnet {
    /// The element it fills.
    pub element: usize,
    /// 1: magnetised along the body's up direction, −1: down.
    pub polarity: f64,
    /// Whether the scene leaves the magnet in.
    pub present: bool,
}

/// A point of the underside.
///
/// Toe and heel of a foot move rigidly with its magnet. Hung on the light elements at the ends of the
/// foot instead, a point with friction above |e|/d would jam: pushing it back would press it down harder
/// (the paradox of Painlevé), and explicit steps would chatter.
#[derive(Clone, Copy, Debug)]
pub enum Sole {
    /// Toe or heel of a foot, rigidly with its magnet.
    Foot {
        /// The magnet.
        body: usize,
        /// Distance from its centre along the foot, towards the tail [m].
        along_m: f64,
        /// Distance below its centre [m].
        depth_m: f64,
        /// Distance to the side of its centre [m]; 0 in the plane.
        across_m: f64,
    },
    /// Straight below a node of a rod; thin rods, so that the turn of the section does not matter.
    Node {
        /// The node.
        node: usize,
        /// Distance below it [m].
        depth_m: f64,
    },
}

/// A stretch of equal section.
struct Segment {
    length_m: f64,
    thickness_m: f64,
    parts: usize,
    magnet: Option<usize>,
}

impl Mesh {
    /// Meshes the body of a validated scene.
    pub fn new(scene: &Scene) -> Self {
        let magnet_length_m = scene.magnet.as_ref().map_or(0.0, |m| m.length_m);
        match &scene.body {
            Body::Worm(worm) => Self::worm(worm, magnet_length_m, scene.dimensions),
            Body::Rod(rod) => Self::rod(rod, magnet_length_m, scene.ground.is_some()),
        }
    }

    /// Length of the rest body [m].
    pub fn length_m(&self) -> f64 {
        self.arc_m[self.arc_m.len() - 1]
    }

    /// Rest length of an element [m].
    pub fn element_length_m(&self, element: usize) -> f64 {
        self.arc_m[element + 1] - self.arc_m[element]
    }

    fn worm(worm: &Worm, magnet_length_m: f64, dimensions: usize) -> Self {
        let foot_end_m = 0.5 * (worm.foot_length_m - magnet_length_m);
        let foot_end = |_| Segment {
            length_m: foot_end_m,
            thickness_m: worm.foot_thickness_m,
            parts: if foot_end_m > 1e-9 * worm.foot_length_m {
                worm.elements_per_foot_end
            } else {
                0
            },
            magnet: None,
        };
        // A toe and a heel in the plane, two of each in space.
        let corners: &[f64] = if dimensions == 2 { &[0.0] } else { &[-0.5, 0.5] };
        let mut segments = Vec::new();
        let mut soles = Vec::new();
        for foot in 0..worm.magnets {
            segments.push(foot_end(()));
            segments.push(Segment {
                length_m: magnet_length_m,
                thickness_m: worm.foot_thickness_m,
                parts: 1,
                magnet: Some(foot),
            });
            segments.push(foot_end(()));
            let depth_m = 0.5 * worm.foot_thickness_m;
            for along_m in [-0.5 * worm.foot_length_m, 0.5 * worm.foot_length_m] {
                soles.extend(corners.iter().map(|corner| {
                    let across_m = corner * worm.width_m;
                    Sole::Foot { body: foot, along_m, depth_m, across_m }
                }));
            }
            if foot + 1 < worm.magnets {
                segments.push(Segment {
                    length_m: worm.pitch_m - worm.foot_length_m,
                    thickness_m: worm.bridge_thickness_m,
                    parts: worm.elements_per_bridge,
                    magnet: None,
                });
            }
        }
        let polarity = |j: usize| {
            let first = f64::from(worm.first_polarity);
            if j.is_multiple_of(2) { first } else { -first }
        };
        let magnets: Vec<_> =
            (0..worm.magnets).map(|j| (polarity(j), !worm.removed.contains(&j))).collect();
        Self::from_segments(&segments, &magnets, soles, 0, worm.width_m, 0.0)
    }

    fn rod(rod: &Rod, magnet_length_m: f64, grounded: bool) -> Self {
        // A clamp half an element behind the wall makes the clamped end second-order accurate:
        // the curvature of the first free vertex then belongs to the stretch that starts at the wall.
        let clamped = rod.clamp == Clamp::Head;
        let behind_wall_m =
            if clamped { 0.5 * rod.length_m / (rod.elements as f64 - 0.5) } else { 0.0 };
        let size_m = (rod.length_m + behind_wall_m) / rod.elements as f64;
        let segment = |length_m: f64, magnet| Segment {
            length_m,
            thickness_m: rod.thickness_m,
            parts: if magnet_or_empty(magnet, length_m, size_m) {
                usize::from(length_m > 1e-9 * size_m)
            } else {
                ((length_m / size_m).round() as usize).max(1)
            },
            magnet,
        };
        let mut order: Vec<usize> = (0..rod.magnets.len()).collect();
        order.sort_by(|&a, &b| rod.magnets[a].position_m.total_cmp(&rod.magnets[b].position_m));
        let mut segments = Vec::new();
        let mut magnets = Vec::new();
        let mut reached_m = -behind_wall_m;
        for &j in &order {
            let start_m = rod.magnets[j].position_m - 0.5 * magnet_length_m;
            segments.push(segment(start_m - reached_m, None));
            segments.push(segment(magnet_length_m, Some(magnets.len())));
            magnets.push((f64::from(rod.magnets[j].polarity), true));
            reached_m = start_m + magnet_length_m;
        }
        segments.push(segment(rod.length_m - reached_m, None));
        let elements = count_elements(&segments);
        let soles = if grounded { rod_soles(elements, 0.5 * rod.thickness_m) } else { Vec::new() };
        let fixed = if clamped { 2 } else { 0 };
        Self::from_segments(&segments, &magnets, soles, fixed, rod.width_m, behind_wall_m)
    }

    fn from_segments(
        segments: &[Segment],
        magnets: &[(f64, bool)],
        soles: Vec<Sole>,
        fixed_nodes: usize,
        width_m: f64,
        behind_wall_m: f64,
    ) -> Self {
        let mut arc_m = vec![-behind_wall_m];
        let mut elements = Vec::new();
        let mut mesh_magnets = Vec::new();
        for segment in segments {
            let start_m = arc_m[arc_m.len() - 1];
            for part in 1..=segment.parts {
                if let Some(j) = segment.magnet {
                    let (polarity, present) = magnets[j];
                    mesh_magnets.push(MeshMagnet { element: elements.len(), polarity, present });
                }
                elements.push(Element { thickness_m: segment.thickness_m, magnet: segment.magnet });
                arc_m.push(start_m + segment.length_m * part as f64 / segment.parts as f64);
            }
        }
        Self { arc_m, elements, magnets: mesh_magnets, soles, fixed_nodes, width_m }
    }
}

fn magnet_or_empty(magnet: Option<usize>, length_m: f64, size_m: f64) -> bool {
    magnet.is_some() || length_m <= 1e-9 * size_m
}

fn count_elements(segments: &[Segment]) -> usize {
    segments.iter().map(|s| s.parts).sum()
}

/// One point below every node.
fn rod_soles(elements: usize, depth_m: f64) -> Vec<Sole> {
    (0..=elements).map(|node| Sole::Node { node, depth_m }).collect()
}
