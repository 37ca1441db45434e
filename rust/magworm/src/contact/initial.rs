//! Where Newton's iteration starts: every point in an assumed mode, with the linearised law of that mode.

use super::hessian::ContactHessian;
use super::law::{ContactLaw, PointState};
use super::newton::normal_mass;
use super::touch::start_velocity;
use super::{ContactMode, ContactVector, Workspace};
use crate::lanes::{Components, Dim, Isa, Real};
use crate::model::ContactPair;
use crate::state::Block;

/// Least speed that friction over speed is taken at [m/s].
const LEAST_SPEED_M_S: f64 = 1e-30;

/// The start that follows from the step before: coefficient of friction, λ⁰ and first linearisation of a point.
///
/// An active point is taken as closed. Its speed at the start of the step decides which coefficient of friction holds in the
/// whole step: μ_s up to v_d, μ_d beyond. One coefficient a step keeps the law monotone, and its limit for short steps is the
/// paper's law.
#[inline(always)]
pub(super) fn warm_start<D: Dim, I: Isa>(
    isa: I,
    law: &ContactLaw<I::F>,
    block: &mut Block<I::Row>,
    c: usize,
    pair: &ContactPair,
) {
    let zero = isa.splat(0.0);
    let mode = isa.load(&block.contact_mode[c]);
    let was_closed = !mode.eq(isa.splat(ContactMode::Open.code()));
    let velocity = start_velocity::<D, I>(isa, block, c, pair).tangent;
    let speed = D::length(velocity);
    let slow = speed.le(law.transition_speed);
    let start = Assumed::<D, I::F> {
        velocity,
        speed,
        closed: isa.load(&block.contact.active[c]).gt(zero),
        // A point that slid slides on: sticking would take its whole momentum within one step, which no friction can.
        sticks: slow & !mode.eq(isa.splat(ContactMode::Slide.code())),
    };
    let spring = D::Tangent::load(isa, &block.tangential_spring[D::TANGENTS * c..]);
    let before = ContactVector::new(
        I::F::select(was_closed, isa.load(&block.normal_impulse[c]), zero),
        D::Tangent::select(was_closed, spring, D::Tangent::splat(zero)),
    );
    let coefficient = I::F::select(slow, law.static_friction, law.dynamic_friction);
    let point = PointState {
        normal_mass: normal_mass(isa, law, &block.contact, c),
        warm_start: before,
        coefficient,
        bound: zero,
    };
    let bias = ContactVector::load(isa, &block.contact.bias, c);
    let hessian = start.hessian(&point, law, bias);
    let work = &mut block.contact;
    isa.store(coefficient, &mut work.friction_coefficient[c]);
    before.store(isa, &mut work.warm_start, c);
    hessian.store_where(isa, zero.eq(zero), &mut work.hessian, c);
    D::Tangent::splat(zero).store(isa, &mut work.friction_direction[D::TANGENTS * c..]);
}

/// A start that takes no notice of the step before: active points stick, or slide without friction.
#[inline(always)]
pub(super) fn cold_start<D: Dim, I: Isa>(
    isa: I,
    law: &ContactLaw<I::F>,
    work: &mut Workspace<I::Row>,
    c: usize,
    sticks: bool,
    mask: I::M,
) {
    let zero = isa.splat(0.0);
    let active = isa.load(&work.active[c]).gt(zero);
    let normal = I::F::select(active, normal_mass(isa, law, work, c), zero);
    let along = I::F::select(active, law.effective_mass, zero);
    let bias = ContactVector::<D, I::F>::load(isa, &work.bias, c);
    let none = D::Tangent::splat(zero);
    let mut impulse = ContactVector::<D, I::F>::new(-(normal * bias.normal), none);
    if sticks {
        let before = ContactVector::<D, I::F>::load(isa, &work.warm_start, c);
        let stuck = before.tangent - bias.tangent * along;
        impulse.tangent = D::Tangent::select(active, stuck, none);
    }
    let tangential = D::isotropic(if sticks { along } else { zero });
    let hessian = ContactHessian { impulse, normal, coupling: none, tangential };
    hessian.store_where(isa, mask, &mut work.hessian, c);
}

/// What is assumed of a point before the first iteration.
struct Assumed<D: Dim, F: Real> {
    /// Velocity along the tangents [m/s], and its length.
    velocity: D::Tangent<F>,
    speed: F,
    closed: F::Mask,
    sticks: F::Mask,
}

impl<D: Dim, F: Real> Assumed<D, F> {
    /// The linearised law: nothing where the point is open; a spring where it sticks; where it slides, friction along its
    /// velocity that follows λ_n, and F/|u| across it, the derivative of a direction.
    #[inline(always)]
    fn hessian(
        &self,
        point: &PointState<D, F>,
        law: &ContactLaw<F>,
        bias: ContactVector<D, F>,
    ) -> ContactHessian<D, F> {
        let (zero, w) = (self.speed.splat(0.0), law.effective_mass);
        let along = D::direction(self.velocity);
        let normal = F::select(self.closed, point.normal_mass, zero);
        let pressed = F::select(self.closed, -(point.normal_mass * bias.normal), zero);
        let stiff = F::select(self.closed, w, zero);
        let adhesion = law.friction_bound(zero, point.warm_start.normal);
        let friction = F::select(self.closed, point.coefficient * pressed + adhesion, zero);
        let bound = law.friction_bound(point.coefficient, point.warm_start.normal);
        let speed = (self.speed + bound / w).max(w.splat(LEAST_SPEED_M_S));
        let viscosity = F::select(self.closed, bound / speed, zero);
        let stuck = point.warm_start.tangent - bias.tangent * w;
        let stuck = D::Tangent::select(self.closed, stuck, D::Tangent::splat(zero));
        let tangent = D::Tangent::select(self.sticks, stuck, -(along * friction));
        let coupling = F::select(self.sticks, zero, point.coefficient * normal);
        ContactHessian {
            impulse: ContactVector::new(pressed, tangent),
            normal,
            coupling: -(along * coupling),
            tangential: D::isotropic_less(
                F::select(self.sticks, stiff, viscosity),
                F::select(self.sticks, zero, viscosity),
                along,
            ),
        }
    }
}
