"""What checks find."""

from dataclasses import dataclass
from typing import Literal

Outcome = Literal["passed", "failed", "noted", "skipped"]


@dataclass(frozen=True)
class Finding:
    """The outcome of one check.

    Attributes:
        check: What was checked.
        outcome: "passed"; "failed"; "noted", where the interface permits what users may trip over;
            "skipped", where there was nothing to check.
        sentence: What was found; empty if it passed.
    """

    check: str
    outcome: Outcome
    sentence: str = ""


@dataclass(frozen=True)
class Report:
    """The outcomes of all checks. Printed, it is one line per check.

    Attributes:
        environment: Name of the environment.
        findings: One per check.
    """

    environment: str
    findings: tuple[Finding, ...]

    def with_outcome(self, outcome: Outcome) -> tuple[Finding, ...]:
        """The findings with this outcome."""
        return tuple(finding for finding in self.findings if finding.outcome == outcome)

    @property
    def passed(self) -> bool:
        """Whether no check failed."""
        return not self.with_outcome("failed")

    def __str__(self) -> str:
        """One line per check."""
        lines = [
            f"{f.outcome:8} {f.check}" + (f": {f.sentence}" if f.sentence else "") for f in self.findings
        ]
        return "\n".join([self.environment, *lines])


class Noted(Exception):
    """A check found what the interface permits, but users may trip over."""

    outcome: Outcome = "noted"


class Skipped(Exception):
    """A check found nothing to check."""

    outcome: Outcome = "skipped"
