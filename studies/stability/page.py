"""The page ``docs/stability.md``: its numbers follow from the results."""

import csv
from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import groupby
from pathlib import Path

from magworm_gym import Scene
from studies.stability.axes import ALONE, CROSSED, Axis
from studies.stability.cases import FINER, INTEGRATORS, STEP_S, TOLERANCE, VERDICTS, Case, Outcome
from studies.stability.energy import BAND, Swing
from studies.stability.limits import Limit, refusal
from studies.stability.starts import (
    EXPLICIT_S,
    SHORT_S,
    SHORTEST_EXPLICIT_S,
    STARTS,
    WATCHED_MS,
    StartCase,
    Untying,
    lies_in_the_plane,
    schemes,
)

IMAGES = "images/stability"
PRESET_LIMIT_S, _ = Scene.preset("paper-3").explicit_limit()
"""The longest step of the explicit scheme for the preset [s]."""
WHERE = {2: "plane", 3: "space"}
Row = Sequence[object]

INTRODUCTION = f"""# Stability

Written by `make study-stability`; do not edit. What each integrator does with stiff and extreme scenes,
from the softest rubber to steel and from short steps to the longest that a scene allows.

Two bodies are swept. The *rod* is the preset `cantilever` with ten elements and a retardation time of 1
ms, let go from the horizontal. The *robot* has three magnets that do not act on each other, over a drive
magnet that goes by at 100 mm/s, 22 mm beneath the ground (`rust/magworm/tests/data/robot.toml`). It is not
`paper-3`, whose rubber damps so much that `explicit` would need steps of {1e9 * PRESET_LIMIT_S:.0f} ns. The
step is {1e3 * STEP_S["newmark"]:g} ms for `newmark` and `euler` and {
    1e6
    * STEP_S["explicit"]:g} µs for `explicit` unless it is what is swept; the former run for 0.6 s, the latter
for 0.1 s (rod) and 0.05 s (robot). Each case gets a verdict:

- *accurate*: no node is ever further than {100 * TOLERANCE:g} % of the body's length from where a step
  {FINER} times shorter has it (10 µs at the least for the implicit schemes, which is their shortest), 50
  ms apart;
- *stable*: it ran to its end, and it is further off, or there is no shorter step to compare with;
- *refused*: the scene is not valid, with a sentence that says why;
- *broken*: the run stopped with a status that says why, and the robot stood still from then on.

The percentage beside a verdict is the greatest distance over the body's length. In every case, whatever
its verdict, all that came out was finite; the study stops if that fails. A chaotic motion, such as that
of a robot that is thrown about, is hardly ever accurate: the distance then tells how far two motions
part, not how wrong either is.
"""

LIMITS = """
## The largest step of the explicit scheme

For an oscillation of angular frequency ω and a retardation time τ the explicit scheme is stable while
Δt²ω² + 2Δtτω² ≤ 4, that is up to

    Δt = (4/ω²) / (τ + √(τ² + 4/ω²)),

which is 2/ω without damping and 2/(τω²) where τω ≫ 1. The fastest oscillation of the straight rod at rest
decides: stretching, bending about either axis or twisting, computed from the model's own masses and
springs (`rust/magworm/src/model/waves.rs`). A scene with a longer step is refused, for example:

> {refusal}

`Scene.explicit_limit()` gives the limit of any scene. It is that of small motions: contact is implicit
and magnets held by multipliers bring no frequency of their own, but an element squeezed to a share s of
its length bends faster by 1/s, and the gradient of a magnet's force counts as a spring. Factors that a
batch sets for single environments are not looked at; ranges in `reset.vary` are.

Predicted and found by bisection with runs of 4000 steps; the rods are those of
`studies/stability/limits.py`. That of strong damping is found a little late: just beyond its limit a
motion grows slowly.

"""

BROKEN = """
## What breaks, and why

- *The ground holds soles only.* Bridges, and all of a foot but its corners, pass through the ground.
  Robots that are thin, or crushed by strong magnets, swing their middle into it and stop with the status
  that says so, whichever the scheme. This is what the model leaves out, not a failure of a scheme.
- *Magnets within each other.* A drive that goes through the body passes through the robot's magnets.
  There the field of a cuboid has edges where it is infinite, and forces change within less than a step:
  what comes out depends on the step, and robots may be thrown for metres. All of it stays finite.
- *Elements turned by much in one step.* The implicit schemes are linear in a step. An element that turns
  by Δφ in it comes out longer by Δφ²/2; stiff rubber then holds energy that was never put in, see above,
  until the next step takes it back.
- *The implicit schemes lose energy instead.* They are stable for any stiffness, and for long steps an
  undamped rod comes to rest far too early: what the table calls stable is often only that.
- *The softest bodies at the longest steps.* At 1 kPa and 25 to 50 ms elements are stretched beyond three
  times their length, and the run stops with that status.
- *The energy of the explicit scheme wavers* in proportion to the step; near its limit by a tenth of weight
  times length. It does not drift.
- *Much let go at once.* A body that starts tightly bent turns its elements so far in the first step of 2 ms
  that they come out, as above, more than three times as long, and the run stops. A shorter step mends it.
"""

BENT = f"""
## Bent starts

A body may start bent and twisted (`start.bends_deg`, `start.bends_aside_deg`, `start.twists_deg`). Its rest
shape is straight, so it springs open. The *rod* is here 3 mm wide and thick, in 27 elements, free and on the
ground; the *robot* is that of the sweeps. `explicit` has a step of {
    1e6 * EXPLICIT_S["robot", 2]:g} µs, in space {1e6 * EXPLICIT_S["robot", 3]:g} µs
for the robot, and is compared with {
    1e6 * SHORTEST_EXPLICIT_S:g} µs at the least; it runs no longer than in the
sweeps, so that its percentages say less. What bends aside or twists starts in space alone.

Nothing in the model keeps parts of a body apart, and its magnets do not act on each other: folded and knotted
bodies pass through themselves, here too. Which way they spring open hangs on little.

"""

LOWEST = """
A start inside the ground is refused: the lowest point of a bent body stands at `start.height_m`, which is 0
or more where there is ground. Of a straight body the lowest contact point stands there: that of a robot which
is upside down is on top, and its back starts in the ground, which holds soles only. The robot in the last row
of the picture ends so.
"""

KNOTTED = """
The centre line of the knotted rod is an overhand knot. Closed far away, or straight from end to end, it has
the determinant 3 (`studies/stability/knots.py`), which is the Alexander polynomial at −1: that of a trefoil,
where a line without a knot has 1. The study stops if the start is no trefoil. Nothing holds the knot. Looked
at every 2 ms, the line was last a trefoil after:

"""

RANDOM = """
## Random extreme scenes

`cargo test --test random_scenes extreme` runs a thousand random scenes from the ranges of this page, each
crossed with all others, half of them bent at the start, in the plane and in space, under all schemes;
`make test-nightly` runs a hundred thousand. All that can be seen of them must be finite, what has broken must
stand still, and scalar and wide lanes must agree bit for bit. Scenes that failed stay as seeds in
`rust/magworm/tests/random_scenes.proptest-regressions`.

## How to run it again

`make study-stability` writes this page, its figures and `studies/stability/*.csv`: `alone.csv` (single
axes), `crossed.csv`, `starts.csv`, `limits.csv`, `energy.csv`. `python -m studies.stability --long` also runs
all values in space under all schemes and every pair of axes at three values each (`pairs.csv`).
"""


def page(
    limits: Sequence[Limit],
    swings: Sequence[Swing],
    single: Sequence[Outcome],
    maps: Mapping[str, Sequence[Outcome]],
    bent: Sequence[Outcome],
    untied: Sequence[Untying],
    pairs: Path,
) -> str:
    """The page as Markdown.

    Args:
        limits: Largest explicit steps.
        swings: What became of the energy of undamped rods.
        single: Axes swept alone.
        maps: Pairs of axes, by the body that they are swept with.
        bent: Starts that are bent.
        untied: How long the knot lasts.
        pairs: File of the long form; what it says is left out where it does not exist.
    """
    parts = [
        INTRODUCTION,
        _summary([*single, *maps["rod"], *maps["robot"], *bent]),
        LIMITS.format(refusal=refusal()) + _limits(limits),
        "\n## Axes alone\n\nIn space the short form runs three values of each axis without `euler`.\n",
        *_axes(single),
        "\n## Axes crossed\n",
        _image(
            "rod",
            "The rod: step against stiffness and damping. Numbers: distance over the length, in percent.",
        ),
        _image(
            "robot", "The robot under `newmark`, in the plane; numbers as above, > for ten lengths or more."
        ),
        *_pairs(pairs),
        *_starts(bent, untied),
        _energies(swings),
        BROKEN,
        RANDOM,
    ]
    return "\n".join(parts)


def _summary(outcomes: Sequence[Outcome]) -> str:
    rows = []
    for integrator in INTEGRATORS:
        counts = Counter(o.verdict for o in outcomes if o.case.integrator == integrator)
        rows.append([f"`{integrator}`", *(counts[verdict] for verdict in VERDICTS)])
    return "Verdicts of all cases on this page:\n\n" + _table(["scheme", *VERDICTS], rows)


def _limits(limits: Sequence[Limit]) -> str:
    rows = [
        [
            one.name,
            WHERE[one.dimensions],
            _time(one.predicted_s),
            _time(one.found_s),
            f"{one.found_s / one.predicted_s:.4f}",
            one.reason,
        ]
        for one in limits
    ]
    return _table(["rod", "", "predicted", "found", "found/predicted", "what limits it"], rows)


def _time(time_s: float) -> str:
    return f"{1e6 * time_s:.4g} µs"


def _axes(single: Sequence[Outcome]) -> list[str]:
    """A table for each axis of each body."""
    ordered = sorted(single, key=_place)
    return [_axis(list(group)) for _, group in groupby(ordered, _place)]


def _place(outcome: Outcome) -> tuple[int, int]:
    """Place of the body, and of the axis among its own."""
    body, axis = outcome.case.body, outcome.case.settings[0][0]
    return list(ALONE).index(body), ALONE[body].index(axis)


def _axis(outcomes: Sequence[Outcome]) -> str:
    axis: Axis = outcomes[0].case.settings[0][0]
    cells = {(o.case.settings[0][1], o.case.dimensions, o.case.integrator): _cell(o) for o in outcomes}
    columns = sorted({key[1:] for key in cells}, key=lambda key: (key[0], INTEGRATORS.index(key[1])))
    head = [axis.title, *(f"{scheme}, {WHERE[dimensions]}" for dimensions, scheme in columns)]
    rows = [[f"{value:g}", *(cells.get((value, *key), "") for key in columns)] for value in axis.values]
    title = f"\n### {outcomes[0].case.body.capitalize()}: {axis.name}\n\n`{axis.keys}`\n\n"
    return title + _table(head, rows) + _sentences(outcomes)


def _cell(outcome: Outcome) -> str:
    percent = 100.0 * outcome.error
    if percent != percent:
        return outcome.verdict
    return f"{outcome.verdict} {percent:.0f} %" if percent >= 10.0 else f"{outcome.verdict} {percent:.2g} %"


def _sentences(outcomes: Sequence[Outcome]) -> str:
    """The first refusal of each scheme, and every way to break."""
    refused: dict[str, str] = {}
    broken: dict[str, None] = {}
    for outcome in outcomes:
        if outcome.verdict == "refused":
            field = outcome.sentence.split(" is ")[0]
            refused.setdefault(field, outcome.sentence)
        elif outcome.verdict == "broken":
            broken.setdefault(outcome.sentence)
    lines = [f"\nRefused, for example: {sentence}." for sentence in refused.values()]
    lines += [f"\nBroken: {sentence}." for sentence in broken]
    return "\n" + "\n".join(lines) + "\n" if lines else "\n"


def _pairs(path: Path) -> list[str]:
    """What the long form found, scheme by scheme."""
    if not path.exists():
        return []
    with path.open(encoding="utf-8") as file:
        found = list(csv.DictReader(file))
    rows = []
    for integrator in INTEGRATORS:
        for dimensions in WHERE:
            chosen = [r for r in found if (r["integrator"], r["dimensions"]) == (integrator, str(dimensions))]
            counts = Counter(row["verdict"] for row in chosen)
            rows.append([f"`{integrator}`", WHERE[dimensions], *(counts[v] for v in VERDICTS[1:])])
    drawn = sum(len(pairs) for pairs in CROSSED.values())
    text = (
        f"\nThe long form crosses every two axes of a body, not only the {drawn} pairs that are drawn, "
        "at three values of each (with no shorter step to compare with: none is called accurate):\n\n"
    )
    return [text + _table(["scheme", "", *VERDICTS[1:]], rows)]


def _starts(bent: Sequence[Outcome], untied: Sequence[Untying]) -> list[str]:
    """A table for each body, and what becomes of the knot."""
    knots = [
        [f"`{one.integrator}`", _step(one.step_s), f"{1e3 * one.until_s:g} ms", one.at_end] for one in untied
    ]
    watched = ", ".join(f"{time_ms:g}" for time_ms in WATCHED_MS)
    return [
        BENT,
        *(_body_starts(body, [o for o in bent if o.case.body == body]) for body in STARTS),
        LOWEST,
        _image(
            "starts",
            f"Bent starts under `newmark` with {1e3 * SHORT_S:g} ms after {watched} ms, seen from the side; "
            "magnets are drawn thick.",
        ),
        KNOTTED + _table(["scheme", "step", "last a trefoil", "determinant at the end"], knots),
    ]


def _body_starts(body: str, outcomes: Sequence[Outcome]) -> str:
    cells = {_start_key(outcome.case): _cell(outcome) for outcome in outcomes}
    columns = [(dimensions, *scheme) for dimensions in WHERE for scheme in schemes(body, dimensions)]
    head = [body, *(f"{name} {_step(step_s)}, {WHERE[where]}" for where, name, step_s in columns)]
    rows = [[name, *(cells.get((name, *column), "") for column in columns)] for name in STARTS[body]]
    lists = [f"- {name}: {_fields(body, name)}" for name in STARTS[body]]
    return "\n".join([_table(head, rows), "", *lists]) + "\n" + _sentences(outcomes)


def _start_key(case: Case) -> tuple[str, int, str, float]:
    assert isinstance(case, StartCase)
    return case.start, case.dimensions, case.integrator, case.step_s


def _fields(body: str, name: str) -> str:
    where = "" if lies_in_the_plane(body, name) else ", in space"
    return ", ".join(f"`{field} = {value}`" for field, value in STARTS[body][name].items()) + where


def _step(step_s: float) -> str:
    return f"{1e3 * step_s:g} ms" if step_s >= 1e-4 else f"{1e6 * step_s:g} µs"


def _energies(swings: Sequence[Swing]) -> str:
    known = [swing for swing in swings if swing.gain == swing.gain]
    rows: list[Row] = []
    for (motion, integrator), group in groupby(known, lambda s: (s.motion, s.integrator)):
        ordered = sorted(group, key=lambda s: s.step_ms)
        for step_ms, same in groupby(ordered, lambda s: s.step_ms):
            each = list(same)
            gains = [
                max(0.0, f([getattr(s, name) for s in each])) for f, name in ((max, "visible"), (max, "gain"))
            ]
            lost = [f"{f(s.lost for s in each):.2g}" for f in (min, max)]
            rows.append(
                [motion, f"`{integrator}`", f"{step_ms:g}", *(f"{g:.2g}" for g in gains), " to ".join(lost)]
            )
    moduli = sorted({s.stiffness_pa for s in known})
    return (
        "\n## Energy\n\nUndamped rods that nothing drives, clamped and let go from the horizontal, "
        f"or free and dropped on the ground on one end. Their energy over weight times length, "
        f"greatest over Young's moduli from {moduli[0]:g} to {moduli[-1]:g} Pa. "
        f"*Gain* is how far it ever exceeds its start: of motion and height alone, "
        f"which must not be more than {BAND:g} (the study stops otherwise), and with what springs hold. "
        "*Lost* is what is missing at the end.\n\n"
        + _table(["rod", "scheme", "step [ms]", "gain, motion and height", "gain with springs", "lost"], rows)
    )


def _table(head: Sequence[str], rows: Sequence[Row]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)


def _image(name: str, caption: str) -> str:
    return f"![{caption}]({IMAGES}/{name}.png)\n\n*{caption}*\n"
