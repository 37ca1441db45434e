"""The figure of the page."""

from typing import Any

from matplotlib.ticker import NullFormatter

from studies.growth.page import PLACES, Results
from studies.growth.sweeps import SWEEPS
from studies.kit.figures import BLUE, ORANGE, REFERENCE, legend_above, panels

SHADES = {False: BLUE, True: ORANGE}
DRAWN = ("environments", "nodes", "magnets", "drives")


def picture(results: Results) -> Any:
    """Wall and processor time of a control step against each size, on logarithmic axes."""
    figure, axes = panels(2, 2, (8.0, 6.0))
    drawn = [sweep for sweep in SWEEPS if sweep.name in DRAWN]
    for axis, sweep in zip(axes.flat, drawn, strict=True):
        for space, place in PLACES.items():
            points = results[sweep.name, space]
            sizes = [sweep.size(setting) for setting, _ in points]
            wall_ms = [cost.seconds * 1e3 for _, cost in points]
            processor_ms = [cost.processor_s * 1e3 for _, cost in points]
            look = {"color": SHADES[space]}
            axis.plot(sizes, wall_ms, "o:", mfc="white", lw=0.9, label=f"{place}, wall", **look)
            axis.plot(sizes, processor_ms, "o-", label=f"{place}, processor", **look)
            slope = [processor_ms[-1] * size / sizes[-1] for size in sizes]
            axis.plot(sizes, slope, "--", color=REFERENCE, lw=0.7, zorder=1)
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_xlabel(sweep.title)
        axis.set_ylabel("time of a control step [ms]")
        if len(sizes) < 8:
            axis.set_xticks(sizes, [f"{size}" for size in sizes])
            axis.xaxis.set_minor_formatter(NullFormatter())
    legend_above(figure, axes.flat[0], 4)
    return figure
