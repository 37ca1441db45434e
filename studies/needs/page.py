"""The page ``docs/needs.md``: everything on it follows from the counts."""

from collections.abc import Mapping

from studies.needs.effects import EFFECTS, SIDES, own_phases
from studies.needs.orders import HEIGHTS_M, ORDERS
from studies.needs.reach import TOLERANCES
from studies.needs.wrenches import Reach
from studies.paper.section import table
from studies.paper.wording import listed

Counts = Mapping[str, float]

HELD = (
    ("paper-3", "step-plane", "held-plane"),
    ("turn-3", "step-space", "held-space"),
    ("belt-125 with 16", "belt-16-plane", "held-belt-16-plane"),
)
"""Scenes with the tasks that compute wrenches in every step and in one of five."""

INTRODUCTION = """# Only what a scene needs

Written by `make study-needs`; do not edit. What a solver step costs, in instructions of a block of eight
robots on AVX2, counted by callgrind: equal on every run, and within a fraction of a per cent on every
processor, since nothing here is timed. The robots are those of `paper-3` (plane) and `turn-3` (space),
under random actions. The counts of the first table are committed (`studies/needs/instructions.csv`); `make
count`, which is part of `make test`, fails where one differs by more than 5 %, and `make count-write`
writes them anew. Instructions are not time: an instruction that waits for a division or for memory costs
more than one that does not. `scene.shares()` and `scene.explain(measure=True)` give the shares of time of
any scene on the machine at hand.
"""


def page(
    counts: Counts,
    of_phases: Mapping[str, Counts],
    reaches: Mapping[str, Reach],
    errors: Mapping[int, Mapping[int, list[float]]],
) -> str:
    """The whole page."""
    parts = [
        INTRODUCTION,
        "## Counts\n\nPer solver step of eight robots, per wrench of eight lanes, per control step of eight\n"
        "environments; `scalar` is one robot in plain `f64`, `single` sixteen robots in single precision.\n",
        table(["task", "instructions"], [[f"`{name}`", f"{value:,.0f}"] for name, value in counts.items()]),
        _single(counts),
        _shares(of_phases),
        _effects(counts, of_phases),
        _air(counts, of_phases),
        _reach(reaches),
        _orders(counts, of_phases, reaches, errors),
        _held(of_phases),
    ]
    return "\n".join(parts) + "\n"


def _single(counts: Counts) -> str:
    shares = [counts[f"step-{side}-single"] / (2.0 * counts[f"step-{side}"]) for side in SIDES]
    plane, space = (f"{100 * share:.0f}%" for share in shares)
    return (
        f"In single precision a robot takes {plane} of the instructions of double precision in the plane\n"
        f"and {space} in space: a vector holds twice as many robots, and the block goes on until the\n"
        "slowest of sixteen is done instead of eight.\n"
    )


def _shares(of_phases: Mapping[str, Counts]) -> str:
    columns = [f"{name}-{side}" for name in ("step", "no-ground") for side in SIDES]
    names = list(dict.fromkeys(phase for column in columns for phase in of_phases[column]))
    totals = {column: sum(of_phases[column].values()) for column in columns}

    def cell(column: str, phase: str) -> str:
        value = of_phases[column].get(phase)
        return "–" if value is None else f"{value:,.0f} ({value / totals[column]:.1%})"

    rows = [[phase, *(cell(column, phase) for column in columns)] for phase in names]
    return f"""
## Shares of the phases

A step goes through the phases that the model's program has; a phase that a scene lacks is absent (–).
*System* is the linear system of a scene without ground; with ground *condensation*, *contact* and
*recovery* take its place.

{table(["phase", *(f"`{column}`" for column in columns)], rows)}"""


def _effects(counts: Counts, of_phases: Mapping[str, Counts]) -> str:
    rows, remains = [], []
    for effect in EFFECTS:
        for side in SIDES:
            here, there = counts[f"{effect.with_it}-{side}"], counts[f"{effect.without}-{side}"]
            own = own_phases(effect, side, of_phases)
            # What a program with the effect does apart from it, against a program that never had it.
            remain = None if own is None else (here - own) / there - 1.0
            remains += [] if remain is None else [abs(remain)]
            rows.append(
                [
                    effect.words,
                    side,
                    f"{there:,.0f}",
                    f"{here:,.0f}",
                    f"{here - there:+,.0f} ({here / there - 1.0:+.1%})",
                    "–" if remain is None else f"{remain:+.2%}",
                ]
            )
    header = ["effect", "", "without", "with", "cost", "rest against without"]
    return f"""
## What each effect costs

A rod that bends (`bare`: no ground, drive, gravity or damping) with one effect more; friction and adhesion
against the same crawl without, where robots move differently and so the contact solve does. *Rest against
without*: the instructions of the scene with the effect, less those of the phases that it has for it alone,
beside the scene that never had it. That is what the effect leaves behind where it is absent: at most
{max(remains):.2%}. Damping and lost magnets cost nothing since they are numbers that are there in any case:
a factor of the springs, a remanence of 0.

{table(header, rows)}"""


def _air(counts: Counts, of_phases: Mapping[str, Counts]) -> str:
    rows = []
    for side in SIDES:
        air, none, step = (counts[f"{name}-{side}"] for name in ("air", "no-ground", "step"))
        of_air, of_none = of_phases[f"air-{side}"], of_phases[f"no-ground-{side}"]
        system = sum(of_air[phase] for phase in ("condensation", "contact", "recovery"))
        rows.append(
            [
                side,
                f"{step:,.0f}",
                f"{air:,.0f}",
                f"{none:,.0f}",
                f"{of_air['contact points']:,.0f}",
                f"{system:,.0f}",
                f"{of_none['system']:,.0f}",
            ]
        )
    header = [
        "",
        "crawling",
        "in the air",
        "no ground",
        "contact points",
        "system in the air",
        "system without ground",
    ]
    return f"""
## Blocks in the air

Where no point of a block touches at the start of a step and none would at its end, contact is one linear
system, without a trial, and no law of contact is evaluated; a test holds both
(`rust/magworm/tests/air.rs`). It is the system of Newton's own first iterate, with its elimination and its
test of the residual, since a robot must have the same bits whether its neighbours touch or not. That is why
it costs more than the banded system of a scene without ground: soft unknowns are eliminated towards the
bodies first, and the system of the bodies is solved as an unsymmetric one.

{table(header, rows)}"""


def _reach(reaches: Mapping[str, Reach]) -> str:
    rows = [
        [
            f"`{name}`",
            f"{1e3 * reach.nearest_m:.0f} to {1e3 * reach.farthest_m:.0f}",
            f"{tolerance:.0e}",
            f"{1e3 * reach.limits_m[tolerance]:.0f}",
            f"{reach.shares[tolerance][0]:.1%}",
            f"{reach.shares[tolerance][1]:.1%}",
        ]
        for name, reach in reaches.items()
        for tolerance in TOLERANCES
    ]
    header = [
        "scene",
        "centres [mm]",
        "tolerance",
        "out of reach beyond [mm]",
        "of wrenches",
        "of blocks of eight",
    ]
    return f"""
## Magnets out of reach

Two dipoles at a distance r exert at most 3 μ₀ m₁ m₂/(2π r⁴) on each other, and a magnet is a distribution
of dipoles. So the force between two cuboids that are nowhere nearer than d is within 3 μ₀ m₁ m₂/(2π d⁴),
whatever their shapes. Beyond the distance of centres at which that bound is the tolerance, in weights of
the robot, a wrench could be left out; but only a block all of whose lanes are out of reach saves anything.
Random actions:
{reaches_words(reaches)}.

{table(header, rows)}

{_verdict(reaches)}"""


def _verdict(reaches: Mapping[str, Reach]) -> str:
    """What the table says, at the strictest tolerance and at the loosest."""
    strict, loose = min(TOLERANCES), max(TOLERANCES)
    far = [name for name, reach in reaches.items() if reach.shares[strict][1] > 0.0]
    paying = [name for name, reach in reaches.items() if reach.shares[loose][1] > 0.05]
    where = f"only in {listed([f'`{name}`' for name in far])}" if far else "in none of these scenes"
    loosely = f"in {listed([f'`{name}`' for name in paying])}" if paying else "nowhere"
    return f"""What is left out acts on every magnet and always to one side, so the tolerance has to be small
beside what decides whether a foot sticks. At {strict:.0e} of the weight something could be left out
{where}; at {loose:.0e} the gain would be more than a twentieth of the wrenches {loosely}. Wrenches
are not skipped: a comparison in every step would save nothing in the scenes that robots learn in, and a belt
of more magnets than its robot meets is better given fewer (`drive.arrangement.count`)."""


def reaches_words(reaches: Mapping[str, Reach]) -> str:
    """How many distances were seen."""
    return listed([f"{reach.wrenches:,} wrenches of `{name}`" for name, reach in reaches.items()])


def _orders(
    counts: Counts,
    of_phases: Mapping[str, Counts],
    reaches: Mapping[str, Reach],
    errors: Mapping[int, Mapping[int, list[float]]],
) -> str:
    header = ["height of centres [mm]", *(f"order {order}" for order in ORDERS)]
    parts = []
    for dimensions in (2, 3):
        of_orders = errors[dimensions]
        rows = [
            [f"{1e3 * height:.0f}", *(f"{of_orders[order][k]:.1e}" for order in ORDERS)]
            for k, height in enumerate(HEIGHTS_M)
        ]
        parts.append(f"In {'the plane' if dimensions == 2 else 'space'}:\n\n{table(header, rows)}")
    savings = [
        _saving(counts, of_phases, reaches[name], name, side, task)
        for name, side, task in (
            ("paper-3", "plane", "step-plane"),
            ("turn-3", "space", "step-space"),
            ("belt-125", "plane", "belt-plane"),
            ("belt-125 with 16", "plane", "belt-16-plane"),
        )
    ]
    header = ["scene", "wrenches in a step", "order 1 does beyond [mm]", "of blocks", "saving of a step"]
    return f"""
## Quadrature order and gap

Largest error of the force on a body magnet in weights of the robot, against order 10 in panels, the drive
60 mm to either side, at angles up to 0.7 rad. Presets take order 2; their drives come as near as 22 mm.

{parts[0]}

{parts[1]}

A lane's order may follow its own distance alone, else bits would depend on neighbours; a block in which
orders differ pays for both. Order 1 would do where its error is no more than that of order 2 at the nearest
distance; its wrench takes {_order_1("plane", counts):.0%} of the instructions of order 2 in the plane,
{_order_1("space", counts):.0%} in space:

{table(header, savings)}

The order is the scene's, `solver.quadrature_order`, and does not follow the gap: where robots learn it would
save next to nothing. On belts it would pay; the distance above is measured, and a bound of the error
remains to be found."""


def _order_1(side: str, counts: Counts) -> float:
    """Instructions of a wrench of order 1 over those of order 2."""
    return counts[f"wrench-{side}-order-1"] / counts[f"wrench-{side}"]


def _saving(
    counts: Counts, of_phases: Mapping[str, Counts], reach: Reach, name: str, side: str, task: str
) -> list[str]:
    """A row: what order 1 beyond its distance would save of a step."""
    magnets = of_phases[task]["magnets"] / sum(of_phases[task].values())
    saved = reach.order_1_blocks * magnets * (1.0 - _order_1(side, counts))
    cells = [f"{magnets:.1%}", f"{1e3 * reach.order_1_m:.0f}", f"{reach.order_1_blocks:.1%}", f"{saved:.1%}"]
    return [f"`{name}`", *cells]


def _held(of_phases: Mapping[str, Counts]) -> str:
    rows = []
    for name, every, held in HELD:
        magnets, rest = of_phases[every]["magnets"], of_phases[held]["magnets"]
        saved = (magnets - rest) / sum(of_phases[every].values())
        rows.append([f"`{name}`", f"{magnets:,.0f}", f"{rest:,.0f}", f"{saved:.1%}"])
    header = ["scene", "phase *magnets*, every step", "one step in five", "saving of a step"]
    return f"""
## Wrenches that act for several steps

With `solver.wrench_interval = 5` a step computes the wrenches, and the four that follow take them as they
were. What that does to trajectories is in [performance.md](performance.md#how-often-a-wrench-is-computed).
A scene without it holds no numbers, and its step asks once whether it should.

{table(header, rows)}"""
