//! The simulator against independent answers: closed forms, ordinary differential equations solved in
//! the test, finite differences, dense algebra. Every test prints what it measured, so that
//! `cargo test --test validation -- --nocapture` gives a table of errors; what a [`report::Case`] holds is also
//! in `docs/validation.md`.

#[path = "../base/mod.rs"]
mod base;
mod beam;
mod report;
mod space_world;
mod world;

mod contact_block;
mod contact_feet;
mod contact_impact;
mod contact_nodes;
mod contact_rebound;
mod contact_robust;
mod contact_rock;
mod contact_rounded;
mod contact_slide;
mod contact_weight;
mod crawl;
mod crawl_converges;
mod derivatives;
mod dynamics;
mod energy;
mod explicit;
mod flight;
mod magnet_field;
mod magnet_symmetry;
mod magnet_wrench;
mod mutual;
mod oblique;
mod odd_bodies;
mod off_centre;
mod relaxing;
mod relaxing_stability;
mod space_asymmetric;
mod space_bending;
mod space_buckling;
mod space_crawl;
mod space_derivatives;
mod space_dumbbell;
mod space_energy;
mod space_flight;
mod space_frames;
mod space_helix;
mod space_pendulum;
mod space_slide;
mod space_symmetry;
mod space_tumbling;
mod space_twist;
mod space_wrench;
mod statics;
mod statics_buckling;
mod statics_magnet;
mod suspension;
