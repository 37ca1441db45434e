"""The page ``docs/growth.md``: everything on it follows from the results."""

import os
from collections.abc import Mapping, Sequence

from magworm_gym import SceneError
from studies.growth.fit import Exponent, exponent
from studies.growth.measure import CONTROL_STEPS, Cost, Setting, setting
from studies.growth.memory import FEW, MANY, Memory
from studies.growth.sweeps import BEYOND, PITCH_M, Sweep
from studies.ppo_share import ENVIRONMENTS, ROLLOUTS, Share, table

PLACES = {False: "plane", True: "space"}
WORK = {"wall": "seconds", "processor": "processor_s", "systems": "systems", "wrenches": "wrenches"}
"""What is fitted: its name on the page, and that of the attribute."""


Results = Mapping[tuple[str, bool], Sequence[tuple[Setting, Cost]]]


def introduction() -> str:
    """What was measured, and how."""
    return f"""# Growth of cost

Written by `make study-growth`; do not edit. The cost of a control step of 20 ms, ten solver steps, of
`paper-3` (plane) and `turn-3` (space), while one thing is varied: wall time, and work counted by the
simulator, once for the eight environments of a block: *systems* are the linear systems with contact that
were solved, *wrenches* those of one drive magnet on one body magnet and of two body magnets on each other,
which are computed twice where both are as far from the middle of the robot. *Processor* is the time of all
processors together, which other programs disturb less. Each time is the least of several runs of the same
first {CONTROL_STEPS} control steps with random actions, in one call of `Batch.rollout`, on {os.cpu_count()}
cores. Exponents are those of cost ∝ size^p, by least squares on the logarithms of the upper half of a sweep
(four points at least), with their standard error. The ranges end where the rules of a scene do:

{beyond()}

![Time of a control step against environments, nodes, magnets and drive magnets](images/growth.png)

*Time of a control step: of all processors, and dotted on the wall clock. Broken lines: exponent 1, through
the largest size.*

Data: `studies/growth/sweeps.csv`, `studies/growth/ppo.csv`."""


def beyond() -> str:
    """What the simulator says to the first scene beyond each range."""
    sentences = []
    for edits in BEYOND:
        try:
            setting(False, edits)
        except SceneError as refusal:
            sentences.append(f"- {refusal}")
    return "\n".join(sentences)


def page(
    sweeps: Sequence[Sweep], results: Results, memories: Mapping[bool, Memory], shares: list[Share]
) -> str:
    """The page as Markdown."""
    parts = [introduction(), "\n## Exponents\n", exponents_table(sweeps, results)]
    for sweep in sweeps:
        parts += [
            f"\n## {sweep.title.capitalize()}\n",
            f"Held: {sweep.held}.\n",
            sweep_table(sweep, results),
        ]
    parts += ["\n## Memory\n", memory_text(memories), "\n## Share of a training\n", share_text(shares)]
    return "\n".join(parts) + "\n"


def exponents_table(sweeps: Sequence[Sweep], results: Results) -> str:
    """Fitted exponents of wall time and of counted work."""
    work = [f"{place}: {what}" for place in PLACES.values() for what in WORK]
    lines = [f"| size | from | {' | '.join(work)} |", "| --- |" + " --- |" * (1 + len(work))]
    for sweep in sweeps:
        fits = {space: fitted(sweep, results[sweep.name, space]) for space in PLACES}
        first = fits[False][0]
        if first is not None:
            cells = [_power(fit) for space in PLACES for fit in fits[space]]
            lines.append(f"| {sweep.title} | {first.least} | {' | '.join(cells)} |")
    return "\n".join(lines)


def fitted(sweep: Sweep, points: Sequence[tuple[Setting, Cost]]) -> list[Exponent | None]:
    """Exponents of wall time, processor time, systems and wrenches."""
    sizes = [sweep.size(of) for of, _ in points]
    costs = [cost for _, cost in points]
    columns = [[getattr(cost, name) for cost in costs] for name in WORK.values()]
    return [exponent(sizes, column) for column in columns]


def sweep_table(sweep: Sweep, results: Results) -> str:
    """Every point of a sweep."""
    heads = [f"{place}: wall, ms | processor, ms | systems | wrenches" for place in PLACES.values()]
    lines = [f"| {sweep.title} | {' | '.join(heads)} |", "| --- |" + " --- |" * 8]
    plane, space = results[sweep.name, False], results[sweep.name, True]
    for (of, flat), (_, deep) in zip(plane, space, strict=True):
        lines.append(f"| {sweep.size(of):,} | {_costs(flat)} | {_costs(deep)} |")
    broken = sum(cost.broken for points in (plane, space) for _, cost in points)
    if broken:
        lines.append(f"\n{broken} environments broke on the way.")
    if sweep.name == "drives":
        lines.append(
            f"\nThe drive magnets stand {PITCH_M * 1e3:g} mm apart; wrenches count also those that are far."
        )
    return "\n".join(lines)


def memory_text(memories: Mapping[bool, Memory]) -> str:
    """Memory of an environment."""
    lines = [
        f"Growth of the resident set from {FEW:,} to {MANY:,} environments, each count in a process of its"
        " own, and what of it is state, as a snapshot holds it; the rest is the workspace of a step.\n",
        "| | resident, kB an environment | state, kB |",
        "| --- | --- | --- |",
    ]
    for space, memory in memories.items():
        resident = "not told by the system" if memory.resident is None else f"{memory.resident / 1e3:.1f}"
        lines.append(f"| {PLACES[space]} | {resident} | {memory.state / 1e3:.1f} |")
    return "\n".join(lines)


def share_text(shares: list[Share]) -> str:
    """What a learner feels of it."""
    return (
        f"PPO of Stable-Baselines3 with {ENVIRONMENTS} environments and the settings of"
        f" `training/configs/ppo.toml` (batches of 2048), {ROLLOUTS} rollouts through `magworm_gym.sb3` after"
        " one to warm up, as `python -m studies.ppo_share` prints it. The ceiling is the same training"
        " with an environment of the same spaces that does nothing.\n\n" + table(shares)
    )


def _costs(cost: Cost) -> str:
    times = [_rounded(1e3 * seconds) for seconds in (cost.seconds, cost.processor_s)]
    return " | ".join([*times, f"{cost.systems:,.0f}", f"{cost.wrenches:,.0f}"])


def _rounded(number: float) -> str:
    """Three digits, and no fewer than the whole number has."""
    return f"{number:,.0f}" if number >= 100.0 else f"{number:.3g}"


def _power(fit: Exponent | None) -> str:
    return "" if fit is None else f"{fit.value:.2f} ± {fit.error:.2f}".replace("-", "−")
