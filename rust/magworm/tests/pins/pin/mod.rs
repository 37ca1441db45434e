//! One pin: its scene, its robots, its hash.

mod hash;
mod robots;
mod table;

pub use robots::{ALL, Robots};
pub use table::check;

use magworm::{Model, Scene};
use std::path::Path;
use std::sync::Arc;

/// Control steps of a pin.
pub const CONTROL_STEPS: u64 = 500;

/// Where pins are.
pub fn folder() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/pins"))
}

/// The model of a pin's scene.
pub fn model(pin: &str) -> Arc<Model> {
    let text = std::fs::read_to_string(folder().join(format!("scenes/{pin}.toml")));
    let scene = Scene::from_toml(&text.expect("the scene of a pin")).expect("a valid scene");
    Arc::new(Model::compile(&scene).expect("a model"))
}
