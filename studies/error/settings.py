"""What is varied: integrator, step, mesh, wrench, how long it acts, and precision."""

from dataclasses import dataclass
from typing import Any

MS = 1e3
INTEGRATORS = {
    "newmark": "Newmark",
    "euler": "backward Euler",
    "explicit": "explicit, multipliers",
}


@dataclass(frozen=True)
class Settings:
    """Numerical choices of a run.

    Attributes:
        step_ms: Step [ms].
        elements: Elements of a bridge between two feet; of a rod, of its whole length.
        order: Order of the quadrature of the wrench; 0 takes dipoles.
        integrator: Scheme.
        interval: Steps for which a wrench acts.
        precision: Of numbers: double or single.
        foot_end: Elements of a foot's end; None for a quarter of those of a bridge, one at least.
    """

    step_ms: float
    elements: int = 4
    order: int = 2
    integrator: str = "newmark"
    interval: int = 1
    precision: str = "double"
    foot_end: int | None = None

    def changes(self, body: str) -> dict[str, Any]:
        """As values of a scene whose body is a worm or a rod."""
        values: dict[str, Any] = {
            "solver.integrator": self.integrator,
            "solver.precision": self.precision,
            "solver.step_s": self.step_ms / MS,
        }
        if self.order:
            values["solver.quadrature_order"] = self.order
        else:
            values["solver.magnet_model"] = "dipole"
        values["solver.wrench_interval"] = self.interval
        if body == "rod":
            return values | {"body.elements": self.elements}
        values["body.elements_per_bridge"] = self.elements
        values["body.elements_per_foot_end"] = self.foot_end or quarter(self.elements)
        return values

    @property
    def age_ms(self) -> float:
        """Mean age of the wrenches that act [ms]."""
        return 0.5 * (self.interval - 1) * self.step_ms

    def text(self) -> str:
        """In words."""
        wrench = f"order {self.order}" if self.order else "dipoles"
        held = f", a wrench for {self.interval} steps" if self.interval > 1 else ""
        numbers = ", single" if self.precision == "single" else ""
        scheme, mesh = f"{INTEGRATORS[self.integrator]}, {self.step_ms:g} ms", f"{self.elements} elements"
        ends = f", {self.foot_end} a foot's end" if self.foot_end else ""
        return f"{scheme}, {mesh}{ends}, {wrench}{held}{numbers}"


def quarter(elements: int) -> int:
    """Elements of a foot's end beside a bridge of so many."""
    return max(1, elements // 4)
