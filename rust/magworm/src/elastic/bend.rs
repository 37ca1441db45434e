//! Bending springs of the discrete elastic rod in the plane (Bergou 2008; planar form in Huang 2020, Goldberg 2019).
//!
//! E = ½ B κ² with φ the turning angle between the elements e and f at a node and κ either φ itself or
//! 2 tan(φ/2) = 2 (t_e × t_f)/(1 + t_e · t_f). In the plane φ = θ_f − θ_e and ∂θ/∂e = n/|e| with
//! n = ẑ × t, so ∂κ/∂e = −κ′ n_e/|e| and ∂κ/∂f = κ′ n_f/|f| with κ′ = dκ/dφ, which is 1 or 1 + κ²/4: the
//! plane's form of ∂κ/∂e = (−κ t̃ + t_f × d̃)/|e|. Over the nodes: (−∂e, ∂e − ∂f, ∂f).

use super::relax::Dashpots;
use super::{Equations, MAX_STENCIL, Positions, Scheme, Springs, generalised_gradient};
use crate::lanes::math::atan2;
use crate::lanes::{Components, Dim, Isa, Plane, Real, Vector};
use crate::model::Model;
use crate::scene::Curvature;
use crate::state::Block;

/// κ and dκ/dφ of a turning angle given by its cosine and sine.
#[inline(always)]
fn curvature<F: Real>(law: Curvature, dot: F, cross: F) -> (F, F) {
    match law {
        Curvature::Angle => (atan2(cross, dot), dot.splat(1.0)),
        Curvature::Tangent => {
            let strain = (cross * 2.0) / (dot + 1.0);
            (strain, strain * strain * 0.25 + 1.0)
        }
    }
}

/// n = ẑ × t.
#[inline(always)]
fn normal<F: Real>(t: Vector<F, 2>) -> Vector<F, 2> {
    Vector([-t[1], t[0]])
}

/// Adds all bending springs to the equations of a step.
#[inline(always)]
pub fn assemble<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, scheme: Scheme<I::F>) {
    let (matrix, rhs, v) = (&mut *block.matrix, &mut *block.rhs, &*block.spring_velocity);
    let (tangent, inverse_length) = (&*block.tangent, &*block.inverse_length);
    let positions = Positions { node: &block.node, q: &block.q };
    let law = model.scene.solver.curvature;
    let mut equations = Equations { matrix, rhs, v };
    let relaxation = &model.program.relaxation;
    let mut dashpots = Dashpots::new(isa, relaxation, &mut block.bend_dashpot, &block.running[0]);
    let mut gradient = [isa.splat(0.0); MAX_STENCIL];
    for (way, spring) in model.bend.iter().enumerate() {
        let (e, f) = (spring.node - 1, spring.node);
        let te = Vector::load(isa, &tangent[2 * e..]);
        let tf = Vector::load(isa, &tangent[2 * f..]);
        let [sine] = Plane::torque(te, tf).0;
        let (strain, slope) = curvature(law, te.dot(tf), sine);
        let over_e = slope * isa.load(&inverse_length[e]);
        let over_f = slope * isa.load(&inverse_length[f]);
        // ∂κ/∂e and ∂κ/∂f.
        let (de, df) = (-(normal(te) * over_e), normal(tf) * over_f);
        let of_nodes = [-de, de - df, df];
        let stencil = &spring.stencil;
        generalised_gradient::<Plane, I, 3>(isa, positions, stencil, &of_nodes, &mut gradient);
        let stiffness = scheme.stiffness * spring.stiffness_n_m;
        let strain = dashpots.act(way, strain);
        let springs =
            Springs { stencil, gradients: [&gradient], strains: [strain], stiffness: [stiffness] };
        springs.add(isa, &mut equations, scheme);
    }
}
