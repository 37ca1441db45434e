"""Counts what each effect of a scene costs: ``docs/needs.md``."""

import argparse
from pathlib import Path

from magworm_gym import Scene
from studies.kit.data import read_json, read_rows, write_json, write_rows
from studies.kit.page import page
from studies.kit.study import Study
from studies.kit.timing import Stopwatch
from studies.needs import counts
from studies.needs.effects import HELD, SIDES, TASKS, Phase, by_task, costs, count_phases
from studies.needs.orders import OrderError, distance_of_order_1_m, order_errors
from studies.needs.reach import TOLERANCES, Reach, magnets, reach

HERE = Path(__file__).parent
DATA = HERE / "data"
WORTH_IT = 0.05
"""Share of the wrenches beyond which leaving them out would be worth a comparison."""


def measure(_: argparse.Namespace) -> None:
    """Counts instructions and runs robots under random actions."""
    said = Stopwatch().said
    counts.write(counts.count_all())
    said("counts")
    write_rows(DATA / "phases.csv", Phase, count_phases(), digits=8)
    said("phases")
    errors, reaches = [], []
    order_1_m = {}
    for name, scene in scenes().items():
        if scene.dimensions not in order_1_m:
            found = order_errors(magnets(scene), scene.dimensions)
            order_1_m[scene.dimensions] = distance_of_order_1_m(found)
            errors += found
        reaches.append(reach(name, scene, order_1_m[scene.dimensions]))
    write_rows(DATA / "orders.csv", OrderError, errors)
    write_json(DATA / "reach.json", reaches)
    said("reach")


def scenes() -> dict[str, Scene]:
    """Presets, and a belt with more drive magnets than its robot meets."""
    found = {name: Scene.preset(name) for name in ("paper-3", "turn-3", "belt-125")}
    belt = found["belt-125"].with_values({"drive.arrangement.count": 16})
    return {**found, "belt-125 with 16": belt}


def pages() -> dict[str, str]:
    """The page from the data."""
    counted = counts.committed()
    phases = by_task(read_rows(DATA / "phases.csv", Phase))
    reaches = read_json(DATA / "reach.json", list[Reach])
    text = page(
        HERE / "page.md",
        sides=SIDES,
        counts=counted,
        phases=phases,
        totals={task: sum(of.values()) for task, of in phases.items()},
        columns=(columns := [f"{name}-{side}" for name in ("step", "no-ground") for side in SIDES]),
        names=dict.fromkeys(phase for column in columns for phase in phases[column]),
        costs=costs(counted, phases),
        tasks=TASKS,
        held=HELD,
        reaches=reaches,
        strictly=left_out(reaches, min(TOLERANCES), 0.0),
        loosely=left_out(reaches, max(TOLERANCES), WORTH_IT),
        orders=read_rows(DATA / "orders.csv", OrderError),
    )
    return {"needs.md": text}


def left_out(reaches: list[Reach], tolerance: float, share: float) -> list[str]:
    """Scenes in which more than a share of the blocks is out of reach."""
    return [
        f"`{reach.scene}`"
        for reach in reaches
        for beyond in reach.beyond
        if beyond.tolerance == tolerance and beyond.blocks > share
    ]


STUDY = Study(about="what each effect of a scene costs, in instructions", measure=measure, pages=pages)
