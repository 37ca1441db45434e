//! Scenes that stand in one batch.

use crate::model::Model;
use crate::observe;
use crate::scene::{Problem, SceneError};
use crate::specification::Specification;
use std::iter::repeat_n;
use std::ops::Range;
use std::sync::Arc;

/// Compiled scenes of one shape: what a batch is told and what it shows of a robot has equal sizes, units and times in all of
/// them. All else may differ, the rows of their states included.
#[derive(Clone, Debug)]
pub struct Ensemble {
    models: Vec<Arc<Model>>,
}

impl Ensemble {
    /// One scene or more.
    ///
    /// # Errors
    /// No scene, or one of another shape than the first; it is named with what differs.
    pub fn new(models: Vec<Arc<Model>>) -> Result<Self, SceneError> {
        let Some(first) = models.first() else {
            let (value, allowed) = ("an empty list".into(), "one scene or more".into());
            return Err(Problem::Value { field: "scenes".into(), value, allowed }.into());
        };
        let expected = shape(first);
        for (scene, model) in models.iter().enumerate().skip(1) {
            alike(scene, &shape(model), &expected)?;
        }
        Ok(Self { models })
    }

    /// The scenes.
    pub fn models(&self) -> &[Arc<Model>] {
        &self.models
    }

    /// The first scene, whose shape all have.
    pub fn first(&self) -> &Arc<Model> {
        &self.models[0]
    }

    /// The environments of a scene in a batch of so many: environment k of N has scene ⌊k S / N⌋ of S. So they are consecutive,
    /// and one scene has at most one more than another.
    pub fn environments(&self, scene: usize, count: usize) -> Range<usize> {
        let scenes = self.models.len() as u128;
        let begin = |scene: usize| (scene as u128 * count as u128).div_ceil(scenes) as usize;
        begin(scene)..begin(scene + 1)
    }

    /// The scene of each environment in such a batch.
    pub(super) fn scenes(&self, count: usize) -> impl Iterator<Item = usize> {
        let scenes = 0..self.models.len();
        scenes.flat_map(move |scene| repeat_n(scene, self.environments(scene, count).len()))
    }
}

impl From<Arc<Model>> for Ensemble {
    /// A single scene.
    fn from(model: Arc<Model>) -> Self {
        Self { models: vec![model] }
    }
}

/// What scenes of one batch have in common, in words.
fn shape(model: &Model) -> Vec<(String, String)> {
    let solver = &model.scene.solver;
    let control = &model.scene.control;
    let parts = |of: &str, parts: Vec<Specification>| {
        let told = |part: Specification| {
            let Specification { name, unit, size, low, high, .. } = part;
            (format!("{of}.{name}"), format!("{size} numbers in {unit} from {low} to {high}"))
        };
        parts.into_iter().map(told).collect::<Vec<_>>()
    };
    let named = [
        ("dimensions", model.dimensions().to_string()),
        ("solver.precision", format!("{:?}", solver.precision).to_lowercase()),
        ("solver.step_s", format!("{} s", solver.step_s)),
        ("control.step_s", format!("{} s", control.step_s)),
        ("control.episode_s", format!("{} s", control.episode_s)),
        ("body magnets", model.magnets().to_string()),
        ("nodes", model.nodes().to_string()),
        ("drive magnets", model.program.drive_magnets().to_string()),
        ("numbers of an action", observe::action_size(model).to_string()),
        ("numbers of an observation", observe::size(model).to_string()),
        ("drives that follow actions", u8::from(model.program.is_controlled()).to_string()),
    ];
    let named = named.map(|(name, value)| (name.to_string(), value));
    let (action, observation) = (observe::action(model), observe::observation(model));
    named
        .into_iter()
        .chain(parts("action", action))
        .chain(parts("observation", observation))
        .collect()
}

fn alike(
    scene: usize,
    found: &[(String, String)],
    expected: &[(String, String)],
) -> Result<(), Problem> {
    let differs = found.iter().zip(expected).find(|(found, expected)| found != expected);
    let Some(((name, value), (of, wanted))) = differs else { return Ok(()) };
    let allowed = format!("{of} = {wanted}, as in scenes[0]: a batch has scenes of one shape");
    let value = format!("a scene with {name} = {value}");
    Err(Problem::Value { field: format!("scenes[{scene}]"), value, allowed })
}
