"""What was identified, as Markdown, as JSON and as a scene."""

import json
from os import PathLike
from typing import Any

import numpy as np

from magworm_gym import __version__
from magworm_gym.arguments import path_of
from magworm_gym.atomic_files import write_text
from magworm_gym.identification.alternatives import Alternative
from magworm_gym.identification.combinations import in_words
from magworm_gym.identification.evaluation import BROKEN
from magworm_gym.identification.findings import Finding
from magworm_gym.identification.identifiability import STEPS
from magworm_gym.identification.identify import Identification
from magworm_gym.identification.scene_file import commented_scene
from magworm_gym.identification.targets import Outcome

MOST_DIRECTIONS = 4
"""Most weak directions that are written out."""

MISFIT = 1.5
"""Misfit beyond which the report says that the model does not fit [1]."""


def write_results(found: Identification, out: str | PathLike[str]) -> None:
    """Writes ``scene.toml``, ``report.md`` and ``report.json`` into a folder."""
    out = path_of("out", out)
    write_text(out / "scene.toml", fitted_scene_toml(found))
    write_text(out / "report.json", json.dumps(as_json(found), indent=1, allow_nan=False) + "\n")
    write_text(out / "report.md", as_markdown(found))


def fitted_scene_toml(found: Identification) -> str:
    """The fitted scene with the origin of each value."""
    problem = found.problem
    origins = {path: "set in the problem" for path in problem.fixed}
    for finding in found.findings:
        origins[finding.parameter.path] = _origin(finding)
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
    """The report for people."""
    return "\n".join(
        [
            "# Identification",
            "",
            *_summary(found),
            "",
            *_noticed(found),
            "## Parameters",
            "",
            *_parameter_table(found),
            "",
            *[
                f"- `{finding.parameter.label}`: {'; '.join(finding.sentences())}."
                for finding in found.findings
            ],
            "",
            "The range is that of all candidates that fit about as well as the best: loss up to "
            f"{found.limit:.4g}. ± is half of it. A standard deviation is that of the linearised model, in "
            "parts of the bounds: alone with all other parameters known, joint with none of them known.",
            "",
            "## Targets",
            "",
            *_target_table([outcome for outcome in found.outcomes if outcome.fitted]),
            "",
            *_alternatives(found),
            *_held_out(found),
            "## Profiles",
            "",
            *_profile_table(found),
            "",
            "## Combinations",
            "",
            *_combinations(found),
            "",
            "## Restarts",
            "",
            *_restart_table(found),
            "",
        ]
    )


def _summary(found: Identification) -> list[str]:
    problem = found.problem
    said = [
        f"Base: `{problem.base_name}`. Parameters: {len(problem.space)}, experiments and sweeps: "
        f"{len(problem.runs)}, independent measurements: {problem.measurements:.0f}. "
        f"Simulated: {found.candidates} candidates, at most {found.candidates * problem.simulated_s:.0f} s. "
        f"Loss {found.loss:.4g}; magworm-gym {__version__}, seed {problem.settings.seed}.",
    ]
    for verdict in ("not identifiable", "weakly identified"):
        labels = [f"`{f.parameter.label}`" for f in found.findings if f.verdict == verdict]
        if labels:
            said += ["", f"**{verdict.capitalize()} from these data: {', '.join(labels)}.**"]
    said += ["", _met(found)]
    if len(problem.space) > problem.measurements:
        said += ["", "**There are more parameters than measurements.**"]
    if found.misfit > MISFIT:
        said += [
            "",
            f"**The model misses the data by {found.misfit:.1f} times the tolerances** (root of loss over "
            "degrees of freedom); ranges are widened by that. Either the tolerances are too strict, or the "
            "model lacks something, or a bound keeps it from the data.",
        ]
    return said


def _noticed(found: Identification) -> list[str]:
    """What may be a mistake in the problem."""
    noticed = found.problem.noticed
    return ["## Please check", "", *(f"- {remark}" for remark in noticed), ""] if noticed else []


def _parameter_table(found: Identification) -> list[str]:
    rows = [
        "| parameter | best | ± | fits as well | part of bounds | restarts: least, greatest, std | bounds "
        "| std alone, joint |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for f in found.findings:
        parameter, restarts = f.parameter, f.restarts
        field = "" if parameter.times is None else f" (field: {f.field_value:.5g})"
        spread = f"{restarts.min():.5g}, {restarts.max():.5g}, {restarts.std():.2g}"
        cells = [
            f"`{parameter.label}`",
            f"{f.best:.5g}{field}",
            f"{f.half_range:.2g}",
            f"{f.fits_from:.5g} to {f.fits_to:.5g}",
            f"{100.0 * f.part:.1f} %",
            f"{spread} ({len(restarts)} of {len(found.evolutions)})",
            f"{parameter.low:g} to {parameter.high:g}{', log' if parameter.scale == 'log' else ''}",
            f"{_part(f.alone)}, {_part(f.deviation)}",
        ]
        rows.append(f"| {' | '.join(cells)} |")
    return rows


def _part(value: float) -> str:
    return "–" if np.isnan(value) else f"{value:.2g}" if value < 10.0 else "over 10"


def _met(found: Identification) -> str:
    """How many of the targets are met."""
    fitted = [outcome.met for outcome in found.outcomes if outcome.fitted]
    held = [outcome.met for outcome in found.outcomes if not outcome.fitted]
    others = f"; of {len(held)} held out {sum(held)}" if held else ""
    return f"Of {len(fitted)} fitted targets {sum(fitted)} are met{others}."


def _alternatives(found: Identification) -> list[str]:
    """What targets that are not met would cost."""
    if not found.alternatives:
        return []
    return ["## Not met", "", *[_alternative(found, each) for each in found.alternatives], ""]


def _alternative(found: Identification, alternative: Alternative) -> str:
    if alternative.values is None:
        return f"- {alternative.target}: none of {found.candidates} candidates meets it."
    values = ", ".join(f"`{path}` = {value:.4g}" for path, value in alternative.values.items())
    return (
        f"- {alternative.target}: the best of {found.candidates} candidates that meets it has a loss of "
        f"{alternative.loss:.4g} and misses {'; '.join(alternative.missed) or 'nothing'}. It is {values}."
    )


def _held_out(found: Identification) -> list[str]:
    """What was not fitted, what is not met first."""
    held = sorted((each for each in found.outcomes if not each.fitted), key=lambda outcome: outcome.met)
    if not held:
        return []
    return ["## Held out", "", "Never part of the loss.", "", *_target_table(held), ""]


def _profile_table(found: Identification) -> list[str]:
    """Least loss in each slice of each parameter."""
    slices = found.profiles.shape[1]
    ends = " | ".join(f"to {(at + 1) / slices:.0%}" for at in range(slices))
    rows = [f"| parameter | {ends} |", "|" + "---|" * (slices + 1)]
    for parameter, least in zip(found.problem.space.parameters, found.profiles, strict=True):
        cells = [_profile_cell(loss, found.limit) for loss in least]
        rows.append(f"| `{parameter.label}` | {' | '.join(cells)} |")
    rows += [
        "",
        "The least loss of all candidates in each tenth of a parameter's bounds, the other parameters free; "
        "bold: fits about as well as the best. Losses beyond that may be lower bounds.",
    ]
    return rows


def _profile_cell(loss: float, limit: float) -> str:
    if loss >= BROKEN:
        return "–"
    return f"**{loss:.4g}**" if loss <= limit else f"{loss:.3g}"


def _target_table(outcomes: list[Outcome]) -> list[str]:
    rows = [
        "| target | wanted | model | error | in tolerances | share of loss | met |",
        "|---|---|---|---|---|---|---|",
    ]
    for outcome in outcomes:
        percent = "–" if outcome.error_percent is None else f"{outcome.error_percent:+.2f} %"
        rows.append(
            f"| {outcome.name} | {outcome.target} | {outcome.model:.5g} | {percent} | "
            f"{outcome.error_tolerances:+.2f} | {outcome.loss:.3g} | {'yes' if outcome.met else '**no**'} |"
        )
    for outcome in outcomes:
        if outcome.remark:
            rows += ["", f"{outcome.name.split(',')[0]}: {outcome.remark}."]
    return rows


def _combinations(found: Identification) -> list[str]:
    sensed, space = found.sensitivity, found.problem.space
    weak = [
        f"- Free: {in_words(space, free.direction)} of the bounds, at once; what fits as well reaches over "
        f"{free.length:.2f} of the unit cube."
        for free in found.free
    ]
    weakest = sensed.weak_directions[::-1]
    weak += [
        f"- Weak: {in_words(space, sensed.directions[at])} of the bounds, at once, changes the residuals by "
        f"only {sensed.singular_values[at]:.2g} standard deviations."
        for at in weakest[:MOST_DIRECTIONS]
    ]
    if len(weakest) > MOST_DIRECTIONS:
        weak.append(f"- {len(weakest) - MOST_DIRECTIONS} more such directions are in report.json.")
    values = ", ".join(f"{value:.3g}" for value in sensed.singular_values)
    disagreement = ", ".join(
        f"`{f.parameter.label}` "
        + (f"{100.0 * f.disagreement:.0f} %" if np.isfinite(f.disagreement) else "–")
        for f in found.findings
    )
    return [
        *(weak or ["The data pin down all combinations."]),
        "",
        "Singular values of the Jacobian of the residuals [standard deviations per range of bounds]: "
        f"{values}. "
        f"Derivatives with steps of {STEPS[0]:g} and {STEPS[1]:g} of the bounds differ by: {disagreement}.",
    ]


def _restart_table(found: Identification) -> list[str]:
    labels = [f"`{parameter.label}`" for parameter in found.problem.space.parameters]
    rows = [
        f"| loss | fits as well | {' | '.join(labels)} | generations | ended |",
        "|" + "---|" * (len(labels) + 4),
    ]
    for evolution in found.evolutions:
        values = " | ".join(f"{value:.5g}" for value in found.problem.space.fitted(evolution.best))
        fits = "yes" if evolution.loss <= found.limit else "no"
        rows.append(
            f"| {evolution.loss:.5g} | {fits} | {values} | {evolution.generations} | {evolution.ended} |"
        )
    return rows


def as_json(found: Identification) -> dict[str, Any]:
    """The report for programs; numbers that are not finite become null."""
    value: dict[str, Any] = {
        "version": __version__,
        "base": found.problem.base_name,
        "seed": found.problem.settings.seed,
        "fingerprint": found.problem.fingerprint,
        "loss": found.loss,
        "loss_that_fits_as_well": found.limit,
        "misfit": found.misfit,
        "measurements": found.problem.measurements,
        "candidates": found.candidates,
        "noticed": list(found.problem.noticed),
        "simulated_s_at_most": found.candidates * found.problem.simulated_s,
        "values": found.values,
        "not_in_scene": list(found.left_out),
        "parameters": [_finding_json(finding) for finding in found.findings],
        "targets": [vars(outcome) for outcome in found.outcomes],
        "alternatives": [vars(alternative) for alternative in found.alternatives],
        "profiles": found.profiles.tolist(),
        "restarts": [
            {
                "loss": evolution.loss,
                "values": found.problem.space.fitted(evolution.best).tolist(),
                "generations": evolution.generations,
                "ended": evolution.ended,
            }
            for evolution in found.evolutions
        ],
        "singular_values": found.sensitivity.singular_values.tolist(),
        "directions": found.sensitivity.directions.tolist(),
        "weak_directions": found.sensitivity.weak_directions,
        "free_combinations": [
            {"direction": free.direction.tolist(), "length": free.length} for free in found.free
        ],
    }
    finite: dict[str, Any] = _finite(value)
    return finite


def _finding_json(finding: Finding) -> dict[str, Any]:
    parameter, restarts = finding.parameter, finding.restarts
    return {
        "path": parameter.path,
        "times": parameter.times,
        "best": finding.best,
        "field_value": finding.field_value,
        "low": parameter.low,
        "high": parameter.high,
        "scale": parameter.scale,
        "verdict": finding.verdict,
        "sentences": finding.sentences(),
        "on_bound": finding.bound or None,
        "fits_from": finding.fits_from,
        "fits_to": finding.fits_to,
        "part_of_bounds": finding.part,
        "restarts": {
            "least": float(restarts.min()),
            "greatest": float(restarts.max()),
            "std": float(restarts.std()),
            "count": len(restarts),
        },
        "std_alone": finding.alone,
        "std_joint": finding.deviation,
        "derivative_disagreement": finding.disagreement,
        "tied_to": list(finding.tied),
    }


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(each) for key, each in value.items()}
    if isinstance(value, list):
        return [_finite(each) for each in value]
    if isinstance(value, float) and not np.isfinite(value):
        return None
    return value
