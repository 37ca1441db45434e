"""The figure of the page."""

from typing import Any

from matplotlib.ticker import NullFormatter

from studies.growth.page import PLACES, Results
from studies.growth.sweeps import SWEEPS
from studies.paper.figures import BLUE, ORANGE, PAPER, legend_above, panels

SHADES = {False: BLUE, True: ORANGE}
DRAWN = ("environments", "nodes", "magnets", "drives")


def picture(results: Results) -> Any:
    """Wall time of a control step against each size, on logarithmic axes."""
    figure, axes = panels(2, 2, (8.0, 6.0))
    drawn = [sweep for sweep in SWEEPS if sweep.name in DRAWN]
    for axis, sweep in zip(axes.flat, drawn, strict=True):
        for space, place in PLACES.items():
            points = results[sweep.name, space]
            sizes = [sweep.size(setting) for setting, _ in points]
            times_ms = [cost.seconds * 1e3 for _, cost in points]
            axis.plot(sizes, times_ms, "o-", color=SHADES[space], label=place)
            slope = [times_ms[-1] * size / sizes[-1] for size in sizes]
            axis.plot(sizes, slope, "--", color=PAPER, lw=0.7, zorder=1)
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_xlabel(sweep.title)
        axis.set_ylabel("wall time of a control step [ms]")
        if len(sizes) < 8:
            axis.set_xticks(sizes, [f"{size}" for size in sizes])
            axis.xaxis.set_minor_formatter(NullFormatter())
    legend_above(figure, axes.flat[0], 2)
    return figure
