//! Rubber that relaxes: the branches of a generalised Maxwell solid beside each spring, see [`crate::integrate::Maxwell`].
//!
//! A spring k with the strain s and branches of the stiffnesses rᵢ k, whose dashpots have the strains βᵢ, acts as one with the strain
//! s + Σ rᵢ cᵢ (s − βᵢ), while the strain changes as one with the stiffness k (1 + Σ rᵢ bᵢ); the second is the same for all springs and
//! stands in [`super::Scheme`].

use crate::lanes::{Isa, Real};
use crate::model::{Branch, Relaxation};

/// The branches of a model, with the rows of the dashpots of one kind of spring.
pub(super) struct Dashpots<'a, I: Isa> {
    isa: I,
    branches: &'a [Branch],
    /// Strains of the dashpots, shape [ways to strain × branches].
    strains: &'a mut [I::Row],
    /// Lanes that run; in the others nothing flows.
    running: I::M,
}

impl<'a, I: Isa> Dashpots<'a, I> {
    #[inline(always)]
    pub(super) fn new(
        isa: I,
        relaxation: &'a Relaxation,
        strains: &'a mut [I::Row],
        running: &I::Row,
    ) -> Self {
        let running = isa.load(running).eq(isa.splat(1.0));
        Self { isa, branches: &relaxation.branches, strains, running }
    }

    /// The strain that acts in a way to strain, counted from 0; its dashpots flow.
    #[inline(always)]
    pub(super) fn act(&mut self, way: usize, strain: I::F) -> I::F {
        if self.branches.is_empty() {
            return strain;
        }
        let count = self.branches.len();
        let rows = &mut self.strains[way * count..][..count];
        let mut acting = strain;
        for (branch, row) in self.branches.iter().zip(rows) {
            let before = self.isa.load(row);
            let beyond = strain - before;
            acting = acting + beyond * branch.share;
            let after = before + beyond * branch.flow;
            self.isa.store(I::F::select(self.running, after, before), row);
        }
        acting
    }
}
