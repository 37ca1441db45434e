//! Batched simulator of magnet-driven soft worms (MagWorm, Soft Robotics, DOI 10.1089/soro.2019.0167).
//!
//! `Scene` (what a person writes) → [`model::Model`] (compiled, shared) → [`state::Block`] (the state of
//! environments, one per lane) → [`step`] → [`observe`]. A [`state::Batch`] holds many blocks and runs
//! them on all cores.
//!
//! | module | what it holds |
//! |---|---|
//! | [`integrate`] | the coefficients of the integrators |
//! | [`scene`] | what a person writes; validation |
//! | [`model`] | mesh, unknowns, springs, masses, the program of terms |
//! | [`state`] | blocks, batches, snapshots |
//! | [`lanes`] | vectors of environments, elementary functions, banded systems |
//! | [`elastic`] | kinematics, stretching and bending of the rod |
//! | [`magnetic`] | field of a cuboid, wrench between cuboids, dipoles |
//! | [`contact`] | ground contact and friction |
//! | [`actuator`] | what moves the drive magnets: action, observation, motion |
//! | [`equations`] | the equations of one step |
//! | [`step`] | a step as a table of contents |
//! | [`record`] | many scenes, each run once and watched |
//! | [`share`] | what each phase of a step costs |
//! | [`observe`], [`reset`] | observations and actions; initial states |

#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod actuate;
pub mod actuator;
pub mod contact;
pub mod draws;
pub mod elastic;
pub mod equations;
pub mod integrate;
pub mod lanes;
pub mod magnetic;
pub mod model;
pub mod observe;
pub mod record;
pub mod reset;
pub mod scene;
pub mod share;
pub mod specification;
pub mod state;
pub mod step;
