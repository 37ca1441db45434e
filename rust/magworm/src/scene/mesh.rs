//! The mesh: nodes, rod elements, rigid magnets. Section changes and magnet ends fall on nodes.

use super::contact_point::{ContactPoint, Frame};
use super::direction::{Direction, unit_vector};
use super::{Plan, Scene, Segment, SegmentMagnet};
use crate::lanes::Dimensions;
use crate::magnetic::Cuboid;

/// Nodes and elements along the rest body, head first.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Arc length of each node from the head end [m]; ascending.
    pub arc_m: Vec<f64>,
    /// One element between each node and the next.
    pub elements: Vec<Element>,
    /// The magnets, head first.
    pub magnets: Vec<MeshMagnet>,
    /// Points of the underside that may touch the ground.
    pub contact_points: Vec<ContactPoint>,
    /// Nodes held in place, from the head.
    pub fixed_nodes: usize,
}

/// A rod element.
#[derive(Clone, Copy, Debug)]
pub struct Element {
    /// Thickness of the section [m].
    pub thickness_m: f64,
    /// Width of the section, out of the plane [m].
    pub width_m: f64,
    /// The magnet that makes it rigid.
    pub magnet: Option<usize>,
}

/// A magnet that fills one element.
#[derive(Clone, Copy, Debug)]
pub struct MeshMagnet {
    /// The element it fills.
    pub element: usize,
    /// Half its length: the distance of the element's nodes from its middle [m].
    pub half_length_m: f64,
    /// Edges along the body, its thickness and its width [m].
    pub size_m: [f64; 3],
    /// Place of its centre from the middle of its element, along the body, up and to the side [m]; none where it is there.
    pub offset_m: Option<[f64; 3]>,
    /// Magnitude of the remanence [T].
    pub remanence_t: f64,
    /// −1 where it is magnetised straight down, else 1: sign of its remanence along `direction`.
    pub polarity: f64,
    /// Direction of the remanence; up where it is magnetised straight down.
    pub direction: Direction,
    /// Density [kg/m³].
    pub density_kg_m3: f64,
    /// Whether the scene leaves the magnet in.
    pub present: bool,
}

impl MeshMagnet {
    /// Its cuboid.
    pub fn cuboid(&self) -> Cuboid {
        let [length_m, height_m, width_m] = self.size_m;
        Cuboid { length_m, height_m, width_m }
    }

    /// Whether another magnet has its shape and direction; strength and polarity aside.
    pub fn is_alike(&self, other: &Self) -> bool {
        self.size_m == other.size_m && self.direction == other.direction
    }

    /// Volume [m³].
    pub fn volume_m3(&self) -> f64 {
        let [length_m, height_m, width_m] = self.size_m;
        length_m * width_m * height_m
    }

    /// Mass of the magnet alone [kg].
    pub fn mass_kg(&self) -> f64 {
        let [length_m, height_m, width_m] = self.size_m;
        self.density_kg_m3 * length_m * width_m * height_m
    }
}

impl Mesh {
    /// Meshes the body of a validated scene.
    pub fn new(scene: &Scene) -> Self {
        let plan = Plan::new(scene);
        let behind_wall_m = plan.behind_wall_m.unwrap_or(0.0);
        let mut mesh = Self {
            arc_m: vec![-behind_wall_m],
            elements: Vec::new(),
            magnets: Vec::new(),
            contact_points: Vec::new(),
            fixed_nodes: if plan.behind_wall_m.is_some() { 2 } else { 0 },
        };
        for (place, segment) in plan.segments.iter().enumerate() {
            match &segment.magnet {
                Some(magnet) => mesh.add_magnet(segment, magnet, scene.dimensions),
                None => {
                    let wall_m = if place == 0 { behind_wall_m } else { 0.0 };
                    mesh.add_elements(segment, segment.length_m + wall_m, None);
                }
            }
        }
        if mesh.contact_points.is_empty() && scene.ground.is_some() {
            mesh.contact_points = mesh.points_below_nodes();
        }
        mesh
    }

    /// Length of the rest body [m].
    pub fn length_m(&self) -> f64 {
        self.arc_m[self.arc_m.len() - 1]
    }

    /// Rest length of an element [m].
    pub fn element_length_m(&self, element: usize) -> f64 {
        self.arc_m[element + 1] - self.arc_m[element]
    }

    /// Mean distance between the middles of adjacent magnets [m]; none with less than two.
    pub fn pitch_m(&self) -> Option<f64> {
        let middle_m = |magnet: &MeshMagnet| {
            0.5 * (self.arc_m[magnet.element] + self.arc_m[magnet.element + 1])
        };
        let [first, .., last] = self.magnets.as_slice() else { return None };
        Some((middle_m(last) - middle_m(first)) / (self.magnets.len() - 1) as f64)
    }

    /// Volume of an element with what is in it [m³].
    pub fn volume_m3(&self, element: usize) -> f64 {
        let Element { thickness_m, width_m, .. } = self.elements[element];
        self.element_length_m(element) * thickness_m * width_m
    }

    /// A magnet, the rubber before and behind it, and its contact points where the segment is a foot.
    fn add_magnet(&mut self, segment: &Segment, magnet: &SegmentMagnet, dimensions: usize) {
        let [before_m, behind_m] = segment.ends_m(magnet);
        self.add_elements(segment, before_m, None);
        let (body, element) = (self.magnets.len(), self.elements.len());
        self.add_elements(segment, magnet.length_m, Some(body));
        self.magnets.push(mesh_magnet(magnet, element));
        self.add_elements(segment, behind_m, None);
        if segment.foot {
            self.add_corners(segment, magnet.along_m, body, dimensions);
        }
    }

    /// Elements of equal length, one where they hold a magnet and none where there is no length.
    fn add_elements(&mut self, segment: &Segment, length_m: f64, magnet: Option<usize>) {
        let Segment { thickness_m, width_m, elements, .. } = *segment;
        let parts = match magnet {
            Some(_) => 1,
            None if length_m > 0.0 => elements,
            None => 0,
        };
        let start_m = self.length_m();
        for part in 1..=parts {
            self.elements.push(Element { thickness_m, width_m, magnet });
            self.arc_m.push(start_m + length_m * part as f64 / parts as f64);
        }
    }

    /// A toe and a heel in the plane, two of each in space.
    fn add_corners(&mut self, foot: &Segment, along_m: f64, body: usize, dimensions: usize) {
        let across = Dimensions::new(dimensions).across;
        let depth_m = 0.5 * foot.thickness_m;
        for end_m in [-0.5 * foot.length_m, 0.5 * foot.length_m] {
            self.contact_points.extend(across.iter().map(|across| ContactPoint {
                frame: Frame::Body(body),
                place_m: [end_m - along_m, -depth_m, across * foot.width_m],
            }));
        }
    }

    /// One point below every node.
    fn points_below_nodes(&self) -> Vec<ContactPoint> {
        let last = self.elements.len() - 1;
        let thickness_m = |node: usize| {
            let sections = [node.saturating_sub(1), node.min(last)];
            sections
                .map(|element| self.elements[element].thickness_m)
                .into_iter()
                .fold(0.0, f64::max)
        };
        (0..self.arc_m.len())
            .map(|node| ContactPoint {
                frame: Frame::Node(node),
                place_m: [0.0, -0.5 * thickness_m(node), 0.0],
            })
            .collect()
    }
}

fn mesh_magnet(magnet: &SegmentMagnet, element: usize) -> MeshMagnet {
    let vector = unit_vector(magnet.angle_deg, magnet.aside_deg);
    let (upright, down) = (vector[1].abs() == 1.0, vector[1] == -1.0);
    let offset_m = [0.0, magnet.up_m, magnet.aside_m];
    MeshMagnet {
        element,
        half_length_m: 0.5 * magnet.length_m,
        size_m: [magnet.length_m, magnet.height_m, magnet.width_m],
        offset_m: (offset_m != [0.0; 3]).then_some(offset_m),
        remanence_t: magnet.remanence_t,
        polarity: if down { -1.0 } else { 1.0 },
        direction: if upright { Direction::Up } else { Direction::Oblique(vector) },
        density_kg_m3: magnet.density_kg_m3,
        present: magnet.present,
    }
}
