"""Strides of a robot that carries a load, spread evenly over its body.

The paper's robot carries 75 % of its weight on a tail that is folded forward and locks to a body magnet. Here
the body is heavier by the load and as stiff as before: what weight and inertia do, not what their place does.
"""

from typing import Any

from studies.paper.damaged import crawls
from studies.paper.figures import PAPER, legend_beside, panels
from studies.paper.passes import Stride, Walk, measured_strides
from studies.paper.quantity import Origin, Quantity, number
from studies.paper.robot_picture import MM
from studies.paper.scenes import robot
from studies.paper.section import Image, Section, table

LOADS_PERCENT = (0.0, 25.0, 50.0, 75.0, 100.0, 150.0, 200.0, 300.0)
PAPER_PERCENT = 75.0
SPEEDS_MM_S = (50.0, 80.0, 110.0, 150.0, 210.0)


def load_section() -> Section:
    """Runs the robot with three magnets and every load at every speed."""
    walks = [
        Walk(robot(3).with_values({"reset.vary": [_heavier(load)]}), 1e-3 * speed)
        for load in LOADS_PERCENT
        for speed in SPEEDS_MM_S
    ]
    found = measured_strides(walks)
    width = len(SPEEDS_MM_S)
    strides = {load: found[width * at : width * (at + 1)] for at, load in enumerate(LOADS_PERCENT)}
    return Section(
        title="Carrying a load",
        text=_text(strides),
        images=[
            Image(
                "load",
                "Stride against the load at five speeds of the drive; dotted: the paper's load.",
                _figure(strides),
            )
        ],
        quantities=[_quantity(strides[PAPER_PERCENT])],
        data={f"{load:g} %": [MM * stride.mean_m for stride in row] for load, row in strides.items()}
        | {"speed_mm_s": list(SPEEDS_MM_S)},
    )


def _heavier(load_percent: float) -> dict[str, Any]:
    """What makes every mass of a robot, and with it its weight, greater by a load."""
    factor = 1.0 + load_percent / 100.0
    return {"parameter": "mass", "low": factor, "high": factor}


def _quantity(strides: list[Stride]) -> Quantity:
    return Quantity(
        "load.crawls",
        f"Load of {PAPER_PERCENT:g} %: speeds at which three magnets crawl, of {len(SPEEDS_MM_S)}",
        "",
        sum(crawls(stride) for stride in strides),
        Origin.HELD_BACK,
        claim="maintains crawling (at least one)",
        holds=(1, len(SPEEDS_MM_S)),
        digits=0,
    )


def _text(strides: dict[float, list[Stride]]) -> str:
    header = ["load, % of the weight", *(f"{speed:g} mm/s" for speed in SPEEDS_MM_S)]
    rows = [[f"{load:g}", *(_cell(stride) for stride in row)] for load, row in strides.items()]
    return (
        "Three magnets; the load is spread evenly over the body: weight and inertia grow, stiffness stays. "
        "The paper's load lies on a folded tail whose magnet locks to the body; that is not simulated. "
        "Strides in mm, averaged as above; in brackets where the robot does not crawl, in the sense of the "
        "next section.\n\n" + table(header, rows)
    )


def _cell(stride: Stride) -> str:
    text = f"{number(MM * stride.mean_m, 2)} ± {number(MM * stride.spread_m, 2)}"
    return text if crawls(stride) else f"({text})"


def _figure(strides: dict[float, list[Stride]]) -> Any:
    figure, axes = panels(1, 1, (6.0, 3.6))
    for at, speed in enumerate(SPEEDS_MM_S):
        means = [MM * row[at].mean_m for row in strides.values()]
        axes.plot(list(strides), means, "o-", label=f"{speed:g} mm/s")
    axes.axvline(PAPER_PERCENT, color=PAPER, lw=0.8, ls=":")
    axes.set_xlabel("load [% of the weight]")
    axes.set_ylabel("stride [mm]")
    legend_beside(axes)
    return figure
