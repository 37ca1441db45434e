//! Where a point meets a surface, and what the contact Jacobian of both makes of velocities and impulses.
//!
//! ```text
//! u = J v,   J = J_point − J_surface
//! ```
//!
//! A surface that stands still has no J. The point where both meet is one, so its impulse on one body and that on the other keep
//! both momenta.

use super::hessian::ContactHessian;
use super::jacobian::{add_block, add_force, point_velocity};
use super::surface::ContactFrame;
use super::{ContactVector, Workspace};
use crate::lanes::banded::Band;
use crate::lanes::{Components, Dim, Isa, Real, unsymmetric};
use crate::model::ContactPair;
use crate::state::Block;

/// Arms and contact frame of a pair.
#[derive(Clone, Copy)]
pub(super) struct Touch<D: Dim, F: Real> {
    /// r: from the point's body to the point [m].
    pub(super) arm: D::Vector<F>,
    /// The same from the body that carries the surface; none where it stands still.
    pub(super) surface_arm: Option<D::Vector<F>>,
    /// Normal and tangents.
    pub(super) frame: ContactFrame<D, F>,
    /// Whether the point turns with its body.
    rigid: bool,
}

impl<D: Dim, F: Real> Touch<D, F> {
    /// Reads that of contact `c` and goes on with it.
    ///
    /// What follows is compiled for ground and for bodies apart: chosen once a pair, the ground's reorders components alone. It
    /// has to be inlined, or it is not compiled for the lanes.
    #[inline(always)]
    pub(super) fn meet<I: Isa<F = F>, T>(
        isa: I,
        work: &mut Workspace<I::Row>,
        c: usize,
        pair: &ContactPair,
        then: impl FnOnce(Self, &mut Workspace<I::Row>) -> T,
    ) -> T {
        let arm = D::Vector::load(isa, &work.arm[D::AXES * c..]);
        let rigid = pair.rigid;
        let Some(body) = pair.surface_body else {
            return then(
                Self { arm, surface_arm: None, frame: ContactFrame::Upright, rigid },
                work,
            );
        };
        let first = D::AXES * body.place;
        let normal = D::Vector::load(isa, &work.surface_normal[first..]);
        let surface_arm = Some(D::Vector::load(isa, &work.surface_arm[first..]));
        then(Self { arm, surface_arm, frame: ContactFrame::about(normal), rigid }, work)
    }

    /// J v, from velocities among which those of both bodies begin at `first`.
    #[inline(always)]
    pub(super) fn velocity<I: Isa<F = F>>(
        &self,
        isa: I,
        velocities: &[I::Row],
        first: [usize; 2],
    ) -> ContactVector<D, F> {
        let mut velocity = point_velocity::<D, I>(isa, velocities, first[0], self.rigid, self.arm);
        if let Some(arm) = self.surface_arm {
            velocity = velocity - point_velocity::<D, I>(isa, velocities, first[1], true, arm);
        }
        self.frame.components(velocity)
    }

    /// Adds Jᵀ λ.
    #[inline(always)]
    pub(super) fn add_impulse<I: Isa<F = F>>(
        &self,
        isa: I,
        rows: &mut [I::Row],
        first: [usize; 2],
        impulse: ContactVector<D, F>,
    ) {
        let force = self.frame.vector(impulse);
        add_force::<D, I>(isa, &mut rows[first[0]..], self.rigid, self.arm, force);
        if let Some(arm) = self.surface_arm {
            add_force::<D, I>(isa, &mut rows[first[1]..], true, arm, -force);
        }
    }

    /// Adds Jᵀ C J.
    #[inline(always)]
    pub(super) fn add_hessian<I: Isa<F = F>>(
        &self,
        isa: I,
        matrix: &mut [I::Row],
        band: &Band,
        [point, surface]: [usize; 2],
        hessian: &ContactHessian<D, F>,
    ) {
        let columns = self.frame.matrix(hessian.columns());
        let stride = unsymmetric::row_length(band.half_bandwidth()) - 1;
        let (arm, rigid) = (self.arm, self.rigid);
        let place = [unsymmetric::at(band, point, point), stride];
        add_block::<D, I>(isa, matrix, place, rigid, [arm, arm], &columns);
        if let Some(other) = self.surface_arm {
            let against = [-columns[0], -columns[1], -columns[2]];
            let blocks = [
                ([surface, surface], [other, other], columns),
                ([point, surface], [arm, other], against),
                ([surface, point], [other, arm], against),
            ];
            for ([row, column], arms, columns) in blocks {
                let place = [unsymmetric::at(band, row, column), stride];
                add_block::<D, I>(isa, matrix, place, true, arms, &columns);
            }
        }
    }
}

/// Velocity of a contact point at the start of the step, without its bias.
#[inline(always)]
pub(super) fn start_velocity<D: Dim, I: Isa>(
    isa: I,
    block: &mut Block<I::Row>,
    c: usize,
    pair: &ContactPair,
) -> ContactVector<D, I::F> {
    let velocities = &block.v;
    Touch::meet(
        isa,
        &mut block.contact,
        c,
        pair,
        #[inline(always)]
        |touch, _| touch.velocity(isa, velocities, pair.dofs()),
    )
}
