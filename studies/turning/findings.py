"""What the page says of the results, in sentences and tables."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from studies.kit.page import table
from studies.kit.words import COUNTS, capital, listed, number
from studies.turning.passes import Drive, Outcome, Point, Spread
from studies.turning.plane import ASIDE_MM, Comparison
from studies.turning.sweeps import HEIGHTS_MM, OFFSET_MM, ROBOTS, TIPPING_OFFSETS_MM

WITHIN = 0.01
UNIT_MM = 1.0
"""Ours: the offset beside which the roll of the smallest is put."""
AMPLIFIED = 2.0
"""Ours: roll that exceeds its share so many times is amplified."""
EVEN_DEG = 1.0
"""Ours: a roll that falls by less than this between two offsets counts as level."""
RUGGED_MM, SIGN_DEG = 1.0, 1.0
"""Ours: neighbours whose strides differ, or whose turns oppose each other, by more are named."""


def _of(points: Sequence[Point], magnets: int, offset_mm: float | None = None) -> list[Point]:
    return [
        point
        for point in points
        if point.drive.magnets == magnets and offset_mm in (None, point.drive.offset_mm)
    ]


def _upright(points: Sequence[Point]) -> list[Point]:
    """Points with a mean: at least one neighbour neither tipped over nor was carried along."""
    return [point for point in points if point.kept]


def _span(values: Sequence[float], digits: int = 1) -> str:
    """The range of values in words."""
    low, high = number(min(values), digits), number(max(values), digits)
    return low if low == high else f"{low} to {high}"


def estimate(points: Sequence[Point]) -> str:
    """The sweep beside what rigid links gave."""
    three = _of(points, 3)
    near, far = (
        _upright([point for point in three if low <= point.drive.offset_mm <= high])
        for low, high in ((2.0, 4.0), (8.0, 15.0))
    )
    words = {}
    for name, group in (("near", near), ("far", far)):
        words[name] = (
            f"{_span([point.yaw_deg.mean for point in group])}° of yaw, a side-step of "
            f"{_span([point.side_mm.mean for point in group])} mm and a stride of "
            f"{_span([point.stride_mm.mean for point in group])} mm"
            if group
            else "nothing, for it tips over"
        )
    inside = near and all(0.5 <= point.yaw_deg.mean <= 3.0 for point in near)
    changes = near and far and max(p.side_mm.mean for p in far) < min(p.side_mm.mean for p in near)
    rolls = [float(point.roll_deg.max()) for point in three]
    grows = all(after >= before - EVEN_DEG for before, after in pairwise(rolls))
    regime = ": another regime, in which they step away from the drive and crawl less far. "
    return (
        "An independent estimate with rigid links gave three magnets 0.5° to 3° a pass at 2 to 4 mm, another "
        "regime beyond 8 mm, and a roll that grows with the offset. Here three magnets make at 2 to 4 mm "
        f"{words['near']}: {'within' if inside else '**not within**'} the estimate. At 8 to 15 mm they make "
        f"{words['far']}{regime if changes else '. '}"
        f"The greatest roll {'grows' if grows else 'does not grow throughout'} with the offset, from "
        f"{number(rolls[0], 1)}° on the line to {number(rolls[4], 1)}° at 4 mm, {number(rolls[8], 1)}° at 8 "
        f"mm and {number(rolls[-1], 1)}° at {three[-1].drive.offset_mm:g} mm.\n\n{_others(points)} "
        f"{_rugged(points)}"
    )


def _others(points: Sequence[Point]) -> str:
    """What robots with more magnets do."""
    five = _upright(_of(points, 5))
    near = [point.yaw_deg.mean for point in five if point.drive.offset_mm <= 4.0]
    sentences = [f"Five magnets turn by {_span(near)}° up to 4 mm."] if near else []
    away = [point for point in five if point.yaw_deg.mean < -SIGN_DEG]
    if away:
        most = min(away, key=lambda point: point.yaw_deg.mean)
        sentences.append(
            f"At {_offsets([point.drive.offset_mm for point in away])} they turn away from the drive, by up "
            f"to {number(-most.yaw_deg.mean, 1)}° at {most.drive.offset_mm:g} mm."
        )
    four = [point.drive.offset_mm for point in _of(points, 4) if not point.kept]
    if four:
        sentences.append(
            f"Four magnets tip over at {_offsets(four)}: their last foot is repelled and has a bridge on one "
            "side only."
        )
    return " ".join(sentences)


def _rugged(points: Sequence[Point]) -> str:
    """At how many offsets neighbours differ."""
    kept = _upright([point for point in points if point.drive.magnets != 4])
    wide = [point for point in kept if point.stride_mm.high - point.stride_mm.low > RUGGED_MM]
    return (
        f"At {len(wide)} of {len(kept)} points of three and five magnets neighbours differ by more than "
        f"{RUGGED_MM:g} mm in their stride: there the mean stands for no single pass."
    )


def _offsets(offsets_mm: Sequence[float]) -> str:
    steps = {round(b - a, 6) for a, b in pairwise(offsets_mm)}
    if steps == {1.0} and len(offsets_mm) > 2:
        return f"every offset from {offsets_mm[0]:g} to {offsets_mm[-1]:g} mm"
    return f"{listed([f'{offset:g}' for offset in offsets_mm])} mm"


def _cell(spread: Spread, digits: int = 2) -> str:
    if np.isnan(spread.mean):
        return "–"
    half = number(0.5 * (spread.high - spread.low), digits)
    mean = number(spread.mean, digits)
    return f"{mean} ± {half}" if float(half) else mean


def offset_table(points: Sequence[Point]) -> str:
    """What a pass does at each lateral offset, of three and of five magnets."""
    header = ["offset, mm"]
    for count in (3, 5):
        header += [f"{count}: yaw, °", "side-step, mm", "stride, mm", "roll, °", "left out"]
    rows = []
    for three, five in zip(_of(points, 3), _of(points, 5), strict=True):
        row = [f"{three.drive.offset_mm:g}"]
        for point in (three, five):
            row += [_cell(point.yaw_deg), _cell(point.side_mm), _cell(point.stride_mm)]
            row += [number(float(point.roll_deg.max()), 1), f"{point.passes - point.kept} of {point.passes}"]
        rows.append(row)
    return (
        "Three and five magnets; ± is half the range of the neighbours; roll is the greatest of any foot, "
        "mean of all neighbours:\n\n" + table(header, rows)
    )


def yaw_text(points: Sequence[Point]) -> str:
    """What the yaw of the drive does, on the line and beside it."""
    lines = []
    for count in ROBOTS:
        for offset in (0.0, OFFSET_MM):
            here = _of(points, count, offset)
            good = _upright(here)
            start = f"- {capital(COUNTS[count])} magnets at {offset:g} mm: "
            if not good:
                lines.append(f"{start}tip over at every yaw.")
                continue
            best = max(good, key=lambda point: abs(point.yaw_deg.mean))
            first, last = good[0], good[-1]
            lines.append(
                f"{start}the greatest turn is {_cell(best.yaw_deg)}° at a drive yaw of "
                f"{best.drive.yaw_deg:g}°; the stride goes from {_cell(first.stride_mm)} mm at "
                f"{first.drive.yaw_deg:g}° to {_cell(last.stride_mm)} mm at {last.drive.yaw_deg:g}°"
                f"{_left_out(here, 'yaw_deg', '°')}{_opposed(good)}."
            )
    return (
        "The drive is longer across its way than along it (26.2 mm by 14.9 mm), so yaw changes its field. At "
        "0° and 90° on the line nothing distinguishes left from right.\n\n" + "\n".join(lines)
    )


def _opposed(points: Sequence[Point]) -> str:
    """Where neighbours turn to opposite sides."""
    yaws = [
        f"{point.drive.yaw_deg:g}"
        for point in points
        if point.yaw_deg.low < -SIGN_DEG and point.yaw_deg.high > SIGN_DEG
    ]
    return f"; **neighbours turn to opposite sides** at {listed(yaws)}°" if yaws else ""


def _left_out(points: Sequence[Point], field: str, unit: str) -> str:
    """Where neighbours tipped over or were carried along."""
    parts = []
    for word, count in (("tip over", "tipped"), ("are carried along", "carried")):
        gone = [point for point in points if getattr(point, count)]
        if gone:
            names = [f"{getattr(point.drive, field):g}".replace("-", "−") for point in gone]
            who = "all neighbours" if all(getattr(p, count) == p.passes for p in gone) else "neighbours"
            parts.append(f"; {who} {word} at {listed(names)} {unit}".replace(" °", "°"))
    return "".join(parts)


def range_text(points: Sequence[Point], field: str, unit: str) -> str:
    """What the height or the speed of the drive does, beside the line."""
    lines = []
    for count in ROBOTS:
        here = _of(points, count)
        good = _upright(here)
        if not good:
            lines.append(f"- {capital(COUNTS[count])} magnets tip over at every one.")
            continue
        best = max(good, key=lambda point: abs(point.yaw_deg.mean))
        far = max(good, key=lambda point: point.stride_mm.mean)
        at, stride_at = (f"{getattr(p.drive, field):g}".replace("-", "−") for p in (best, far))
        lines.append(
            f"- {capital(COUNTS[count])} magnets: the greatest turn is {_cell(best.yaw_deg)}° at {at} "
            f"{unit}, the longest stride {_cell(far.stride_mm)} mm at {stride_at} {unit}"
            f"{_left_out(here, field, unit)}."
        )
    return f"At {OFFSET_MM:g} mm beside the line:\n\n" + "\n".join(lines)


def roll_text(points: Sequence[Point]) -> str:
    """How far each foot rolls."""
    lines = []
    for count in ROBOTS:
        here = _of(points, count)
        gone = [point.drive.offset_mm for point in here if point.tipped]
        back = [point.drive.offset_mm for point in here if point.tipped > point.overturned]
        if not gone:
            top = max(here, key=lambda point: point.roll_deg.max())
            kind = "repelled" if int(top.roll_deg.argmax()) % 2 else "attracted"
            end = (
                f"no foot tips over; the greatest roll is {number(float(top.roll_deg.max()), 1)}° at "
                f"{top.drive.offset_mm:g} mm, of a foot that is {kind}"
            )
        else:
            end = f"at least one neighbour tips over at {_offsets(gone)}"
            end += f", and comes back by itself at {_offsets(back)}" if back else "; none comes back"
        lines.append(f"- {capital(COUNTS[count])} magnets: {end}.")
    return (
        "Every second foot, from the second on, is repelled by the drive and kept from rolling by its "
        "bridges alone; the others are drawn to the ground.\n\n" + "\n".join(lines)
    )


def tipping_text(drives: Sequence[Drive], found: Sequence[Outcome]) -> str:
    """From which offset on each robot tips over."""
    small = TIPPING_OFFSETS_MM[0]
    header = ["height, mm"]
    for count in ROBOTS:
        header += [f"{count}: roll at {small:g} mm, °", f"at {UNIT_MM:g} mm, °", "tips first at"]
    by_place = {(d.magnets, d.height_mm, d.offset_mm): o for d, o in zip(drives, found, strict=True)}
    rows = []
    amplified: dict[int, list[str]] = {count: [] for count in ROBOTS}
    for height in HEIGHTS_MM:
        row = [number(height, 0)]
        for count in ROBOTS:
            here = {offset: by_place[count, height, offset] for offset in TIPPING_OFFSETS_MM}
            least, unit = (float(here[offset].roll_deg.max()) for offset in (small, UNIT_MM))
            upright = not here[UNIT_MM].tipped
            if not upright or least > AMPLIFIED * unit * small / UNIT_MM:
                amplified[count].append(number(height, 0))
            row += [number(least, 2), number(unit, 1) if upright else "tips"]
            row.append(first_tipping([outcome.tipped for outcome in here.values()]))
        rows.append(row)
    where = "; ".join(
        f"{COUNTS[count]} magnets at {listed(heights)} mm" if heights else f"{COUNTS[count]} magnets nowhere"
        for count, heights in amplified.items()
    )
    return (
        f"*Upright margin.* A drive {small:g} mm beside the line is a small perturbation. Where the robot is "
        "upright in a stable way, the roll that it leaves is small, in proportion to the offset; elsewhere "
        "roll is amplified until the drive has gone or the robot lies over. It is amplified, to more than "
        f"{AMPLIFIED:g} times its share of that at {UNIT_MM:g} mm or to tipping: {where}. The smallest "
        "offset at which a foot tips lies between the two that are given. Single passes, without neighbours; "
        "a robot that tips at one offset need not at every greater one, as the map shows.\n\n"
        + table(header, rows)
    )


def first_tipping(tipped: Sequence[bool]) -> str:
    """Between which offsets of the map a robot first tips over.

    Args:
        tipped: Whether it did, for each of :data:`TIPPING_OFFSETS_MM`.
    """
    if not any(tipped):
        return f"not up to {TIPPING_OFFSETS_MM[-1]:g} mm"
    first = list(tipped).index(True)
    low = TIPPING_OFFSETS_MM[first - 1] if first else 0.0
    return f"{low:g} to {TIPPING_OFFSETS_MM[first]:g} mm"


def step_text(points: Sequence[Point]) -> str:
    """What shorter solver steps change."""
    steps = sorted({point.drive.step_ms for point in points}, reverse=True)
    places = list(dict.fromkeys((point.drive.magnets, point.drive.offset_mm) for point in points))
    by_place = {(p.drive.magnets, p.drive.offset_mm, p.drive.step_ms): p for p in points}
    header = ["magnets", "offset, mm", *(f"yaw at {step:g} ms, °" for step in steps)]
    header += [f"side-step at {step:g} ms, mm" for step in steps]
    header += [f"stride at {step:g} ms, mm" for step in steps]
    rows, inside, most = [], [], {"yaw_deg": 0.0, "side_mm": 0.0, "stride_mm": 0.0}
    for count, offset in places:
        row = [f"{count}", f"{offset:g}"]
        for name in most:
            spreads = [getattr(by_place[count, offset, step], name) for step in steps]
            row += [_cell(spread) for spread in spreads]
            moved = [abs(spread.mean - spreads[0].mean) for spread in spreads[1:]]
            most[name] = float(np.nanmax([most[name], *moved]))
            if offset or name == "stride_mm":
                inside.append(spreads[0].low <= spreads[-1].mean <= spreads[0].high)
        rows.append(row)
    return (
        "Mean and half the range of the same neighbours with half and a quarter of the step. The mean with a "
        f"quarter of it lies within the range of the neighbours at 2 ms in {sum(inside)} of {len(inside)} "
        "figures, those left out that are 0 by symmetry. A shorter step moves the mean yaw by at most "
        f"{number(most['yaw_deg'], 2)}°, the side-step by {number(most['side_mm'], 2)} mm and the stride by "
        f"{number(most['stride_mm'], 2)} mm. That is no convergence to a digit: when a foot slips is decided "
        "anew by every small change, of the step as of the height, and a single pass may differ by a "
        "millimetre or two from its neighbours.\n\n" + table(header, rows)
    )


def plane_text(comparisons: Sequence[Comparison]) -> str:
    """The planar presets in space, beside the plane."""
    names = {
        "lift": "lift at the end",
        "peak": "peak of a pass",
        "stride": "stride of a pass",
    }
    rows = []
    for each in comparisons:
        what = names[each.figure].replace("a pass", "a period") if each.case == "belt" else names[each.figure]
        rows.append(
            [
                f"`{each.preset}`",
                what,
                number(each.plane_mm, 3),
                number(each.space_mm, 3),
                f"{number(100.0 * each.difference, 2)} %",
                "yes" if abs(each.difference) <= WITHIN else "**no**",
                number(each.apart_mm, 4),
                f"{each.roll_deg:.0e}",
                number(each.aside_mm, 3),
                number(each.aside_roll_deg, 2),
            ]
        )
    within = sum(abs(each.difference) <= WITHIN for each in comparisons)
    most = max(comparisons, key=lambda each: each.aside_roll_deg)
    header = [
        "preset",
        "figure",
        "plane, mm",
        "space, mm",
        "difference",
        "within 1 %",
        "apart, mm",
        "roll, °",
    ]
    header += [f"{ASIDE_MM:g} mm aside, mm", "roll, °"]
    return (
        "The planar presets with `dimensions = 3` and the drive on the line. Lift: the drive rises from −52 "
        "to −22 mm in 0.5 s under the middle and stands for 0.3 s. Pass: 1.5 s at 100 mm/s from 50 mm ahead. "
        "Belt: one period. Lift and peak are of the magnet that rises furthest. *Apart* is the greatest "
        "distance of any magnet from its planar place at any time; it is beyond rounding where a foot slips "
        "in the one and not in the other. On the line roll stays that of rounding, also where it would be "
        "amplified; so the "
        f"last two columns have the drive {ASIDE_MM:g} mm beside it. {within} of {len(comparisons)} figures "
        "agree within 1 %. The greatest roll with the drive hardly aside is "
        f"{number(most.aside_roll_deg, 2)}°, of `{most.preset}`.\n\n" + table(header, rows)
    )
