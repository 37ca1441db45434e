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

use super::frames::load3;
use super::vector::{add_scaled, cross, dot, scaled};
use super::{Equations, MOST, Places, Scheme, Springs, gather, gather_twist};
use crate::lanes::math::{atan, atan2, round};
use crate::lanes::{Isa, Real};
use crate::model::{Bend, Model};
use crate::scene::Curvature;
use crate::state::Block;

/// Adds the bending and twisting springs of all nodes to the equations of a step.
#[inline(always)]
pub fn assemble<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, scheme: Scheme<I::F>) {
    let zero = isa.splat(0.0);
    let mut gradients = [[zero; MOST]; 3];
    for (k, spring) in model.bend.iter().enumerate() {
        let joint = Joint::load(isa, block, spring.node);
        let strains = joint.strains(isa, block, model.scene.solver.curvature, k);
        let places = Places { node: &block.node, q: &block.q };
        joint.gradients(isa, places, spring, &strains, &mut gradients);
        let (matrix, right, v) = (&mut *block.matrix, &mut *block.right, &*block.lagged);
        let mut equations = Equations { matrix, right, v };
        let springs = Springs {
            stencil: &spring.stencil,
            gradients: [&gradients[0], &gradients[1], &gradients[2]],
            strains: [strains.first, strains.second, strains.twist],
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
    te: [F; 3],
    tf: [F; 3],
    ue: [F; 3],
    uf: [F; 3],
    se: [F; 3],
    sf: [F; 3],
    over_e: F,
    over_f: F,
    /// t_e·t_f.
    cosine: F,
    /// 1/χ.
    over_chi: F,
    /// κb.
    binormal: [F; 3],
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
        let te = load3(isa, &block.tangent, 3 * e);
        let tf = load3(isa, &block.tangent, 3 * f);
        let cosine = dot(&te, &tf);
        let over_chi = isa.splat(1.0) / (cosine + 1.0);
        Self {
            ue: load3(isa, &block.director, 6 * e),
            uf: load3(isa, &block.director, 6 * f),
            se: load3(isa, &block.side, 3 * e),
            sf: load3(isa, &block.side, 3 * f),
            over_e: isa.load(&block.inverse_length[e]),
            over_f: isa.load(&block.inverse_length[f]),
            cosine,
            over_chi,
            binormal: scaled(&cross(&te, &tf), over_chi + over_chi),
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
        let sides = add_scaled(&self.se, isa.splat(1.0), &self.sf);
        let ups = add_scaled(&self.ue, isa.splat(1.0), &self.uf);
        let (factor, slope) = match law {
            Curvature::Angle => angle_factor(dot(&self.binormal, &self.binormal) * 0.25),
            Curvature::Tangent => (isa.splat(1.0), isa.splat(0.0)),
        };
        Strains {
            first: dot(&self.binormal, &sides) * half * factor,
            second: -(dot(&self.binormal, &ups) * half * factor),
            twist: self.twist(isa, block, k),
            factor,
            slope,
        }
    }

    /// τ, on the branch nearest to that of the step before: it may pass ±π.
    #[inline(always)]
    fn twist<I: Isa<F = F, M = F::Mask>>(&self, isa: I, block: &mut Block<I::Row>, k: usize) -> F {
        let tangents = add_scaled(&self.te, isa.splat(1.0), &self.tf);
        let carried = add_scaled(&self.ue, -(dot(&self.ue, &self.tf) * self.over_chi), &tangents);
        let angle = atan2(dot(&carried, &self.sf) * -1.0, dot(&carried, &self.uf));
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
        places: Places<'_, I::Row>,
        spring: &Bend,
        strains: &Strains<F>,
        out: &mut [[F; MOST]; 3],
    ) {
        let one = isa.splat(1.0);
        let (factor, slope) = (strains.factor, strains.slope);
        let tilde = scaled(&add_scaled(&self.te, one, &self.tf), self.over_chi);
        // ∂ln σ-free part: directions in which the angle grows.
        let fold_e = add_scaled(&self.tf, -self.cosine, &self.te);
        let fold_f = add_scaled(&self.te, -self.cosine, &self.tf);
        let over_factor = one / factor;
        for (axis, strain, ae, af, sign) in [
            (0, strains.first, &self.se, &self.sf, 1.0),
            (1, strains.second, &self.ue, &self.uf, -1.0),
        ] {
            let middle = scaled(&add_scaled(ae, one, af), self.over_chi * factor * sign);
            let change = -(strain * over_factor * slope);
            let de = add_scaled(&cross(&self.tf, &middle), -strain, &tilde);
            let de = scaled(&add_scaled(&de, change, &fold_e), self.over_e);
            let df = add_scaled(&cross(&middle, &self.te), -strain, &tilde);
            let df = scaled(&add_scaled(&df, change, &fold_f), self.over_f);
            over_nodes(isa, places, spring, &de, &df, &mut out[axis]);
        }
        let half = scaled(&self.binormal, isa.splat(0.5));
        let (de, df) = (scaled(&half, self.over_e), scaled(&half, self.over_f));
        over_nodes(isa, places, spring, &de, &df, &mut out[2]);

        let half = scaled(&half, factor);
        let [spin_e, spin_f] = spring.stencil.spins;
        gather_twist(spin_e, &self.te, -dot(&half, &self.ue), &mut out[0]);
        gather_twist(spin_f, &self.tf, -dot(&half, &self.uf), &mut out[0]);
        gather_twist(spin_e, &self.te, -dot(&half, &self.se), &mut out[1]);
        gather_twist(spin_f, &self.tf, -dot(&half, &self.sf), &mut out[1]);
        gather_twist(spin_e, &self.te, -one, &mut out[2]);
        gather_twist(spin_f, &self.tf, one, &mut out[2]);
    }
}

/// Gradient over the stencil from those over the elements.
#[inline(always)]
fn over_nodes<I: Isa>(
    isa: I,
    places: Places<'_, I::Row>,
    spring: &Bend,
    de: &[I::F; 3],
    df: &[I::F; 3],
    out: &mut [I::F; MOST],
) {
    let head = [-de[0], -de[1], -de[2]];
    let middle = [de[0] - df[0], de[1] - df[1], de[2] - df[2]];
    gather::<3, I, 3>(isa, places, &spring.stencil, &[head, middle, *df], out);
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
