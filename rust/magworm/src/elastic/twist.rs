//! Bending about two axes and twisting in space (Bergou 2008, 2010).
//!
//! Each element carries a material frame (t, u, s): tangent, up and side = t × u. At a node between the
//! elements e and f, with χ = 1 + t_e·t_f, the curvature binormal κb = 2 t_e × t_f/χ has the length
//! 2 tan(φ/2) and gives
//!
//! κ₁ = ½ σ κb·(s_e + s_f), κ₂ = −½ σ κb·(u_e + u_f), τ = the angle about t_f from u_e, carried over by
//! parallel transport, to u_f,
//!
//! with σ = φ/(2 tan(φ/2)) where the curvature is the angle, 1 where it is the tangent, so that κ₁ of a rod
//! that bends in the plane is the κ of [`super::bend()`]. E = ½ B₁ κ₁² + ½ B₂ κ₂² + ½ C τ².
//!
//! Gradients (Bergou 2010, with t̃ = (t_e + t_f)/χ, ã = (a_e + a_f)/χ), for σ = 1:
//! ∂κ₁/∂e = (−κ₁ t̃ + t_f × s̃)/|e|, ∂κ₁/∂f = (−κ₁ t̃ − t_e × s̃)/|f|,
//! ∂κ₂/∂e = (−κ₂ t̃ − t_f × ũ)/|e|, ∂κ₂/∂f = (−κ₂ t̃ + t_e × ũ)/|f|,
//! ∂κ₁/∂θ = −½ κb·u and ∂κ₂/∂θ = −½ κb·s of either element; ∂τ/∂e = ½ κb/|e|, ∂τ/∂f = ½ κb/|f|,
//! ∂τ/∂θ_e = −1, ∂τ/∂θ_f = 1. The factor adds κ ∂σ with ∂σ/∂e = −γ (t_f − c t_e)/|e|,
//! ∂σ/∂f = −γ (t_e − c t_f)/|f|, c = t_e·t_f. With x = tan(φ/2): σ = atan(x)/x and
//! γ = (1 + x²)(1 − σ (1 + x²))/4x². Over the nodes: (−∂e, ∂e − ∂f, ∂f).

use super::relax::Dashpots;
use super::{
    Equations, MAX_STENCIL, Positions, Scheme, Springs, add_twist_gradient, generalised_gradient,
};
use crate::lanes::math::{atan, atan2, round};
use crate::lanes::{Components, Isa, Real, Space, Vec3, Vector};
use crate::model::{Bend, Model};
use crate::scene::Curvature;
use crate::state::Block;

/// Adds the bending and twisting springs of all nodes to the equations of a step.
#[inline(always)]
pub fn assemble<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, scheme: Scheme<I::F>) {
    let zero = isa.splat(0.0);
    let mut gradients = [[zero; MAX_STENCIL]; 3];
    for (k, spring) in model.bend.iter().enumerate() {
        let joint = Joint::load(isa, block, spring.node);
        let strains = joint.strains(isa, block, model.scene.solver.curvature, k);
        let positions = Positions { node: &block.node, q: &block.q };
        joint.gradients(isa, positions, spring, &strains, &mut gradients);
        let relaxation = &model.program.relaxation;
        let mut dashpots =
            Dashpots::new(isa, relaxation, &mut block.bend_dashpot, &block.running[0]);
        let mut acting = [strains.first, strains.second, strains.twist];
        for (way, strain) in acting.iter_mut().enumerate() {
            *strain = dashpots.act(3 * k + way, *strain);
        }
        let (matrix, rhs, v) = (&mut *block.matrix, &mut *block.rhs, &*block.spring_velocity);
        let mut equations = Equations { matrix, rhs, v };
        let springs = Springs {
            stencil: &spring.stencil,
            gradients: [&gradients[0], &gradients[1], &gradients[2]],
            strains: acting,
            stiffness: [
                scheme.stiffness * spring.stiffness_n_m,
                scheme.stiffness * spring.across_n_m,
                scheme.stiffness * spring.twist_n_m,
            ],
        };
        springs.add(isa, &mut equations, scheme);
    }
}

/// Frames and inverse lengths of the elements e and f at a node.
struct Joint<F> {
    te: Vec3<F>,
    tf: Vec3<F>,
    ue: Vec3<F>,
    uf: Vec3<F>,
    se: Vec3<F>,
    sf: Vec3<F>,
    over_e: F,
    over_f: F,
    /// t_e·t_f.
    cosine: F,
    /// 1/χ.
    over_chi: F,
    /// κb.
    binormal: Vec3<F>,
}

/// Measures of strain of a node, and the factor of its curvatures with its derivative γ.
struct Strains<F> {
    first: F,
    second: F,
    twist: F,
    factor: F,
    slope: F,
}

impl<F: Real> Joint<F> {
    #[inline(always)]
    fn load<I: Isa<F = F>>(isa: I, block: &Block<I::Row>, node: usize) -> Self {
        let (e, f) = (node - 1, node);
        let te: Vec3<F> = Vector::load(isa, &block.tangent[3 * e..]);
        let tf = Vector::load(isa, &block.tangent[3 * f..]);
        let cosine = te.dot(tf);
        let over_chi = isa.splat(1.0) / (cosine + 1.0);
        Self {
            ue: Vector::load(isa, &block.director[6 * e..]),
            uf: Vector::load(isa, &block.director[6 * f..]),
            se: Vector::load(isa, &block.side[3 * e..]),
            sf: Vector::load(isa, &block.side[3 * f..]),
            over_e: isa.load(&block.inverse_length[e]),
            over_f: isa.load(&block.inverse_length[f]),
            cosine,
            over_chi,
            binormal: te.cross(tf) * (over_chi + over_chi),
            te,
            tf,
        }
    }

    /// Strains of the node's k-th spring; remembers the twist.
    #[inline(always)]
    fn strains<I: Isa<F = F, M = F::Mask>>(
        &self,
        isa: I,
        block: &mut Block<I::Row>,
        law: Curvature,
        k: usize,
    ) -> Strains<F> {
        let half = isa.splat(0.5);
        let (sides, ups) = (self.se + self.sf, self.ue + self.uf);
        let (factor, slope) = match law {
            Curvature::Angle => angle_factor(self.binormal.norm_squared() * 0.25),
            Curvature::Tangent => (isa.splat(1.0), isa.splat(0.0)),
        };
        Strains {
            first: self.binormal.dot(sides) * half * factor,
            second: -(self.binormal.dot(ups) * half * factor),
            twist: self.twist(isa, block, k),
            factor,
            slope,
        }
    }

    /// τ, on the branch nearest to that of the step before: it may pass ±π.
    #[inline(always)]
    fn twist<I: Isa<F = F, M = F::Mask>>(&self, isa: I, block: &mut Block<I::Row>, k: usize) -> F {
        let carried = self.ue - (self.te + self.tf) * (self.ue.dot(self.tf) * self.over_chi);
        let angle = atan2(carried.dot(self.sf) * -1.0, carried.dot(self.uf));
        let before = isa.load(&block.twist[k]);
        let turns = round((before - angle) / std::f64::consts::TAU);
        let twist = angle + turns * std::f64::consts::TAU;
        let running = isa.load(&block.running[0]).eq(isa.splat(1.0));
        isa.store(F::select(running, twist, before), &mut block.twist[k]);
        twist
    }

    /// Gradients of κ₁, κ₂ and τ over the spring's unknowns.
    #[inline(always)]
    fn gradients<I: Isa<F = F, M = F::Mask>>(
        &self,
        isa: I,
        positions: Positions<'_, I::Row>,
        spring: &Bend,
        strains: &Strains<F>,
        out: &mut [[F; MAX_STENCIL]; 3],
    ) {
        let one = isa.splat(1.0);
        let (factor, slope) = (strains.factor, strains.slope);
        let tilde = (self.te + self.tf) * self.over_chi;
        // Directions in which the angle between the elements grows.
        let fold_e = self.tf - self.te * self.cosine;
        let fold_f = self.te - self.tf * self.cosine;
        let over_factor = one / factor;
        for (axis, strain, ae, af, sign) in
            [(0, strains.first, self.se, self.sf, 1.0), (1, strains.second, self.ue, self.uf, -1.0)]
        {
            let middle = (ae + af) * (self.over_chi * factor * sign);
            let change = -(strain * over_factor * slope);
            let de = self.tf.cross(middle) - tilde * strain;
            let df = middle.cross(self.te) - tilde * strain;
            let de = (de + fold_e * change) * self.over_e;
            let df = (df + fold_f * change) * self.over_f;
            element_gradients(isa, positions, spring, de, df, &mut out[axis]);
        }
        let half = self.binormal * isa.splat(0.5);
        let (de, df) = (half * self.over_e, half * self.over_f);
        element_gradients(isa, positions, spring, de, df, &mut out[2]);

        let half = half * factor;
        let [spin_e, spin_f] = spring.stencil.spins;
        add_twist_gradient(spin_e, self.te, -half.dot(self.ue), &mut out[0]);
        add_twist_gradient(spin_f, self.tf, -half.dot(self.uf), &mut out[0]);
        add_twist_gradient(spin_e, self.te, -half.dot(self.se), &mut out[1]);
        add_twist_gradient(spin_f, self.tf, -half.dot(self.sf), &mut out[1]);
        add_twist_gradient(spin_e, self.te, -one, &mut out[2]);
        add_twist_gradient(spin_f, self.tf, one, &mut out[2]);
    }
}

/// Gradient over the unknowns of a spring from the gradients over its elements.
#[inline(always)]
fn element_gradients<I: Isa>(
    isa: I,
    positions: Positions<'_, I::Row>,
    spring: &Bend,
    de: Vec3<I::F>,
    df: Vec3<I::F>,
    out: &mut [I::F; MAX_STENCIL],
) {
    let of_nodes = [-de, de - df, df];
    generalised_gradient::<Space, I, 3>(isa, positions, &spring.stencil, &of_nodes, out);
}

/// σ = atan(x)/x and γ = (1 + x²)(1 − σ (1 + x²))/4x² from x²; by their series near 0.
#[inline(always)]
fn angle_factor<F: Real>(square: F) -> (F, F) {
    let small = square.lt(square.splat(1e-3));
    let floor = square.max(square.splat(1e-3));
    let x = floor.sqrt();
    let sigma = atan(x) / x;
    let wide = floor + 1.0;
    let bracket = (-(sigma * wide) + 1.0) / floor;
    let z = square;
    let near_sigma = (((z * (1.0 / 9.0) - 1.0 / 7.0) * z + 1.0 / 5.0) * z - 1.0 / 3.0) * z + 1.0;
    let near_bracket = ((z * (2.0 / 63.0) - 2.0 / 35.0) * z + 2.0 / 15.0) * z - 2.0 / 3.0;
    let sigma = F::select(small, near_sigma, sigma);
    let bracket = F::select(small, near_bracket, bracket);
    (sigma, (square + 1.0) * bracket * 0.25)
}
