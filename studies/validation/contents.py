"""Order of the page: sections, their cases, and what each case is compared with.

A case is named after its Rust test without ``validates_`` or ``regresses_``; one that is missing in a run
is a failure.
"""

from typing import NamedTuple


class Section(NamedTuple):
    """A section of the page."""

    title: str
    text: str
    cases: dict[str, str]


SECTIONS = (
    Section(
        "Rods at rest",
        "The rod settles under a load: the implicit scheme runs with long steps until nothing moves "
        "faster than 1e-10 m/s. *Ratio* is the error of κ = 2 tan(φ/2) over that of κ = φ.",
        {
            "heavy_cantilever": "elastica, ODE solved in the test",
            "end_moment": "closed form",
            "end_load": "elastica, ODE solved in the test; published numbers",
            "tip_magnet": "closed form",
            "pitchfork": "closed form",
            "buckling": "published critical loads",
        },
    ),
    Section(
        "Vibrations",
        "",
        {
            "cantilever_frequencies": "closed form",
            "implicit_frequency": "closed form of the scheme",
            "kelvin_voigt_decay": "closed form",
            "moduli_over_four_decades": "closed form",
            "stress_relaxation": "closed form",
            "creep": "closed form",
            "relaxing_oscillator": "closed form",
            "dynamic_cantilever": "another discretisation",
            "compass_needle": "closed form",
            "free_suspension": "closed form",
            "suspension_at_rest": "the pair's wrench",
            "energy_of_a_suspension": "conservation law",
        },
    ),
    Section(
        "Conservation",
        "Rows near 1e-13 are rounding: they are bounded, not compared.",
        {
            "energy_over_hundred_periods": "conservation law",
            "explicit_energy": "conservation law",
            "free_fall": "closed form",
            "momentum_in_free_flight": "conservation law",
            "rigid_rotation_is_undamped": "conservation law",
            "implicit_rotation_loses_only_its_truncation": "closed form of the scheme",
            "constraint_drift": "bound of the scheme",
        },
    ),
    Section(
        "Contact and friction",
        "Signorini's law and Coulomb friction with a static and a dynamic coefficient; impacts are "
        "inelastic. Gravity is turned by `ground.incline_deg`.",
        {
            "friction_angle": "closed form",
            "friction_angle_of_feet": "closed form",
            "creep_over_a_far_drive": "closed form",
            "sliding_acceleration": "closed form",
            "stopping_distance": "closed form",
            "axial_friction": "closed form, published test",
            "inelastic_landing": "closed form",
            "rebound": "closed form, second law",
            "foot_rocks_on_its_edge": "closed form",
            "rounded_feet_roll": "closed form",
            "feet_stop_at_each_other": "conservation law, statics",
            "contact_at_nodes": "statics",
            "impact_takes_energy": "second law",
            "weight_at_rest": "statics",
        },
    ),
    Section(
        "In space",
        "The same mechanics with `dimensions = 3`: bending about two axes, twist, magnets that turn about "
        "any axis, friction in any direction along the ground.",
        {
            "space_bending_as_in_the_plane": "the planar kernel",
            "space_twist_of_a_rod": "closed form",
            "space_helix": "closed form",
            "space_buckling": "published critical loads",
            "space_momentum_in_free_flight": "conservation law",
            "space_momenta_of_an_asymmetric_body": "conservation law",
            "space_energy": "conservation law",
            "space_tumbling_of_a_magnet": "Euler's equations, solved in the test",
            "space_frames_do_not_drift": "frames integrated in the test",
            "space_twist_of_many_turns": "closed form",
            "space_stopping_distance": "closed form",
            "space_friction_angle": "closed form",
            "space_spinning_block": "closed form",
            "space_sliding_and_turning": "ODE solved in the test",
            "space_derivatives": "finite differences",
            "the_wrench_in_a_step_in_space": "converged table; closed forms",
            "mirror_images_in_space": "symmetry",
            "turned_scenes_in_space": "symmetry",
            "presets_in_space": "the planar kernel",
        },
    ),
    Section(
        "Magnets",
        "Cuboids of unit permeability and uniform, rigid magnetisation.",
        {
            "the_field_at_a_thousand_points": "60-digit arithmetic",
            "every_reference_wrench": "converged table",
            "the_published_torque_of_two_large_magnets": "converged value",
            "symmetries_of_the_wrench": "symmetry",
            "the_far_field": "dipoles",
            "two_body_magnets": "converged values, checked against a closed form",
            "fold_of_a_free_rod": "closed form",
            "momenta_of_magnets_in_free_flight": "conservation law",
        },
    ),
    Section(
        "The robot",
        "There is no closed form of a crawling robot. Here the simulator is compared with itself: two "
        "schemes, and finer steps, meshes and quadratures. Stick and slip make the stride of a single pass "
        "jump where anything changes a little; the mean over neighbouring passes converges as the scheme "
        "does.",
        {
            "integrators_agree": "the other scheme",
            "stride_converges_in_the_step": "refined step",
            "stride_in_the_mesh": "refined mesh",
            "stride_in_the_quadrature": "refined quadrature",
        },
    ),
    Section(
        "What the presets are fitted to",
        "The presets are identified from these figures of the paper, so they validate nothing: they say that "
        "the fit still holds.",
        {
            "lift": "the paper's figure, fitted",
            "pass": "the paper's figures, fitted",
            "pass_of_the_experiment": "the paper's figures, fitted",
            "ablations": "the paper's words, fitted",
        },
    ),
)

NAMES = tuple(name for section in SECTIONS for name in section.cases)
