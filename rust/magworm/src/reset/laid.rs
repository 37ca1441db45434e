//! Where the parts of a body lie at the start: straight, or in the shape of the scene.

use super::StartPose;
use crate::lanes::math::sin_cos;
use crate::model::{ContactPoint, Frame, Model, Shape};
use nalgebra::Vector3;

/// A body that is laid down.
pub(super) trait Laid {
    /// Place of a node [m].
    fn node(&self, node: usize) -> Vector3<f64>;
    /// Middle of an element [m].
    fn middle(&self, element: usize) -> Vector3<f64>;
    /// Tangent of an element.
    fn tangent(&self, element: usize) -> Vector3<f64>;
    /// Up direction of an element.
    fn up(&self, element: usize) -> Vector3<f64>;
    /// Rotation of an element in the plane, whole turns counted [rad].
    fn angle_rad(&self, element: usize) -> f64;
}

/// Axes of the head element in a pose: tangent, up, side.
fn head_axes(pose: StartPose) -> [Vector3<f64>; 3] {
    let (sin, cos) = sin_cos(pose.angle_rad);
    let (yaw_sin, yaw_cos) = sin_cos(pose.yaw_rad);
    [
        Vector3::new(cos * yaw_cos, sin, -(cos * yaw_sin)),
        Vector3::new(-(sin * yaw_cos), cos, sin * yaw_sin),
        Vector3::new(yaw_sin, 0.0, yaw_cos),
    ]
}

/// A straight body.
pub(super) struct Straight<'a> {
    model: &'a Model,
    head: Vector3<f64>,
    tangent: Vector3<f64>,
    up: Vector3<f64>,
    angle_rad: f64,
}

impl<'a> Straight<'a> {
    pub(super) fn new(model: &'a Model, pose: StartPose) -> Self {
        let [tangent, up, _] = head_axes(pose);
        let drop_m = straight_drop_m(model, pose.angle_rad);
        let head = Vector3::new(pose.x_m, pose.height_m + drop_m, pose.z_m);
        Self { model, head, tangent, up, angle_rad: pose.angle_rad }
    }

    fn at(&self, arc_m: f64) -> Vector3<f64> {
        self.head + self.tangent * arc_m
    }
}

impl Laid for Straight<'_> {
    fn node(&self, node: usize) -> Vector3<f64> {
        self.at(self.model.mesh.arc_m[node])
    }

    fn middle(&self, element: usize) -> Vector3<f64> {
        let arc_m = &self.model.mesh.arc_m;
        self.at(0.5 * (arc_m[element] + arc_m[element + 1]))
    }

    fn tangent(&self, _element: usize) -> Vector3<f64> {
        self.tangent
    }

    fn up(&self, _element: usize) -> Vector3<f64> {
        self.up
    }

    fn angle_rad(&self, _element: usize) -> f64 {
        self.angle_rad
    }
}

/// How far the centre line's head end lies above the lowest contact point; 0 without ground.
fn straight_drop_m(model: &Model, angle_rad: f64) -> f64 {
    let (sin, cos) = sin_cos(angle_rad);
    let arc = &model.mesh.arc_m;
    let below = |point: &ContactPoint| {
        let [along_m, up_m, _] = point.place_m;
        match point.frame {
            Frame::World => None,
            Frame::Body(body) => {
                let element = model.bodies[body].element;
                let along_m = 0.5 * (arc[element] + arc[element + 1]) + along_m;
                Some(-up_m * cos - along_m * sin + point.radius_m)
            }
            Frame::Node(node) => Some(-up_m - arc[node] * sin),
        }
    };
    model.mesh.contact_points.iter().filter_map(below).reduce(f64::max).unwrap_or(0.0)
}

/// A body in the shape of the scene.
pub(super) struct Bent<'a> {
    shape: &'a Shape,
    head: Vector3<f64>,
    axes: [Vector3<f64>; 3],
    angle_rad: f64,
}

impl<'a> Bent<'a> {
    pub(super) fn new(model: &Model, shape: &'a Shape, pose: StartPose) -> Self {
        let (axes, angle_rad) = (head_axes(pose), pose.angle_rad);
        let mut this = Self { shape, head: Vector3::zeros(), axes, angle_rad };
        let drop_m = -this.lowest_m(model).unwrap_or(0.0);
        this.head = Vector3::new(pose.x_m, pose.height_m + drop_m, pose.z_m);
        this
    }

    /// From the axes of the head element to x, y, z.
    fn world(&self, a: Vector3<f64>) -> Vector3<f64> {
        self.axes[0] * a.x + self.axes[1] * a.y + self.axes[2] * a.z
    }

    /// Height of the lowest contact point or corner of a section [m]; none without contact points.
    fn lowest_m(&self, model: &Model) -> Option<f64> {
        let points = model.mesh.contact_points.iter();
        let points = points.filter_map(|point| self.point_height_m(model, point));
        let corners = (0..model.mesh.elements.len())
            .flat_map(|element| [element, element + 1].map(|node| (element, node)))
            .map(|(element, node)| self.section_height_m(model, element, node));
        let lowest_point_m = points.reduce(f64::min)?;
        Some(corners.fold(lowest_point_m, f64::min))
    }

    /// Height of a contact point of the body [m].
    fn point_height_m(&self, model: &Model, point: &ContactPoint) -> Option<f64> {
        let [along_m, up_m, side_m] = point.place_m;
        match point.frame {
            Frame::World => None,
            Frame::Body(body) => {
                let element = model.bodies[body].element;
                let (t, u) = (self.tangent(element), self.up(element));
                let arm = t * along_m + u * up_m + t.cross(&u) * side_m;
                Some((self.middle(element) + arm).y - point.radius_m)
            }
            Frame::Node(node) => Some(self.node(node).y + up_m),
        }
    }

    /// Height of the lowest corner of an element's section at one of its nodes [m].
    fn section_height_m(&self, model: &Model, element: usize, node: usize) -> f64 {
        let (t, u) = (self.tangent(element), self.up(element));
        let thick_m = model.mesh.elements[element].thickness_m * u.y.abs();
        let wide_m = model.mesh.elements[element].width_m * t.cross(&u).y.abs();
        self.node(node).y - 0.5 * (thick_m + wide_m)
    }
}

impl Laid for Bent<'_> {
    fn node(&self, node: usize) -> Vector3<f64> {
        self.head + self.world(self.shape.place_m[node])
    }

    fn middle(&self, element: usize) -> Vector3<f64> {
        (self.node(element) + self.node(element + 1)) * 0.5
    }

    fn tangent(&self, element: usize) -> Vector3<f64> {
        self.world(self.shape.tangent[element])
    }

    fn up(&self, element: usize) -> Vector3<f64> {
        self.world(self.shape.up[element])
    }

    fn angle_rad(&self, element: usize) -> f64 {
        self.angle_rad + self.shape.turn_rad[element]
    }
}
