"""Which passes are run."""

from studies.turning.passes import Drive

ROBOTS = (3, 4, 5)
OFFSET_MM = 3.0
"""Where the sweeps over height and speed are run."""
OFFSETS_MM = tuple(float(offset) for offset in range(16))
YAWS_DEG = tuple(10.0 * i for i in range(10))
HEIGHTS_MM = tuple(-20.0 - 2.0 * i for i in range(8))
SPEEDS_MM_S = (20.0, 40.0, 60.0, 80.0, 100.0, 120.0, 140.0, 160.0, 180.0, 210.0)

UNIT_MM = 1.0
"""Ours: the offset beside which the roll of the smallest is put."""
TIPPING_OFFSETS_MM = (0.01, 0.1, 0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0, 12.0, 15.0)
"""The first is small enough to be a perturbation: the roll that it leaves is one of stability."""

STEPS_MS = (2.0, 1.0, 0.5)
STEP_POINTS = ((3, 1.0), (3, 3.0), (3, 6.0), (3, 10.0), (4, 0.0), (5, 1.0), (5, 3.0), (5, 6.0))
"""Magnets and offset [mm] of the passes that are run again with shorter steps."""

SWEEPS: dict[str, list[Drive]] = {
    "offset": [Drive(n, offset_mm=offset) for n in ROBOTS for offset in OFFSETS_MM],
    "yaw": [
        Drive(n, offset_mm=offset, yaw_deg=yaw)
        for n in ROBOTS
        for offset in (0.0, OFFSET_MM)
        for yaw in YAWS_DEG
    ],
    "height": [Drive(n, offset_mm=OFFSET_MM, height_mm=height) for n in ROBOTS for height in HEIGHTS_MM],
    "speed": [Drive(n, offset_mm=OFFSET_MM, speed_mm_s=speed) for n in ROBOTS for speed in SPEEDS_MM_S],
    "step": [Drive(n, offset_mm=offset, step_ms=step) for n, offset in STEP_POINTS for step in STEPS_MS],
}
"""Averaged over neighbouring heights."""

TIPPING = [
    Drive(n, offset_mm=offset, height_mm=height)
    for n in ROBOTS
    for height in HEIGHTS_MM
    for offset in TIPPING_OFFSETS_MM
]
"""Single passes: roll is a smoother function than what friction leaves."""
