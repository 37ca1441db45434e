"""What the page asks of the results."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from studies.kit.page import table
from studies.kit.words import exponent, number
from studies.stability.cases import VERDICTS, Outcome
from studies.stability.energy import Swing
from studies.stability.starts import STARTS, places

WHERE = {2: "plane", 3: "space"}


def verdicts(outcomes: Iterable[Outcome], integrator: str, dimensions: Sequence[int] = (2, 3)) -> list[int]:
    """How often each verdict was given to cases under a scheme."""
    cases = ((outcome.verdict, outcome.case) for outcome in outcomes)
    counts = Counter(
        verdict for verdict, of in cases if of.integrator == integrator and of.dimensions in dimensions
    )
    return [counts[verdict] for verdict in VERDICTS]


def tabled(title: str, row: str, scheme: str, outcomes: Sequence[Outcome]) -> str:
    """A table of outcomes, with a column for each scheme in plane and space.

    Args:
        title: Of the first column.
        row: The attribute of a case that its rows differ by.
        scheme: The attribute that its columns differ by.
        outcomes: In the order of rows and columns.
    """
    cells = {(getattr(o.case, row), o.case.dimensions, getattr(o.case, scheme)): cell(o) for o in outcomes}
    columns = dict.fromkeys(key[1:] for key in cells)
    head = [title, *(f"{name}, {WHERE[dimensions]}" for dimensions, name in columns)]
    names = dict.fromkeys(name for name, *_ in cells)
    return table(head, ([name, *(cells.get((name, *key), "") for key in columns)] for name in names))


def described(body: str, start: str) -> str:
    """The fields that a start sets."""
    where = ", in space" if places(body, start) == (3,) else ""
    return ", ".join(f"`{field} = {value}`" for field, value in STARTS[body][start].items()) + where


def cell(outcome: Outcome) -> str:
    """A verdict and the error over the length."""
    percent = 100.0 * outcome.error
    if percent != percent:
        return outcome.verdict
    return f"{outcome.verdict} {number(percent, 0) if percent >= 10.0 else two_digits(percent)} %"


def two_digits(value: float) -> str:
    """A number with two significant digits."""
    return exponent(f"{value:.2g}")


def sentences(outcomes: Iterable[Outcome]) -> Iterator[str]:
    """The first refusal that names each field, and every way to break."""
    refused: dict[str, str] = {}
    broken: dict[str, str] = {}
    for outcome in outcomes:
        if outcome.verdict == "refused":
            refused.setdefault(outcome.sentence.split(" is ")[0], outcome.sentence)
        elif outcome.verdict == "broken":
            broken.setdefault(outcome.sentence, outcome.sentence)
    yield from (f"Refused, for example: {sentence}." for sentence in refused.values())
    yield from (f"Broken: {sentence}." for sentence in broken)


def energies(swings: Iterable[Swing]) -> dict[tuple[str, str, float], list[Swing]]:
    """Swings that ran, those of all stiffnesses together, by motion, scheme and step [ms]."""
    found: dict[tuple[str, str, float], list[Swing]] = {}
    for swing in swings:
        if swing.gain == swing.gain:
            found.setdefault((swing.motion, swing.integrator, swing.step_ms), []).append(swing)
    return found
