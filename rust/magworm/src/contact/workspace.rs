//! What the contact solve of a step works with.

use super::law::RESPONSE;
use crate::lanes::{Row, unsymmetric};
use crate::model::Model;
use crate::state::Rows;

/// Rows of the contact solve of one step; nothing in here outlives it.
#[derive(Clone, Debug)]
pub struct Workspace<R: Row> {
    /// From a point's body to the point [m], shape [contacts × D].
    pub arm: Rows<R>,
    /// What is known of the velocity that the law of a point sees [m/s]: upwards the gap over the time within
    /// which it closes, and what rotation bends, shape [contacts × D].
    pub bias: Rows<R>,
    /// Coefficient of friction in this step, shape [contacts].
    pub coefficient: Rows<R>,
    /// Impulses of the step before, upwards and along the ground: there λ⁰ [N·s], shape [contacts × D].
    pub warm: Rows<R>,
    /// Greatest tangential impulse where friction has a bound of its own [N·s], shape [contacts].
    pub bound: Rows<R>,
    /// Impulses linearised in the velocities of the points, see `law::Response`, shape [contacts × 9].
    pub response: Rows<R>,
    /// 1 where a point was closed or is about to sink at the start of the step, shape [contacts].
    pub touching: Rows<R>,
    /// Direction in which friction pushed a point when it was linearised last, shape [contacts × 2].
    pub slip: Rows<R>,
    /// Velocities of the points, with the bias [m/s], shape [contacts × D].
    pub velocity: Rows<R>,
    /// How they change along the direction of search, shape [contacts × D].
    pub velocity_change: Rows<R>,
    /// Matrix of Newton's iteration, unsymmetric.
    pub matrix: Rows<R>,
    /// Its right-hand side, then its solution, with ghost rows.
    pub target: Rows<R>,
    /// v: velocities of the kept unknowns, shape [kept].
    pub known: Rows<R>,
    /// Direction of search, shape [kept].
    pub direction: Rows<R>,
    /// S v − s: what contact has to balance [N·s], shape [kept].
    pub imbalance: Rows<R>,
    /// How it changes along the direction, shape [kept].
    pub imbalance_change: Rows<R>,
    /// S v − s − Jᵀ λ at a trial [N·s], shape [kept].
    pub residual: Rows<R>,
    /// 1 over the diagonal of S [1/kg], shape [kept].
    pub mobility: Rows<R>,
    /// The search of each lane, see `search::Search`, shape [6].
    pub search: Rows<R>,
}

impl<R: Row> Workspace<R> {
    /// Room for the contacts of a model.
    pub fn new(model: &Model) -> Self {
        let contacts = model.contacts.len();
        let of_contacts = |rows| Rows::zeros(rows * contacts);
        // Where nothing touches, nothing is solved here.
        let size = |rows| Rows::zeros(if contacts == 0 { 0 } else { rows });
        let (dimensions, kept) = (model.dimensions(), model.system.kept());
        Self {
            arm: of_contacts(dimensions),
            bias: of_contacts(dimensions),
            coefficient: of_contacts(1),
            warm: of_contacts(dimensions),
            bound: of_contacts(1),
            response: of_contacts(RESPONSE),
            touching: of_contacts(1),
            slip: of_contacts(2),
            velocity: of_contacts(dimensions),
            velocity_change: of_contacts(dimensions),
            matrix: size(unsymmetric::entries(kept)),
            target: size(unsymmetric::rows(kept)),
            known: size(kept.size()),
            direction: size(kept.size()),
            imbalance: size(kept.size()),
            imbalance_change: size(kept.size()),
            residual: size(kept.size()),
            mobility: size(kept.size()),
            search: Rows::zeros(super::search::ROWS),
        }
    }
}
