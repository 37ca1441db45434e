//! Batched simulator of magnet-driven soft worms (MagWorm, Soft Robotics, DOI 10.1089/soro.2019.0167).
//!
//! [`Scene`] (what a person writes) → [`Model`] (compiled, shared) → [`Batch`] (environments of one model or of an
//! [`Ensemble`], advanced on all cores) → [`View`] (one environment, looked at). What an agent sees and does is declared in [`observe`].
//!
//! ```
//! use magworm::{Batch, LaneChoice, Model, scene::Scene};
//! use std::sync::Arc;
//!
//! # fn main() -> Result<(), magworm::scene::SceneError> {
//! let model = Arc::new(Model::compile(&Scene::preset("paper-3")?)?);
//! let mut batch = Batch::new(model, 8, LaneChoice::Wide, Some(1));
//! (0..8).for_each(|environment| batch.reset(environment, 0, environment as u64, None));
//! batch.advance(10);
//! let place = batch.view(0, |view| view.magnet_pose(0));
//! assert!(place.iter().all(|number| number.is_finite()));
//! # Ok(())
//! # }
//! ```
//!
//! How it is built, and which module may name which: ARCHITECTURE.md.

#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

mod actuate;
mod actuator;
mod batch;
mod contact;
mod draws;
mod elastic;
mod equations;
mod guard;
mod integrate;
mod interruption;
mod lanes;
mod magnetic;
mod model;
pub mod observe;
mod record;
mod reset;
pub mod scene;
mod share;
mod specification;
mod state;
mod step;

pub use batch::{
    Batch, Ensemble, LaneChoice, Plan, RolloutOutput, SnapshotError, Start, StepOutput, View,
};
pub use interruption::{Interrupted, Interruption};
pub use model::Model;
pub use reset::StartPose;
pub use scene::Scene;
pub use state::{Counters, Pose, Status, Twist};

/// What the tests, benches and programs of this project look into. No part of the face: it changes without notice.
#[doc(hidden)]
pub mod internals {
    pub use crate::actuate::command;
    pub use crate::batch::Pool;
    pub use crate::contact::ContactMode;
    pub use crate::draws::Draws;
    pub use crate::elastic::{Rod, kinematics};
    pub use crate::model::{
        Allowed, Anchor, Frame, PairModel, Phase, ROWS, Robot, Role, RowGroup, Wave,
    };
    pub use crate::record::{Recording, Watch, record};
    pub use crate::reset::{reset, scene_start};
    pub use crate::state::{Block, Rows};
    pub use crate::step::{Steps, advance, run_phase};

    pub mod equations {
        pub use crate::equations::{gravity, inertia, magnets, mutual, springs};
    }

    pub mod lanes {
        pub use crate::lanes::{
            Dim, InstructionSet, Isa, Mask, Number, Plane, Real, Row, Scalar, Space, Vector, WIDE,
            WIDE_SINGLE, WideTask, run_wide, run_wide_on,
        };
        pub mod math {
            pub use crate::lanes::math::{atan2, sin_cos};
        }
    }

    pub mod magnetic {
        pub use crate::magnetic::{
            Cuboid, FarPair, GaussLegendre, MAX_ORDER, MU_0, Magnet, ObliquePair, Overlap,
            PlanarDipole, PlanarPair, SpatialPair, Wrench, dipole_wrench, field_t,
            orders_by_distance, reaction, wrench,
        };
    }

    pub mod share {
        pub use crate::share::{explain, shares};
    }
}
