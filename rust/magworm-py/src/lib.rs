//! Python bindings: thin, no physics. Long work releases the interpreter's lock.

#![deny(clippy::disallowed_methods)]

mod angles;
mod arguments;
mod arrays;
mod batch;
mod errors;
mod interruption;
mod magnet;
mod memory;
mod parameters;
mod rebuild;
mod record;
mod rollout;
mod scene;
mod specification;
mod start;
mod values;

use pyo3::prelude::*;

/// The compiled simulator.
#[pymodule]
mod _magworm {
    #[pymodule_export]
    use crate::angles::{atan2, sin_cos};
    #[pymodule_export]
    use crate::batch::Batch;
    #[pymodule_export]
    use crate::errors::SceneError;
    #[pymodule_export]
    use crate::interruption::_stops_cleanly;
    #[pymodule_export]
    use crate::magnet::{cuboid_field, cuboid_wrench};
    #[pymodule_export]
    use crate::rebuild::_rebuild_batch;
    #[pymodule_export]
    use crate::record::record_scenes;
    #[pymodule_export]
    use crate::rollout::Trajectories;
    #[pymodule_export]
    use crate::scene::Scene;
    #[pymodule_export]
    use crate::specification::Specification;

    use crate::arrays::load_numpy;
    use crate::errors::declare_scene_error;
    use pyo3::prelude::*;
    use pyo3::types::PyTuple;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        load_numpy(module.py())?;
        declare_scene_error(module.py())?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        module.add("PRESETS", PyTuple::new(module.py(), magworm::scene::PRESETS)?)
    }
}
