"""The page ``docs/turning.md``: everything on it follows from the results."""

from collections.abc import Mapping, Sequence

from studies.turning.findings import (
    estimate,
    offset_table,
    plane_text,
    range_text,
    roll_text,
    step_text,
    tipping_text,
    yaw_text,
)
from studies.turning.passes import NEIGHBOURS_MM, Drive, Outcome, Point
from studies.turning.plane import Comparison

IMAGES = "images/turning"
INTRODUCTION = f"""# Turning map

Written by `make turning-map`; do not edit. How far one pass of a single drive magnet turns the robots of
`paper-3`, `paper-4` and `paper-5` in space, and when they tip over. The paper's model is planar and its
experiments give no figures of turning: all of this is of the model, identified from planar figures, and
compared with no robot.

The drive moves along +x, from head to tail, at 100 mm/s and 22 mm below the ground unless said, from 50 mm
ahead of the head to 50 mm beyond the tail; the robot then lies for 0.3 s. Offset is along +z, to the robot's
left. *Yaw* is the turn of the line from head to tail magnet, positive anticlockwise from above: towards the
drive. *Side-step* is the way of the centre along +z, positive towards the drive; *stride* its way along −x.
*Roll* is that of a foot about its own length. A foot *tips over* where it rolls beyond 60°, as in
`MagWorm/Turn-v0`; a robot is *carried along* where the drive takes it further than one magnet pitch, 20 mm.

Stick and slip make a single pass rugged. Each point is the mean of {len(NEIGHBOURS_MM)} passes at heights
within ±{max(NEIGHBOURS_MM):g} mm; the band is their range, not a confidence interval. Passes in which a foot
tips over or the robot is carried along are left out: marks are white where that happened to some neighbours,
and crosses at the upper edge where it happened to all. The step is that of the presets, 2 ms; what a shorter
one changes is under *Steps*. Only the soles touch the ground in the model: what a robot does after it has
tipped over and lies half in the ground means nothing, and no figure uses it but the share that did not come
back and rolls beyond 90°.

Data: `studies/turning/points.csv` (averaged points), `tipping.csv` (single passes), `plane.csv`.
"""

SECTIONS = {
    "offset": (
        "Lateral offset",
        "Yaw, side-step and stride of a pass against the lateral offset of the drive; mean and range of "
        "neighbours.",
    ),
    "yaw": (
        "Yaw of the drive",
        "The same against the yaw of the drive: above on the line, below 3 mm beside it.",
    ),
    "height": ("Height of the drive", "The same against the height of the drive, 3 mm beside the line."),
    "speed": ("Speed of the drive", "The same against the speed of the drive, 3 mm beside the line."),
}


def page(
    sweeps: Mapping[str, Sequence[Point]],
    drives: Sequence[Drive],
    tipping: Sequence[Outcome],
    comparisons: Sequence[Comparison],
) -> str:
    """The page as Markdown.

    Args:
        sweeps: Averaged points by the name of their sweep.
        drives: Single passes of the tipping map.
        tipping: What they did.
        comparisons: Planar presets in space.
    """
    texts = {
        "offset": f"{estimate(sweeps['offset'])}\n\n{offset_table(sweeps['offset'])}",
        "yaw": yaw_text(sweeps["yaw"]),
        "height": range_text(sweeps["height"], "height_mm", "mm"),
        "speed": range_text(sweeps["speed"], "speed_mm_s", "mm/s"),
    }
    parts = [INTRODUCTION]
    for name, (title, caption) in SECTIONS.items():
        parts += [f"\n## {title}\n", texts[name], _image(name, caption)]
    parts += [
        "\n## Roll and tipping over\n",
        roll_text(sweeps["offset"]),
        _image(
            "roll",
            "Greatest roll of each foot in a pass against the offset, mean of neighbours; what is beyond 95° "
            "is drawn at 95°.",
        ),
        "\n" + tipping_text(drives, tipping),
        _image(
            "tipping",
            "Greatest roll of any foot in a single pass over offset and height of the drive; the scale of "
            "offsets is not even. White crosses: a foot still lies beyond 60° at the end.",
        ),
        "\n## Steps\n",
        step_text(sweeps["step"]),
        "\n## The plane in space\n",
        plane_text(comparisons),
    ]
    return "\n".join(parts) + "\n"


def _image(name: str, caption: str) -> str:
    return f"\n![{caption}]({IMAGES}/{name}.png)\n\n*{caption}*"
