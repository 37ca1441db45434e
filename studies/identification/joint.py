"""Fits one robot to all of the paper's curves, from blind starts, and judges what it was not fitted to.

    python -m studies.identification.joint --out runs/joint --seeds 8

runs, for each problem, a search from a blind start for each seed, and for each group of claims a search
without it; a run that was stopped goes on, one that is done is kept. From them it writes

- docs/identification/joint.md: claims met by each run, what each claim that stays unmet would cost, each
  group judged by robots that were not fitted to it, intervals of the parameters;
- rust/magworm/scenes/ensemble/: from each blind start a robot that fits about as well as the best and meets
  the same claims, as unlike the others as it can be, and studies/identification/ensemble.json: the
  conditions that they were chosen by.
"""

import argparse
import json
from dataclasses import dataclass, replace
from functools import cached_property, partial
from pathlib import Path
from typing import Any

import numpy as np

from magworm_gym import Scene
from magworm_gym.atomic_files import write_json
from magworm_gym.documents import parse_toml
from magworm_gym.identification import Problem, identify, read_problem, write_results
from magworm_gym.identification.claims import Claim
from magworm_gym.identification.ensemble import alike, coverage, farthest_first
from magworm_gym.identification.evaluation import Evaluator
from magworm_gym.identification.identify import base_with
from magworm_gym.identification.scene_file import commented_scene
from magworm_gym.recording import Floats
from studies.kit.page import page

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
PAGE = ROOT / "docs/identification/joint.md"
ENSEMBLE = ROOT / "rust/magworm/scenes/ensemble"
CONDITIONS = HERE / "ensemble.json"

DRAFT = {"solver.step_s": 0.005, "solver.precision": "single"}
"""Values of the scene in the first part of a search, which a candidate passes in a third of the time. Losses
are off by several units there: it tells robots that fit from those that do not, and no more."""

DRAFTED = {"restarts": 12, "generations": 60, "patience": 20, "scatter": 4000}
"""Settings of that part, which begins blind; each can be given."""

SETTINGS = {"restarts": 4, "generations": 40, "patience": 15, "rounds": 20}
"""Settings of the second part, with the scenes as they are; each can be given."""

REFINED = {"halve_after": [8, 16], "scatter": 8, "first_step": 0.05, "blind": True}
"""More of them: it begins with the best of the first part alone."""

BEGINNINGS, APART_AT_FIRST = 24, 0.1
"""Candidates of the first part that the second begins with, and how far apart they are in the unit cube."""

TRIES = 40
"""Candidates of a run that are looked at to find its robot."""
COVERED = 0.5
"""Part of each interval that the ensemble is to reach over."""
APART, PLACES = 0.1, 3
"""Any two robots are to differ by this part of the interval in this many parameters."""


@dataclass(frozen=True)
class Search:
    """A finished run.

    Attributes:
        name: Name of its folder.
        problem: What was fitted.
        without: Group of claims that was left out; empty for none.
        report: Its report.
        units: Its candidates (C, P), best first.
        losses: Their losses (C,).
        drafted: Candidates of the part before.
    """

    name: str
    problem: Problem
    without: str
    report: dict[str, Any]
    units: Floats
    losses: Floats
    drafted: int = 0

    @property
    def candidates(self) -> int:
        """How many it tried, those of the part before included."""
        return self.drafted + len(self.losses)

    @property
    def loss(self) -> float:
        """Its least loss."""
        return float(self.report["loss"])

    def met(self, names: list[str]) -> int:
        """How many of these targets its best candidate meets."""
        return sum(each["met"] for each in self.report["targets"] if each["name"] in names)

    def count(self, fitted: bool) -> str:
        """How many of the targets, fitted or held out, its best candidate meets."""
        met = [each["met"] for each in self.report["targets"] if each["fitted"] is fitted]
        return f"{sum(met)} of {len(met)}"

    @property
    def targets(self) -> list[str]:
        """Names of all targets."""
        return [each["name"] for each in self.report["targets"]]

    @property
    def left_out(self) -> list[str]:
        """Names of the claims of the group that was left out."""
        claims = [aim for aim in self.problem.aims if isinstance(aim, Claim)]
        return [claim.name for claim in claims if claim.table.group == self.without]

    def pool(self, limit: float, labels: list[str]) -> Floats:
        """Parameters (K, P) of the candidates within a limit, as fitted numbers, best first."""
        space = self.problem.space
        columns = [[parameter.label for parameter in space.parameters].index(label) for label in labels]
        units = self.units[self.losses <= limit]
        return np.array([space.fitted(unit)[columns] for unit in units]).reshape(-1, len(labels))

    def missed(self) -> list[str]:
        """Fitted targets that its best candidate misses."""
        return [each["name"] for each in self.report["targets"] if each["fitted"] and not each["met"]]


@dataclass(frozen=True)
class Blind:
    """Runs from blind starts."""

    runs: list[Search]

    @cached_property
    def best(self) -> Search:
        """The run with the least loss."""
        return min(self.runs, key=lambda run: run.loss)

    @cached_property
    def limit(self) -> float:
        """Loss up to which a robot fits about as well as the best of all runs [1]."""
        return self.best.problem.limit(self.best.loss)

    @cached_property
    def labels(self) -> list[str]:
        """Labels of the parameters (P) that all problems have."""
        first, *others = (
            [parameter.label for parameter in run.problem.space.parameters] for run in self.runs
        )
        return [label for label in first if all(label in each for each in others)]

    @cached_property
    def pools(self) -> list[Floats]:
        """Parameters (K, P) of the candidates of each run within the limit, as fitted numbers, best first."""
        return [run.pool(self.limit, self.labels) for run in self.runs]

    @cached_property
    def low(self) -> Floats:
        """Least values of the parameters within the limit (P,)."""
        return np.asarray(np.vstack(self.pools).min(axis=0))

    @cached_property
    def high(self) -> Floats:
        """Greatest values of the parameters within the limit (P,)."""
        return np.asarray(np.vstack(self.pools).max(axis=0))


def main() -> None:
    """Runs what is missing and writes the page and the ensemble."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--problems", nargs="+", type=Path, default=[HERE / "paper-joint.toml"])
    parser.add_argument("--out", type=Path, default=Path("runs/joint"), help="folder of the runs")
    parser.add_argument("--seeds", type=int, default=8, help="blind starts of each problem")
    parser.add_argument("--crossed", type=int, default=2, help="blind starts without each group of claims")
    for before, settings in (("draft-", DRAFTED), ("", SETTINGS)):
        for setting, value in settings.items():
            parser.add_argument(f"--{before}{setting}", type=int, default=value, help="(%(default)s)")
    parser.add_argument("--page", type=Path, default=PAGE)
    parser.add_argument("--ensemble", type=Path, default=ENSEMBLE)
    parser.add_argument("--conditions", type=Path, default=CONDITIONS)
    arguments = parser.parse_args()
    drafted = {key: getattr(arguments, f"draft_{key}") for key in DRAFTED}
    run = partial(finished, arguments.out, drafted, {key: getattr(arguments, key) for key in SETTINGS})
    searches: list[Search] = []
    crossed: list[Search] = []
    for problem in arguments.problems:
        searches += [run(problem, seed) for seed in range(arguments.seeds)]
        for group in groups(searches[-1].problem):
            crossed += [run(problem, seed, group) for seed in range(arguments.crossed)]
    blind = Blind(searches)
    chosen = ensemble(blind)
    write_ensemble(arguments.ensemble, blind, chosen)
    write_json(arguments.conditions, conditions(blind))
    arguments.page.parent.mkdir(parents=True, exist_ok=True)
    arguments.page.write_text(report(blind, crossed, chosen), encoding="utf-8")


def groups(problem: Problem) -> list[str]:
    """Groups of fitted claims."""
    claims = [aim for aim in problem.fitted if isinstance(aim, Claim)]
    return list(dict.fromkeys(claim.table.group for claim in claims if claim.table.group))


def finished(
    out: Path, drafts: dict[str, int], settings: dict[str, int], file: Path, seed: int, without: str = ""
) -> Search:
    """A run from a blind start, done now where it was not before."""
    groups = [without] if without else []
    name = f"{file.stem}-{seed}{f'-without-{without}' if without else ''}"
    draft = read_problem(file, {**drafts, "seed": seed, "blind": True, "rounds": 0}, groups, DRAFT)
    drafted = done(out / f"{name}-draft", draft, without)
    starts = tuple(draft.space.scene_values(unit) for unit in beginnings(drafted))
    problem = read_problem(file, {**REFINED, **settings, "seed": seed}, groups)
    fingerprint = f"{problem.fingerprint}-{draft.fingerprint}"
    refined = done(out / name, replace(problem, starts=starts, fingerprint=fingerprint), without)
    return replace(refined, drafted=len(drafted.losses))


def done(folder: Path, problem: Problem, without: str) -> Search:
    """One part of a run."""
    if not (folder / "report.json").exists():
        print(folder, flush=True)
        write_results(identify(problem, folder, resume=folder.exists()), folder)
    with np.load(folder / "candidates.npz") as kept:
        order = np.argsort(kept["losses"], kind="stable")
        units, losses = kept["units"][order], kept["losses"][order]
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    return Search(folder.name, problem, without, report, units, losses)


def beginnings(drafted: Search) -> list[Floats]:
    """The best candidates (P,) of a search that are apart from each other."""
    chosen: list[Floats] = []
    for unit in drafted.units:
        if all(np.linalg.norm(unit - other) >= APART_AT_FIRST for other in chosen):
            chosen.append(unit)
        if len(chosen) == BEGINNINGS:
            break
    return chosen


def ensemble(blind: Blind) -> list[int | None]:
    """Place of each run's robot among its candidates."""
    wanted = claims_met(blind.best, 0)
    return farthest_first(
        blind.pools,
        np.maximum(blind.high - blind.low, 1e-300),
        lambda number, place: claims_met(blind.runs[number], place) >= wanted,
        TRIES,
    )


def claims_met(run: Search, place: int) -> set[str]:
    """Names of the fitted targets that a candidate of a run meets."""
    outcomes = Evaluator(run.problem).outcomes(run.units[place], run.problem.fitted)
    return {outcome.name for outcome in outcomes if outcome.met}


def write_ensemble(folder: Path, blind: Blind, chosen: list[int | None]) -> None:
    """Writes the robots as scenes with three magnets, in place of those that were there."""
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.toml"):
        old.unlink()
    members = [(run, place) for run, place in zip(blind.runs, chosen, strict=True) if place is not None]
    for number, (run, place) in enumerate(members, start=1):
        name = run.problem.base_name
        origins = {parameter.path: "identified" for parameter in run.problem.space.parameters}
        head = [f"Robot {number} of the ensemble of {name}: {run.name}, loss {run.losses[place]:.4g}."]
        text = commented_scene(robot(run, place), origins, f"as in {name}", head)
        (folder / f"{name}-{number}.toml").write_text(text, encoding="utf-8")


def robot(run: Search, place: int) -> Scene:
    """A candidate with the drive and the resets of the preset that its problem began with."""
    preset = parse_toml(Scene.preset(run.problem.base_name).to_toml(), "preset")
    scene, _ = base_with(run.problem.base, run.problem.space.scene_values(run.units[place]))
    return scene.with_values({"drive.motion": preset["drive"]["motion"], "reset": preset["reset"]})


def conditions(blind: Blind) -> dict[str, Any]:
    """What every robot of the ensemble meets: loss, claims, and the intervals that they are to reach over."""
    ends = np.stack([blind.low, blind.high], axis=1).tolist()
    return {
        "loss": blind.limit,
        "claims": sorted(claims_met(blind.best, 0)),
        "intervals": dict(zip(blind.labels, ends, strict=True)),
    }


def report(blind: Blind, crossed: list[Search], chosen: list[int | None]) -> str:
    """The page."""
    low, high, best = blind.low, blind.high, blind.best
    robots = np.array([points[at] for points, at in zip(blind.pools, chosen, strict=True) if at is not None])
    pairs = alike(robots, APART * (high - low), PLACES)
    return page(
        HERE / "joint.md.j2",
        blind=blind.runs,
        best=best,
        met_by={name: sum(run.met([name]) for run in blind.runs) for name in best.targets},
        unmet=[(name, *cheapest(blind.runs, name)) for name in best.missed()],
        crossed=crossed,
        robots=len(robots),
        limit=blind.limit,
        intervals=list(zip(blind.labels, low, high, coverage(robots, low, high), strict=True)),
        covered=COVERED,
        apart=APART,
        places=PLACES,
        pairs=", ".join(f"{i + 1} and {j + 1}" for i, j in pairs),
    )


def cheapest(runs: list[Search], name: str) -> tuple[str, float, str]:
    """The run of the best candidate that meets a target, its loss, and what it misses."""
    meeting = [
        (float(each["loss"]), run.name, each["missed"])
        for run in runs
        for each in run.report["alternatives"]
        if each["target"] == name and each["values"] is not None
    ]
    meeting += [(run.loss, run.name, run.missed()) for run in runs if run.met([name])]
    loss, run_name, missed = min(meeting, default=(np.inf, "none", ["–"]))
    return run_name, loss, ", ".join(missed) or "nothing"


if __name__ == "__main__":
    main()
