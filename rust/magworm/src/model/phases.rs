//! The phases of a step that a scene needs.

use super::{ContactPair, Program};

/// A part of a solver step. What a scene lacks has no phase, so it costs nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Positions, lengths and directions that follow from the unknowns.
    Kinematics,
    /// M on the left, M v on the right.
    Inertia,
    /// Weight.
    Gravity,
    /// Wrench of the drive, torque of a uniform field.
    Magnets,
    /// Wrenches of the body magnets on each other.
    Mutual,
    /// Stretching, bending and twisting with their damping; multipliers where the integrator has them.
    Springs,
    /// The linear system of a step without ground.
    System,
    /// Gaps and velocities of the contact points.
    ContactPoints,
    /// Elimination of the soft unknowns.
    Condensation,
    /// Newton's iteration for the velocities of the bodies; one linear system where nothing touches.
    Contact,
    /// Velocities of the soft unknowns.
    Recovery,
    /// The new state, and whether it is sound.
    Commit,
    /// Motion of the actuators.
    Drive,
}

impl Phase {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Kinematics => "kinematics",
            Self::Inertia => "inertia",
            Self::Gravity => "gravity",
            Self::Magnets => "magnets",
            Self::Mutual => "mutual magnets",
            Self::Springs => "springs",
            Self::System => "system",
            Self::ContactPoints => "contact points",
            Self::Condensation => "condensation",
            Self::Contact => "contact",
            Self::Recovery => "recovery",
            Self::Commit => "commit",
            Self::Drive => "drive",
        }
    }

    /// Those that a program needs, in the order in which they run.
    pub(super) fn of(program: &Program, contacts: &[ContactPair]) -> Vec<Self> {
        let magnetic = program.magnetics.is_some() || program.uniform_field.is_some();
        let touches = program.contact.is_some() && !contacts.is_empty();
        let phases = [
            (Self::Kinematics, true),
            (Self::Inertia, true),
            (Self::Gravity, program.gravity_m_s2.is_some()),
            (Self::Magnets, magnetic),
            (Self::Mutual, program.mutual.is_some()),
            (Self::Springs, true),
            (Self::System, !touches),
            (Self::ContactPoints, touches),
            (Self::Condensation, touches),
            (Self::Contact, touches),
            (Self::Recovery, touches),
            (Self::Commit, true),
            (Self::Drive, !program.actuators.is_empty()),
        ];
        phases.into_iter().filter(|(_, needed)| *needed).map(|(phase, _)| phase).collect()
    }
}
