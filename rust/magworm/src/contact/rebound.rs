//! Newton's law of impact: a point that arrives at a surface leaves it at a share of its speed.
//!
//! ```text
//! u_n⁺ ≥ −e u_n⁻      where u_n⁻ < −u_r and the point reaches the surface within the step
//! ```
//!
//! e is the coefficient of restitution, u⁻ and u⁺ the velocities of the point at the start and the end of the step, u_r the
//! speed from which points rebound [m/s]; slower ones come to rest as all do without restitution. As in Moreau's time-stepping the
//! velocity turns round within the step of arrival, so that impact does work at one place, ½ λ (u⁻ + u⁺) ≤ 0, and the
//! place of the point is off by at most (1 + e) times the gap that it had left. In that step the point is rigid along the normal: of a
//! contact spring that gives, it would come off at less than e.
//!
//! With friction, and where only some points arrive, Newton's law may give energy (Kane & Levinson 1985). A step in which it
//! would is solved again without rebound.

use super::law::{ContactLaws, FrictionLaw};
use super::newton::load_point;
use super::touch::start_velocity;
use super::{ContactVector, Workspace, store_where};
use crate::lanes::{Components, Dim, Isa, Real};
use crate::model::{ContactPair, Model, Restitution};
use crate::state::Block;

/// Makes a point that arrives rigid, and e u_n⁻ its bias, given the bias of a point that comes to rest.
#[inline(always)]
pub(super) fn arrive<D: Dim, I: Isa>(
    isa: I,
    restitution: &Restitution,
    block: &mut Block<I::Row>,
    c: usize,
    pair: &ContactPair,
) {
    let zero = isa.splat(0.0);
    let u = start_velocity::<D, I>(isa, block, c, pair).normal;
    let work = &mut block.contact;
    let bias = &mut work.bias[D::AXES * c];
    let reaches = (u + isa.load(bias)).le(zero);
    let arrives = u.lt(isa.splat(-restitution.from_m_s)) & reaches;
    store_where(isa, arrives, u * restitution.coefficient, bias);
    let mass = I::F::select(arrives, isa.splat(restitution.mass_kg), zero);
    isa.store(mass, &mut work.impact_mass[c]);
}

/// The lanes of a mask in which impact does positive work: Σ ½ λ·(u⁻ + u⁺), less what the spring of a point gives that was
/// inside before.
#[inline(always)]
pub(super) fn gains_energy<D: Dim, I: Isa>(
    isa: I,
    model: &Model,
    laws: &ContactLaws<I::F>,
    block: &mut Block<I::Row>,
    mask: I::M,
) -> I::M {
    let zero = isa.splat(0.0);
    let (mut twice_work, mut impacts) = (zero, zero);
    for (c, pair) in model.contacts.iter().enumerate() {
        let before = start_velocity::<D, I>(isa, block, c, pair);
        let work = &block.contact;
        let u = ContactVector::<D, I::F>::load(isa, &work.velocity, c);
        let bias = ContactVector::load(isa, &work.bias, c);
        let law = laws.of(pair);
        let found = load_point::<D, I>(isa, law, work, c).impulse(law, FrictionLaw::Coulomb, u);
        let impact = isa.load(&work.impact_mass[c]);
        let spring = I::F::select(impact.gt(zero), zero, bias.normal.min(zero));
        let both = before + (u - bias);
        let normal = found.impulse.normal * (both.normal + spring * 2.0);
        twice_work = twice_work + normal + found.impulse.tangent.dot(both.tangent);
        impacts = impacts + impact;
    }
    mask & impacts.gt(zero) & twice_work.gt(zero)
}

/// Lets the points that arrive come to rest in the lanes of a mask.
#[inline(always)]
pub(super) fn give_up<D: Dim, I: Isa>(
    isa: I,
    model: &Model,
    work: &mut Workspace<I::Row>,
    mask: I::M,
) {
    let zero = isa.splat(0.0);
    for c in 0..model.contacts.len() {
        let rests = mask & isa.load(&work.impact_mass[c]).gt(zero);
        let normal = D::AXES * c;
        let u = isa.load(&work.velocity[normal]) - isa.load(&work.bias[normal]);
        store_where(isa, rests, u, &mut work.velocity[normal]);
        store_where(isa, rests, zero, &mut work.bias[normal]);
    }
}
