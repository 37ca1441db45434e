"""What was identified, as Markdown, as JSON and as a scene."""

from os import PathLike
from typing import Any

import jinja2
import numpy as np
from msgspec.structs import asdict

from magworm_gym import __version__
from magworm_gym.arguments import path_of
from magworm_gym.atomic_files import write_json, write_text
from magworm_gym.identification.combinations import in_words
from magworm_gym.identification.evaluation import BROKEN
from magworm_gym.identification.findings import Finding
from magworm_gym.identification.identifiability import STEPS
from magworm_gym.identification.identify import Identification
from magworm_gym.identification.profiles import SLICES
from magworm_gym.identification.scene_file import commented_scene

TEMPLATE = "report.md.j2"

MOST_DIRECTIONS = 4
"""Most weak directions that are written out."""

MISFIT = 1.5
"""Misfit beyond which the report says that the model does not fit [1]."""


def write_results(found: Identification, out: str | PathLike[str]) -> None:
    """Writes ``scene.toml``, ``report.md`` and ``report.json`` into a folder."""
    out = path_of("out", out)
    write_text(out / "scene.toml", fitted_scene_toml(found))
    write_json(out / "report.json", as_json(found))
    write_text(out / "report.md", as_markdown(found))


def fitted_scene_toml(found: Identification) -> str:
    """The fitted scene with the origin of each value."""
    problem = found.problem
    origins = {path: "set in the problem" for path in problem.fixed}
    origins |= {finding.parameter.path: _origin(finding) for finding in found.findings}
    head = [f"The scene {problem.base_name} with {len(found.findings)} identified values."]
    head += [
        f"Identified too, but no field of this scene: {path} = {found.values[path]:.6g}"
        for path in found.left_out
    ]
    return commented_scene(found.scene, origins, f"as in {problem.base_name}", head)


def _origin(finding: Finding) -> str:
    times = finding.parameter.times
    ratio = "" if times is None else f" as {finding.best:.4g} times {times}"
    if finding.verdict == "not identifiable":
        return f"not identifiable{ratio}: {finding.fits_from:.4g} to {finding.fits_to:.4g} fits as well"
    return f"identified{ratio}: ±{finding.half_range:.2g}"


def as_markdown(found: Identification) -> str:
    """The report for people, from its template."""
    space = found.problem.space
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("magworm_gym.identification", ""),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters |= {
        "as": lambda value, form: format(value, form),
        "code": lambda label: f"`{label}`",
        "part": lambda value: "–" if np.isnan(value) else f"{value:.2g}" if value < 10.0 else "over 10",
        "percent": lambda value: f"{100.0 * value:.0f} %" if np.isfinite(value) else "–",
        "in_words": lambda direction: in_words(space, direction),
    }
    return environment.get_template(TEMPLATE).render(
        found=found,
        problem=found.problem,
        parameters=space.parameters,
        sensed=found.sensitivity,
        weakest=found.sensitivity.weak_directions[::-1],
        fitted=[outcome for outcome in found.outcomes if outcome.fitted],
        held=[outcome for outcome in found.outcomes if not outcome.fitted],
        version=__version__,
        slices=SLICES,
        steps=STEPS,
        broken=BROKEN,
        most_misfit=MISFIT,
        most_directions=MOST_DIRECTIONS,
    )


def as_json(found: Identification) -> dict[str, Any]:
    """The report for programs; numbers that are not finite become null."""
    problem, sensed = found.problem, found.sensitivity
    value = {
        "version": __version__,
        "base": problem.base_name,
        "seed": problem.settings.seed,
        "fingerprint": problem.fingerprint,
        "noticed": problem.noticed,
        "loss": found.loss,
        "loss_that_fits_as_well": found.limit,
        "misfit": found.misfit,
        "measurements": problem.measurements,
        "candidates": found.candidates,
        "simulated_s_at_most": found.candidates * problem.simulated_s,
        "values": found.values,
        "not_in_scene": found.left_out,
        "parameters": [_finding_json(finding) for finding in found.findings],
        "targets": [vars(outcome) for outcome in found.outcomes],
        "alternatives": [vars(alternative) for alternative in found.alternatives],
        "profiles": found.profiles,
        "restarts": [
            {
                "loss": evolution.loss,
                "values": problem.space.fitted(evolution.best),
                "generations": evolution.generations,
                "ended": evolution.ended,
            }
            for evolution in found.evolutions
        ],
        "singular_values": sensed.singular_values,
        "directions": sensed.directions,
        "weak_directions": sensed.weak_directions,
        "free_combinations": [vars(free) for free in found.free],
    }
    plain: dict[str, Any] = _plain(value)
    return plain


def _finding_json(finding: Finding) -> dict[str, Any]:
    numbers = {key: value for key, value in vars(finding).items() if key not in ("parameter", "restarts")}
    restarts = finding.restarts
    spread = {
        "least": restarts.min(),
        "greatest": restarts.max(),
        "std": restarts.std(),
        "count": len(restarts),
    }
    said = {"verdict": finding.verdict, "sentences": finding.sentences(), "restarts": spread}
    return {**asdict(finding.parameter), **numbers, **said}


def _plain(value: Any) -> Any:
    """A value of Python's own kinds, with None for numbers that are not finite."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, dict):
        return {key: _plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    return None if isinstance(value, float) and not np.isfinite(value) else value
