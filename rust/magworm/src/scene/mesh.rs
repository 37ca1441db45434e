//! The mesh: nodes, rod elements, rigid bodies with their magnets. Section changes and the ends of bodies fall on nodes.

use super::contact_point::{ContactPoint, Foot, Frame};
use super::{ContactPoints, Plan, Scene, Segment, SegmentMagnet};
use crate::lanes::Dimensions;
use std::ops::Range;

/// Nodes and elements along the rest body, head first.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Arc length of each node from the head end [m]; ascending.
    pub arc_m: Vec<f64>,
    /// One element between each node and the next.
    pub elements: Vec<Element>,
    /// Elements that are rigid bodies, head first.
    pub bodies: Vec<RigidElement>,
    /// The magnets in them, by body.
    pub magnets: Vec<MeshMagnet>,
    /// Points of the underside that may touch the ground.
    pub contact_points: Vec<ContactPoint>,
    /// The feet, head first.
    pub feet: Vec<Foot>,
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
    /// The rigid body that it is.
    pub body: Option<usize>,
}

/// An element that a magnet makes rigid.
#[derive(Clone, Copy, Debug)]
pub struct RigidElement {
    /// Which one.
    pub element: usize,
    /// Distance of its nodes from its middle [m].
    pub half_length_m: f64,
}

/// A magnet in a rigid body.
#[derive(Clone, Debug)]
pub struct MeshMagnet {
    /// The body.
    pub body: usize,
    /// What the scene says of it. Its place along the segment is that of its body.
    pub magnet: SegmentMagnet,
}

impl Mesh {
    /// Meshes the body of a validated scene.
    pub fn new(scene: &Scene) -> Self {
        let plan = Plan::new(scene);
        let behind_wall_m = plan.behind_wall_m.unwrap_or(0.0);
        let mut mesh = Self {
            arc_m: vec![-behind_wall_m],
            elements: Vec::new(),
            bodies: Vec::new(),
            magnets: Vec::new(),
            contact_points: Vec::new(),
            feet: Vec::new(),
            fixed_nodes: if plan.behind_wall_m.is_some() { 2 } else { 0 },
        };
        for (place, segment) in plan.segments.iter().enumerate() {
            match &segment.magnet {
                Some(magnet) => mesh.add_magnet(segment, magnet, scene),
                None => {
                    let wall_m = if place == 0 { behind_wall_m } else { 0.0 };
                    mesh.add_elements(segment, segment.length_m + wall_m, None);
                }
            }
        }
        let nodes = mesh.feet.is_empty() || scene.contact.points == ContactPoints::Nodes;
        if nodes && scene.ground.is_some() {
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

    /// Mean distance between the middles of adjacent bodies [m]; none with less than two.
    pub fn pitch_m(&self) -> Option<f64> {
        let last = self.bodies.len().checked_sub(1).filter(|last| *last > 0)?;
        Some((self.middle_m(last) - self.middle_m(0)) / last as f64)
    }

    /// Place of the middle of a body along the rest body, from the head end [m].
    pub fn middle_m(&self, body: usize) -> f64 {
        let element = self.bodies[body].element;
        0.5 * (self.arc_m[element] + self.arc_m[element + 1])
    }

    /// The magnets of a body.
    pub fn magnets_of(&self, body: usize) -> Range<usize> {
        let before = |of: usize| self.magnets.partition_point(|magnet| magnet.body < of);
        before(body)..before(body + 1)
    }

    /// Volume of an element with what is in it [m³].
    pub fn volume_m3(&self, element: usize) -> f64 {
        let Element { thickness_m, width_m, .. } = self.elements[element];
        self.element_length_m(element) * thickness_m * width_m
    }

    /// A body with its magnet, the rubber before and behind it, and its contact points where the segment is a foot.
    fn add_magnet(&mut self, segment: &Segment, magnet: &SegmentMagnet, scene: &Scene) {
        let [before_m, behind_m] = segment.ends_m(magnet);
        self.add_elements(segment, before_m, None);
        let (body, element) = (self.bodies.len(), self.elements.len());
        self.add_elements(segment, magnet.length_m, Some(body));
        self.bodies.push(RigidElement { element, half_length_m: 0.5 * magnet.length_m });
        self.magnets.push(MeshMagnet { body, magnet: magnet.clone() });
        self.add_elements(segment, behind_m, None);
        if segment.foot {
            self.add_foot(segment, magnet.along_m, body, scene);
        }
    }

    /// Elements of equal length, one where it is a rigid body and none where there is no length.
    fn add_elements(&mut self, segment: &Segment, length_m: f64, body: Option<usize>) {
        let Segment { thickness_m, width_m, elements, .. } = *segment;
        let parts = match body {
            Some(_) => 1,
            None if length_m > 0.0 => elements,
            None => 0,
        };
        let start_m = self.length_m();
        for part in 1..=parts {
            self.elements.push(Element { thickness_m, width_m, body });
            self.arc_m.push(start_m + length_m * part as f64 / parts as f64);
        }
    }

    /// A foot, and the points that it stands on.
    fn add_foot(&mut self, segment: &Segment, along_m: f64, body: usize, scene: &Scene) {
        let edges_m = [segment.length_m, segment.thickness_m, segment.width_m];
        let radius_m = scene.contact.edge_radius_m;
        let half_m = edges_m.map(|edge_m| 0.5 * edge_m - radius_m);
        let foot = Foot { body, centre_m: -along_m, half_m, radius_m };
        let across = Dimensions::new(scene.dimensions).across;
        self.contact_points.extend(foot.corners(-1.0, across));
        self.feet.push(foot);
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
                radius_m: 0.0,
            })
            .collect()
    }
}
