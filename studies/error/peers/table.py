"""The peers' runs as a table of comma-separated values and as text."""

import csv
from collections.abc import Sequence
from io import StringIO

from studies.error.peers.runs import PeerRun

COLUMNS = (
    "case",
    "name",
    "version",
    "elements",
    "step_s",
    "tip_x_mm",
    "tip_y_mm",
    "error",
    "own_error",
    "wall_s",
)


def peers_csv(runs: Sequence[PeerRun]) -> str:
    """One row a run."""
    written = StringIO()
    csv.writer(written, lineterminator="\n").writerows([COLUMNS, *(row(run) for run in runs)])
    return written.getvalue()


def row(run: PeerRun) -> list[str]:
    """In the order of the columns."""
    x_mm, y_mm = run.tip_mm
    places = [f"{x_mm:.4f}", f"{y_mm:.4f}", f"{run.error:.5f}", f"{run.own_error:.5f}"]
    return [
        run.case,
        run.name,
        run.version,
        str(run.elements),
        f"{run.step_s:.4g}",
        *places,
        f"{run.wall_s:.3g}",
    ]


def peers_text(runs: Sequence[PeerRun]) -> str:
    """For a terminal."""
    rows = [COLUMNS, *(row(run) for run in runs)]
    widths = [max(len(cells[k]) for cells in rows) for k in range(len(COLUMNS))]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(cells, widths, strict=True)).rstrip()
        for cells in rows
    )
