"""Words of a comparison: its page from a template, and verdicts."""

import re
from collections.abc import Sequence
from typing import Any

import jinja2

from magworm_gym.learning.compare.contest import Contest
from magworm_gym.learning.compare.rows import MM_PER_M, Measure, Row
from magworm_gym.learning.compare.statistics import STATISTIC
from magworm_gym.learning.results import Interval, Report, Table

PART = re.compile(r"<!-- (\S+) -->\n(.*?)(?=<!-- |\Z)", re.DOTALL)


def page(contest: Contest, template: str, tables: dict[str, Table], **values: Any) -> Report:
    """A report from a template, whose parts each begin with a line such as ``<!-- verdict -->``.

    Args:
        contest: What is compared; its scene, limits, sizes and training fill the template.
        template: Name of the template.
        tables: What stands where the template has the name alone.
        values: What else fills it.
    """
    loader = jinja2.PackageLoader("magworm_gym.learning.compare", "")
    environment = jinja2.Environment(loader=loader, undefined=jinja2.StrictUndefined)
    environment.filters |= {
        "mm": lambda metres: f"{MM_PER_M * metres:.0f}",
        "g": lambda number: f"{number:g}",
    }
    limits = contest.scene.stage_limits or {}
    given = {"scene": contest.scene, "limits": limits, "training": contest.training, "statistic": STATISTIC}
    sizes = {name: getattr(contest.budget, name) for name in contest.budget.__struct_fields__[1:]}
    text = environment.get_template(template).render({**given, **sizes, **values})
    title, _, body = text.partition("\n")
    parts = {name: part.strip() or tables[name] for name, part in PART.findall(body)}
    return Report(title.removeprefix("# "), parts)


def verdict(learned: Row, opponents: Sequence[tuple[str, Row]], measure: Measure, of: str = "") -> list[str]:
    """How the learned policy compares; a difference counts where the intervals do not overlap."""
    ours = learned.interval(measure)
    return [_against(ours, row.interval(measure), f"{name}{of}", measure) for name, row in opponents]


def _against(learned: Interval, rival: Interval, name: str, measure: Measure) -> str:
    ours, theirs = (format(one.value * measure.factor, measure.form) for one in (learned, rival))
    numbers = f"{ours} against {theirs} {measure.unit}"
    more, fewer = learned.low > rival.high, learned.high < rival.low
    if fewer if measure.less else more:
        ratio = f", {learned.value / rival.value:.1f} times as fast" if more and rival.value > 0.0 else ""
        return f"The learned policy beats {name}: {numbers}{ratio}."
    if more or fewer:
        return f"The learned policy does not beat {name}: {numbers}."
    return f"The learned policy cannot be told from {name}: {numbers}, and the intervals overlap."
