"""The page: what was measured, as Markdown."""

from __future__ import annotations

import math
import re
import textwrap
from pathlib import Path

from cases import Case, Row
from contents import NAMES, SECTIONS, Section

COMMAND = "cargo test --release -p magworm --test validation"

INTRODUCTION = Path(__file__).with_name("introduction.md")


def write_page(cases: dict[str, Case], images: str) -> str:
    """The whole page; `images`: folder of the figures as seen from the page."""
    head = INTRODUCTION.read_text(encoding="utf-8").replace("{command}", COMMAND)
    parts = [head, _rod(cases), _summary(cases), _curvatures(cases)]
    parts += [_section(section, cases, images) for section in SECTIONS]
    return "\n".join(parts)


def figure_names(case: Case) -> list[str]:
    """File names of a case's figures."""
    return [f"{case.name.replace('_', '-')}-{k + 1}.svg" for k in range(len(case.figures))]


def _rod(cases: dict[str, Case]) -> str:
    texts = {case.base.strip() for case in cases.values() if "\n" in case.base}
    return "".join(f"The rod:\n\n```toml\n{text}\n```\n" for text in sorted(texts))


def _summary(cases: dict[str, Case]) -> str:
    lines = [
        "## Summary",
        "",
        "Of each case the figure that uses up most of its band.",
        "",
        "| case | against | worst | error or value | band | observed order |",
        "|---|---|---|---|---|---|",
    ]
    for section in SECTIONS:
        for name, against in section.cases.items():
            case = cases.get(name)
            lines.append(
                f"| {name} | {against} | **missing** | | | |" if case is None else _line(case, against)
            )
    return "\n".join(lines) + "\n"


def _curvatures(cases: dict[str, Case]) -> str:
    """Both laws of curvature at 40 elements, from the tables of the cases."""
    lines = [
        "## Both curvatures at 40 elements",
        "",
        "`solver.curvature`: κ = φ is the default, κ = 2 tan(φ/2) the paper's; φ is the angle by which the",
        "rod turns at a node. Both are of second order. All meshes, and what the errors are, stand with each",
        "case.",
        "",
        "| case | load | error, κ = φ | error, κ = 2 tan(φ/2) | ratio |",
        "|---|---|---|---|---|",
    ]
    for case in (cases[name] for name in NAMES if name in cases):
        for table in case.tables:
            if table["head"][1] != "curvature":
                continue
            column = table["head"].index("40")
            # Three rows for each load: the default, the paper's, their ratio.
            for angle, tangent, ratio in zip(*[iter(table["rows"])] * 3, strict=True):
                cells = [case.title, angle[0], *(row[column] for row in (angle, tangent, ratio))]
                lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def _line(case: Case, against: str) -> str:
    row = case.tightest
    worst = "no band" if row is None else row.quantity
    value = "" if row is None else (_error(row) or _value(row.measured, row.unit))
    band = "" if row is None else _band(row)
    failed = " **outside**" if case.failures else ""
    orders = case.orders
    order = "" if not orders else _range(min(orders), max(orders))
    link = f"[{case.title}](#{_anchor(case.title)})"
    return f"| {link}{failed} | {against} | {_cell(worst)} | {value} | {band} | {order} |"


def _range(low: float, high: float) -> str:
    return f"{low:.2f}" if f"{low:.2f}" == f"{high:.2f}" else f"{low:.2f} to {high:.2f}"


def _anchor(title: str) -> str:
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


def _section(section: Section, cases: dict[str, Case], images: str) -> str:
    parts = [f"## {section.title}\n"]
    if section.text:
        parts.append(_wrapped(section.text) + "\n")
    parts += [_case(cases[name], images) for name in section.cases if name in cases]
    return "\n".join(parts)


def _case(case: Case, images: str) -> str:
    lines = [f"### {case.title}", "", f"- Law: {case.equation}", f"- Source: {case.source}"]
    lines.append(f"- Alone: `{COMMAND} {case.test} -- --nocapture`")
    if case.base:
        base = "the rod above" if "\n" in case.base else f"`{case.base}`"
        lines.append(f"- Scene: {base}" + (", with" if case.edits else ""))
    if case.edits:
        lines += ["", "```toml", *case.edits, "```"]
    lines += ["", _wrapped(case.note), ""] if case.note else [""]
    lines += ["| quantity | measured | expected | error | band |", "|---|---|---|---|---|"]
    lines += [_row(row) for row in case.rows]
    for table in case.tables:
        lines += ["", table["caption"], "", "| " + " | ".join(table["head"]) + " |"]
        lines.append("|---" * len(table["head"]) + "|")
        lines += ["| " + " | ".join(_exponent(_cell(cell)) for cell in row) + " |" for row in table["rows"]]
    for name, figure in zip(figure_names(case), case.figures, strict=True):
        lines += ["", f"![{figure['title']}]({images}/{name})"]
    return "\n".join(lines) + "\n"


def _row(row: Row) -> str:
    measured = _value(row.measured, row.unit)
    if row.quantiles:
        median, ninety, worst, count = row.quantiles
        measured = (
            f"{count:.0f} samples: median {_short(median)}, 90 % {_short(ninety)}, worst {_short(worst)}"
        )
    band = _band(row) if row.within else f"**outside of {_band(row)}**"
    return (
        f"| {_cell(row.quantity)} | {measured} | {_value(row.expected, row.unit)} | {_error(row)} | {band} |"
    )


def _error(row: Row) -> str:
    return "" if row.error is None else _with_unit(_short(row.error), row.error_unit)


def _band(row: Row) -> str:
    if not row.bounded:
        return "–"
    unit = row.unit if row.error is None else row.error_unit
    if row.error is not None or math.isinf(row.low):
        return f"≤ {_with_unit(_plain(row.high), unit)}"
    if row.low == -row.high:
        return f"± {_with_unit(_plain(row.high), unit)}"
    return _with_unit(f"{_plain(row.low)} to {_plain(row.high)}", unit)


def _with_unit(number: str, unit: str) -> str:
    if unit == "relative":
        return f"rel. {number}"
    return f"{number} {_cell(unit)}".rstrip()


def _value(numbers: list[float], unit: str) -> str:
    if not numbers:
        return ""
    # Of a point, what is only rounding beside the other coordinate.
    rounding = 1e-12 * max(abs(number) for number in numbers)
    texts = [_digits(number if abs(number) > rounding else 0.0) for number in numbers]
    text = texts[0] if len(texts) == 1 else f"({', '.join(texts)})"
    return _with_unit(text, unit)


def _digits(number: float) -> str:
    """Six digits, or two where the number is so small that it stands for zero."""
    return _exponent(f"{number:.6g}" if number == 0 or abs(number) >= 1e-6 else f"{number:.1e}")


def _short(number: float) -> str:
    return "0" if number == 0 else _exponent(f"{number:.1e}")


def _plain(number: float) -> str:
    return _exponent(f"{number:g}")


def _exponent(text: str) -> str:
    """1.0e-07 as 1.0e-7 and 1.0e+00 as 1.0, with a minus sign in front."""
    text = re.sub(r"e[+]?0+$", "", text)
    text = re.sub(r"e([+-])0*(\d)", lambda m: "e" + m[1].replace("+", "") + m[2], text)
    return re.sub(r"^-", "−", text)


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def _wrapped(text: str) -> str:
    return textwrap.fill(text, 128, break_long_words=False, break_on_hyphens=False)
