"""Settles the values of the presets: of the candidates that fit, the one that depends least on step and mesh.

An identification leaves many candidates that meet the targets about as well. Stick and slip make some of them
change their stride when step or mesh are refined. This takes the best candidates of a run of ``magworm
identify``, measures them again with the steps and meshes of :data:`REFINEMENTS`, and writes the values of
the one with the least loss of all of them together into the preset files.

    magworm identify studies/identification/paper-3.toml --out runs/identify/paper-3
    python studies/identification/settle_presets.py paper-3

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
from magworm_gym.identification.evaluation import Evaluator
from magworm_gym.identification.experiment import Experiment
from magworm_gym.identification.sweep import Sweep

R = TypeVar("R", Experiment, Sweep)

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
SCENES = ROOT / "rust/magworm/scenes"
REPORTS = ROOT / "docs/identification"
RESTARTS = HERE / "restarts"

PRESETS = {
    "paper-joint": ("paper-3", "paper-4", "paper-5", "turn-3", "belt-125", "paper-3-experiment"),
    "paper-3": ("paper-3", "paper-4", "paper-5", "turn-3", "belt-125", "paper-3-experiment"),
    "paper-3-experiment": ("paper-3-experiment",),
}
"""Name of a problem → presets that take its values; the second changes some of the first's."""

MARKS = {"paper-joint": "identified", "paper-3": "identified", "paper-3-experiment": "experiment"}
"""Name of a problem → how a preset marks its values."""

REFINEMENTS: tuple[dict[str, Any], ...] = (
    {"solver.step_s": 0.0005},
    {"solver.step_s": 0.0001},
    {"solver.step_s": 0.00002},
    {"solver.step_s": 0.0005, "body.elements_per_bridge": 16, "body.elements_per_foot_end": 4},
)
"""Steps and meshes with which a candidate has to fit too."""

FEW = {"paper-joint": (REFINEMENTS[0], {"solver.step_s": 0.0005, "body.elements_per_bridge": 8})}
"""Name of a problem with long runs → the fewer refinements that it can afford."""

MISSED = 90.0
"""Loss beyond which a restart does not meet its targets: 3 % of each of ten figures known to 1 %."""

DIGITS = 4
"""Significant digits of a value in a preset."""


def main() -> None:
    """Chooses and writes."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("problem", choices=sorted(PRESETS))
    parser.add_argument("--runs", type=Path, default=Path("runs/identify"), help="folder of the runs")
    parser.add_argument("--candidates", type=int, default=60, help="how many of the best are measured again")
    arguments = parser.parse_args()
    problem = read_problem(HERE / f"{arguments.problem}.toml")
    run = arguments.runs / arguments.problem
    with np.load(run / "candidates.npz") as kept:
        units = kept["units"][np.argsort(kept["losses"], kind="stable")[: arguments.candidates]]
    refinements = FEW.get(arguments.problem, REFINEMENTS)
    losses = refined_losses(problem, units, refinements)
    best = int(losses.sum(axis=1).argmin())
    values = rounded(problem.space.scene_values(units[best]))
    if "drive.motion.y_m" in values:
        values["drive.motion.highest_m"] = values["drive.motion.y_m"]
    choice = words(best, losses[best], refinements, values)
    print(choice)
    report = (run / "report.md").read_text(encoding="utf-8")
    REPORTS.mkdir(exist_ok=True)
    (REPORTS / f"{arguments.problem}.md").write_text(
        report.replace("# Identification\n", f"# Identification of `{arguments.problem}`\n\n{choice}\n", 1),
        encoding="utf-8",
    )
    restarts = restarts_of(problem, json.loads((run / "report.json").read_text(encoding="utf-8")))
    RESTARTS.mkdir(exist_ok=True)
    (RESTARTS / f"{arguments.problem}.json").write_text(
        json.dumps(restarts, indent=1) + "\n", encoding="utf-8"
    )
    for name in PRESETS[arguments.problem]:
        write_values(SCENES / f"{name}.toml", values, MARKS[arguments.problem])
        print(f"{name}: {len(values)} values written")


def words(
    rank: int, losses: NDArray[np.float64], refinements: Sequence[dict[str, Any]], values: dict[str, float]
) -> str:
    """The choice in words, for the report."""
    finer = "; ".join(
        f"{loss:.3g} with {', '.join(f'`{path}` = {value:g}' for path, value in refinement.items())}"
        for loss, refinement in zip(losses[1:], refinements, strict=True)
    )
    chosen = ", ".join(f"`{path}` = {value:g}" for path, value in values.items())
    return (
        f"The presets have candidate {rank + 1}, chosen with finer steps and meshes too. Its loss is "
        f"{losses[0]:.3g} as identified; {finer}.\n\nThe presets' values: {chosen}."
    )


def restarts_of(problem: Problem, report: dict[str, Any]) -> list[dict[str, Any]]:
    """Loss and field values of the best of each restart that met the targets, for the studies of others."""
    restarts = []
    for each in report["restarts"]:
        if each["loss"] > MISSED:
            continue
        fitted = dict(zip((p.path for p in problem.space.parameters), each["values"], strict=True))
        values = {
            p.path: fitted[p.path] * (fitted[p.times] if p.times else 1.0) for p in problem.space.parameters
        }
        restarts.append({"loss": each["loss"], "values": rounded(values)})
    return restarts


def refined_losses(
    problem: Problem, units: NDArray[np.float64], refinements: Sequence[dict[str, Any]]
) -> NDArray[np.float64]:
    """Losses (C, 1 + R) of candidates (C, P) as they were identified and with each of R refinements."""
    bounds = np.full(len(units), np.inf)
    columns = [Evaluator(problem).losses(units, bounds)]
    for refinement in refinements:
        columns.append(Evaluator(refined(problem, refinement)).losses(units, bounds))
        print(f"{refinement}: least loss {columns[-1].min():.3g}")
    return np.stack(columns, axis=1)


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
    """A line of a scene file with another value; what its comment adds after a colon stays."""
    remark = re.search(r"#[^:]*:(.*)", line)
    comment = f"# {mark}" + (f":{remark.group(1)}" if remark else "")
    number = f"{value:g}" if 1e-3 <= abs(value) < 1e5 else f"{value:.{DIGITS}g}"
    return f"{f'{field} = {number} ':<32}{comment}"


if __name__ == "__main__":
    main()
