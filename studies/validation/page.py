"""The page ``docs/validation.md``: what was measured, as Markdown."""

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from studies.kit.page import page
from studies.kit.words import exponent, plain, short
from studies.validation.cases import Case, Row, Section

COMMAND = "cargo test --release -p magworm --test validation"


def validation_page(cases: Mapping[str, Case], sections: Sequence[Section]) -> str:
    """The whole page."""
    return page(
        Path(__file__).with_name("page.md"),
        command=COMMAND,
        cases=cases,
        sections=sections,
        rods=sorted({case.base.strip() for case in cases.values() if case.is_rod}),
        curvatures=list(_curvatures(cases, sections)),
        tightest=_tightest,
        anchor=_anchor,
        between=_range,
        row_cells=_row_cells,
        written=_written,
    )


def _tightest(case: Case) -> list[str]:
    """What uses up most of its band: its name, error or value, band."""
    row = case.tightest
    if row is None:
        return ["no band", "", ""]
    return [_cell(row.quantity), _error(row) or _value(row.measured, row.unit), _band(row)]


def _curvatures(cases: Mapping[str, Case], sections: Sequence[Section]) -> Iterator[list[str]]:
    """Both laws of curvature at 40 elements, from the tables of the cases."""
    names = [name for section in sections for name in section.cases if name in cases]
    for case in (cases[name] for name in names):
        for table in case.tables:
            if table.head[1] != "curvature":
                continue
            column = table.head.index("40")
            # Three rows for each load: the default, the paper's, their ratio.
            for angle, tangent, ratio in zip(*[iter(table.rows)] * 3, strict=True):
                yield [case.title, angle[0], *(row[column] for row in (angle, tangent, ratio))]


def _range(values: Sequence[float]) -> str:
    if not values:
        return ""
    low, high = f"{min(values):.2f}", f"{max(values):.2f}"
    return low if low == high else f"{low} to {high}"


def _anchor(title: str) -> str:
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


def _row_cells(row: Row) -> list[str]:
    measured = _value(row.measured, row.unit)
    if row.quantiles:
        *errors, count = row.quantiles
        median, ninety, worst = map(short, errors)
        measured = f"{count:.0f} samples: median {median}, 90 % {ninety}, worst {worst}"
    band = _band(row) if row.within else f"**outside of {_band(row)}**"
    return [_cell(row.quantity), measured, _value(row.expected, row.unit), _error(row), band]


def _error(row: Row) -> str:
    return "" if row.error is None else _with_unit(short(row.error), row.error_unit)


def _band(row: Row) -> str:
    if not row.bounded:
        return "–"
    unit = row.unit if row.error is None else row.error_unit
    if row.error is not None or math.isinf(row.low):
        return f"≤ {_with_unit(plain(row.high), unit)}"
    if row.low == -row.high:
        return f"± {_with_unit(plain(row.high), unit)}"
    return _with_unit(f"{plain(row.low)} to {plain(row.high)}", unit)


def _with_unit(number: str, unit: str) -> str:
    return f"rel. {number}" if unit == "relative" else f"{number} {_cell(unit)}".rstrip()


def _value(numbers: Sequence[float], unit: str) -> str:
    if not numbers:
        return ""
    # Of a point, what is only rounding beside the other coordinate.
    rounding = 1e-12 * max(abs(number) for number in numbers)
    texts = [_digits(number if abs(number) > rounding else 0.0) for number in numbers]
    return _with_unit(texts[0] if len(texts) == 1 else f"({', '.join(texts)})", unit)


def _digits(number: float) -> str:
    """Six digits, or two where the number is so small that it stands for zero."""
    return plain(number) if number == 0 or abs(number) >= 1e-6 else short(number)


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def _written(cells: Sequence[str]) -> list[str]:
    return [exponent(_cell(text)) for text in cells]
