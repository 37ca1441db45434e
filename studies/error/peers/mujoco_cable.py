"""MuJoCo's cable: rigid boxes on ball joints, whose plugin bends them back.

The composite welds its first box to the world; half of it is inside the wall. Contacts and constraints are
off, and no joint has damping or armature. A chain of boxes does not stretch and does not shear.

Its elastic torques enter a step explicitly and nothing is damped, so the implicit integrators, which take
damping at the end of a step, gain nothing over the semi-implicit Euler. That and Runge-Kutta 4 are run.
"""

import math
from collections.abc import Callable
from functools import partial

import mujoco

from studies.error.peers import cantilever
from studies.error.peers.measure import Series, Track, finest, measured
from studies.kit.passes import MM

MESHES = (9, 18, 27)
FINEST = 54
LIMITS = {"Euler": 2.0, "RK4": math.sqrt(8.0)}
"""Schemes by MuJoCo's names, and ω times their longest step for an undamped oscillation."""

CABLE = """
<mujoco>
  <option timestep="{step_s!r}" gravity="0 {gravity_m_s2!r} 0" integrator="{scheme}">
    <flag contact="disable" constraint="disable" autoreset="disable"/>
  </option>
  <extension><plugin plugin="mujoco.elasticity.cable"/></extension>
  <worldbody>
    <composite type="cable" curve="s" count="{nodes} 1 1" size="{whole_m!r}" offset="{start_m!r} 0 0"
        initial="none">
      <plugin plugin="mujoco.elasticity.cable">
        <config key="twist" value="{shear_modulus_pa!r}"/>
        <config key="bend" value="{youngs_modulus_pa!r}"/>
      </plugin>
      <joint kind="main" damping="0" armature="0"/>
      <geom type="box" size="{half_m!r} {half_thickness_m!r} {half_width_m!r}" density="{density_kg_m3!r}"/>
    </composite>
  </worldbody>
</mujoco>
"""


def series() -> list[Series]:
    """One of each scheme."""
    mujoco.set_mju_user_warning(lambda _: None)  # steps too long are tried on purpose
    finest_mm = finest(partial(released, "RK4"), FINEST, limit_s(FINEST, "RK4"))
    return [
        Series(
            scheme,
            measured(partial(released, scheme), {elements: limit_s(elements, scheme) for elements in MESHES}),
            finest_mm,
        )
        for scheme in LIMITS
    ]


def limit_s(elements: int, scheme: str) -> float:
    """Longest step [s] for the bending wave that turns from box to box, slowed by the boxes' own inertia."""
    box_m = cantilever.half_cell_length_m(elements)
    wave_number = 2.0 / box_m
    gyration_m = cantilever.THICKNESS_M / math.sqrt(12.0)
    slowed = math.sqrt(1.0 + (wave_number * gyration_m) ** 2)
    return LIMITS[scheme] / (cantilever.SOUND_M_S * gyration_m * wave_number**2 / slowed)


def cable(elements: int, step_s: float, scheme: str) -> str:
    """The model as MuJoCo's XML."""
    box_m = cantilever.half_cell_length_m(elements)
    return CABLE.format(
        step_s=step_s,
        scheme=scheme,
        gravity_m_s2=-cantilever.GRAVITY_M_S2,
        nodes=elements + 1,
        whole_m=elements * box_m,
        start_m=-0.5 * box_m,
        half_m=0.5 * box_m,
        half_thickness_m=0.5 * cantilever.THICKNESS_M,
        half_width_m=0.5 * cantilever.WIDTH_M,
        shear_modulus_pa=cantilever.SHEAR_MODULUS_PA,
        youngs_modulus_pa=cantilever.YOUNGS_MODULUS_PA,
        density_kg_m3=cantilever.DENSITY_KG_M3,
    )


def released(scheme: str, elements: int, step_s: float) -> Callable[[], Track]:
    """The cable at rest, and what runs it."""
    model = mujoco.MjModel.from_xml_string(cable(elements, step_s, scheme))
    data = mujoco.MjData(model)

    def run() -> Track:
        mujoco.mj_step(model, data, round(cantilever.DURATION_S / step_s))
        mujoco.mj_kinematics(model, data)
        along = data.geom_xmat[-1].reshape(3, 3)[:, 0]
        x, y, _ = MM * (data.geom_xpos[-1] + model.geom_size[-1, 0] * along)
        return cantilever.tip_only(x, y)

    return run
