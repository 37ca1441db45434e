//! The Maxwell branches of rubber that relaxes, for the steps of a scene. All springs share them: r and τ are the material's.

use crate::integrate::Maxwell;
use crate::scene::Scene;

/// What relaxing branches add to every spring, as parts of its stiffness; nothing where there are none.
#[derive(Clone, Debug, PartialEq)]
pub struct Relaxation {
    /// The branches, in the scene's order.
    pub branches: Vec<Branch>,
    /// What they add to a₁ and b₁ of the integrator, see [`crate::integrate`].
    pub steps: [f64; 2],
}

/// A Maxwell branch in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Branch {
    /// What the strain beyond its dashpot's adds to that of the spring.
    pub share: f64,
    /// The part of that strain that flows into the dashpot.
    pub flow: f64,
}

impl Relaxation {
    /// Those of a scene.
    pub fn new(scene: &Scene) -> Self {
        let (solver, mut steps) = (&scene.solver, [0.0; 2]);
        let branch = |one: &crate::scene::Relaxation| {
            let fading = Maxwell::over(solver.step_s / one.time_s);
            let [share, before, after] = (solver.integrator.coefficients().branch)(fading);
            steps = [steps[0] + one.ratio * before, steps[1] + one.ratio * after];
            Branch { share: one.ratio * share, flow: fading.flow }
        };
        let branches = scene.material.relaxation.iter().map(branch).collect();
        Self { branches, steps }
    }
}
