"""Settles the values of the presets: of the candidates that fit, the one that depends least on step and mesh.

An identification leaves many candidates that meet the targets about as well. Stick and slip make some of them
change their stride when step or mesh are refined. This takes candidates of a run of ``magworm identify`` that
fit about as well as the best, spread as far as they reach, measures them again with the steps and meshes of
:data:`REFINEMENTS`, and writes the values of one into the preset files: of those that miss the fewest targets
with all of them together, the one with the least loss.

    magworm identify studies/identification/paper-3-simulation.toml --out runs/identify/paper-3-simulation
    python -m studies.identification.settle_presets paper-3-simulation

The report of the run goes to docs/identification/. ``make identify`` does all of it for all presets.
"""

import argparse
import json
import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from magworm_gym.identification import Problem, read_problem
from magworm_gym.identification.ensemble import distances
from magworm_gym.identification.evaluation import Evaluator
from magworm_gym.identification.experiment import Experiment
from magworm_gym.identification.sweep import Sweep

R = TypeVar("R", Experiment, Sweep)
Floats = NDArray[np.float64]

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
SCENES = ROOT / "rust/magworm/scenes"
REPORTS = ROOT / "docs/identification"
OTHERS = HERE / "others"
OTHER_FITS = 8
"""How many robots that fit about as well are kept for other studies."""

PRESETS = {
    "paper-joint": [
        SCENES / f"{name}.toml"
        for name in ("paper-3", "paper-4", "paper-5", "turn-3", "turn-3-pair", "belt-125")
    ],
    "paper-3-simulation": [SCENES / "paper-3-simulation.toml"],
}
"""Name of a problem → scenes that take its values."""

MARK = "identified"
"""How a preset marks its values."""

REFINEMENTS: tuple[dict[str, Any], ...] = (
    {"solver.step_s": 0.0005},
    {"solver.step_s": 0.0001},
    {"solver.step_s": 0.00002},
    {"solver.step_s": 0.0005, "body.elements_per_bridge": 16, "body.elements_per_foot_end": 4},
)
"""Steps and meshes with which a candidate has to fit too."""

FEW = {"paper-joint": (REFINEMENTS[0], {"solver.step_s": 0.0005, "body.elements_per_bridge": 8})}
"""Name of a problem with long runs → the fewer refinements that it can afford."""

DIGITS = 4
"""Significant digits of a value in a preset."""


def main() -> None:
    """Chooses and writes."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("problem", choices=sorted(PRESETS))
    parser.add_argument("--runs", type=Path, default=Path("runs/identify"), help="folder of the runs")
    parser.add_argument("--candidates", type=int, default=24, help="how many are measured again")
    arguments = parser.parse_args()
    problem = read_problem(HERE / f"{arguments.problem}.toml")
    run = arguments.runs / arguments.problem
    with np.load(run / "candidates.npz") as kept:
        units = spread(problem, kept["units"], kept["losses"], arguments.candidates)
    refinements = FEW.get(arguments.problem, REFINEMENTS)
    losses, missed = measured_again(problem, units, refinements)
    best = int(np.lexsort((losses.sum(axis=1), missed.sum(axis=1)))[0])
    values = rounded(problem.space.scene_values(units[best]))
    choice = words(best, losses[best], missed[best], refinements, values)
    print(choice)
    report = (run / "report.md").read_text(encoding="utf-8")
    REPORTS.mkdir(exist_ok=True)
    (REPORTS / f"{arguments.problem}.md").write_text(
        report.replace("# Identification\n", f"# Identification of `{arguments.problem}`\n\n{choice}\n", 1),
        encoding="utf-8",
    )
    OTHERS.mkdir(exist_ok=True)
    (OTHERS / f"{arguments.problem}.json").write_text(
        json.dumps(others(problem, units, losses[:, 0], best), indent=1) + "\n", encoding="utf-8"
    )
    for path in PRESETS[arguments.problem]:
        write_values(path, values, MARK)
        print(f"{path.stem}: {len(values)} values written")


def words(
    rank: int,
    losses: Floats,
    missed: NDArray[np.int64],
    refinements: Sequence[dict[str, Any]],
    values: dict[str, float],
) -> str:
    """The choice in words, for the report."""
    where = ["as identified"]
    where += [
        f"with {', '.join(f'`{path}` = {value:g}' for path, value in refinement.items())}"
        for refinement in refinements
    ]
    told = "; ".join(
        f"{loss:.3g} {place}, where it misses {'none' if count == 0 else count} of the fitted targets"
        for loss, count, place in zip(losses, missed, where, strict=True)
    )
    chosen = ", ".join(f"`{path}` = {value:g}" for path, value in values.items())
    return (
        f"The presets have candidate {rank + 1} of those that were measured with finer steps and meshes too: "
        "of those that miss the fewest targets, the one with the least loss of all together. Its loss is "
        f"{told}."
        f"\n\nThe presets' values: {chosen}."
    )


def spread(problem: Problem, units: Floats, losses: Floats, count: int) -> Floats:
    """The best candidate, robots that the problem starts from, and the farthest from all before (K, P).

    All of them fit; each of the last is that of the fitting candidates which is farthest from those before.
    """
    order = np.argsort(losses, kind="stable")
    fitting = units[order][losses[order] <= problem.limit(float(losses.min()))]
    starts = [problem.space.unit_of(start) for start in problem.starts]
    chosen = [fitting[0], *(unit for unit in starts if np.isclose(fitting, unit).all(axis=1).any())]
    while len(chosen) < min(count, len(fitting)):
        chosen.append(fitting[distances(fitting, chosen, np.ones(fitting.shape[1])).argmax()])
    return np.array(chosen)


def others(problem: Problem, units: Floats, losses: Floats, best: int) -> list[dict[str, Any]]:
    """Loss and values of the first of the candidates that were measured again but not chosen."""
    rest = [at for at in range(len(units)) if at != best][:OTHER_FITS]
    return [
        {"loss": float(losses[at]), "values": rounded(problem.space.scene_values(units[at]))} for at in rest
    ]


def measured_again(
    problem: Problem, units: Floats, refinements: Sequence[dict[str, Any]]
) -> tuple[Floats, NDArray[np.int64]]:
    """Losses (C, 1 + R) of candidates (C, P), as identified and refined, and how many targets they miss."""
    problems = [problem, *(refined(problem, values) for values in refinements)]
    evaluators = [Evaluator(each) for each in problems]
    found = [[each.outcomes(unit, each.problem.fitted) for each in evaluators] for unit in units]
    losses = [[sum(target.loss for target in targets) for targets in row] for row in found]
    missed = [[sum(not target.met for target in targets) for targets in row] for row in found]
    return np.array(losses), np.array(missed)


def refined(problem: Problem, values: dict[str, Any]) -> Problem:
    """The runs of a problem that do not refine anything themselves, refined."""
    experiments, sweeps = refined_runs(problem.experiments, values), refined_runs(problem.sweeps, values)
    kept = {run.name for run in experiments} | {run.name for run in sweeps}
    aims = tuple(aim for aim in problem.aims if aim.sources <= kept)
    return replace(problem, experiments=experiments, sweeps=sweeps, aims=aims)


def refined_runs(runs: tuple[R, ...], values: dict[str, Any]) -> tuple[R, ...]:
    """Those of some runs that do not refine anything themselves, refined."""
    plain = [run for run in runs if "solver.step_s" not in run.known]
    return tuple(replace(run, scene=run.scene.with_values(values)) for run in plain)


def rounded(values: dict[str, float]) -> dict[str, float]:
    """Values with as many digits as a preset shows."""
    return {path: float(f"{value:.{DIGITS}g}") for path, value in values.items()}


def write_values(path: Path, values: dict[str, float], mark: str) -> None:
    """Replaces numbers in a scene file and marks them; all else stays as it is."""
    lines, table = [], ""
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            table = line.split("]")[0].strip("[ ")
        field = re.match(r"(\w+) = ", line)
        value = values.get(f"{table}.{field.group(1)}") if field else None
        lines.append(line if field is None or value is None else marked(field.group(1), value, line, mark))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def marked(field: str, value: float, line: str, mark: str) -> str:
    """A line of a scene file with another value; "effective" and what follows a colon stay in its comment."""
    remark = re.search(r"#[^:]*:(.*)", line)
    mark = "effective" if "# effective" in line else mark
    comment = f"# {mark}" + (f":{remark.group(1)}" if remark else "")
    number = f"{value:g}" if 1e-3 <= abs(value) < 1e5 else f"{value:.{DIGITS}g}"
    return f"{f'{field} = {number} ':<32}{comment}"


if __name__ == "__main__":
    main()
