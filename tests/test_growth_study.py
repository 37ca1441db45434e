"""The study of how cost grows."""

import numpy as np
import pytest

pytest.importorskip("stable_baselines3")

from magworm_gym import SceneError
from studies.growth.measure import Cost, Point, Size, point
from studies.growth.memory import Memory
from studies.growth.share import Case, around_s
from studies.growth.study import PLACES, Machine, figure, text
from studies.growth.sweeps import BEYOND, SWEEPS, Setting, exponent, refusals

BLOCK = 8


def test_exponents_are_those_of_the_upper_part() -> None:
    sizes = [1, 2, 4, 8, 16, 32, 64, 128]
    costs = [max(100.0, 3.0 * size**1.5) for size in sizes]
    found = exponent(sizes, costs)
    assert found is not None and found.least == 16
    assert found.value == pytest.approx(1.5) and found.error == pytest.approx(0.0, abs=1e-12)
    bent = exponent(sizes[-4:], [1.0, 2.0, 4.0, 16.0])
    # By hand: powers 0, 1, 2, 4 of two at 0, 1, 2, 3 doublings; slope 1.3, residuals 0.2, -0.1, -0.4, 0.3.
    assert bent is not None and bent.value == pytest.approx(1.3)
    assert bent.error == pytest.approx(np.sqrt(0.3 / 2 / 5))
    assert exponent([1, 2], [1.0, 2.0]) is None


@pytest.mark.parametrize("dimensions", PLACES)
def test_wrenches_are_counted_for_every_pair_of_magnets(dimensions: int) -> None:
    """Two of a body's six pairs lie evenly about its middle and count twice."""
    row = {"kind": "belt", "pitch_m": 0.05, "count": 3}
    setting = Setting({"body.magnets": 4, "drive.arrangement": row}, environments=BLOCK + 1)
    found = point("magnets", setting, dimensions)
    assert (found.size.dimensions, found.size.magnets, found.size.drive_magnets) == (dimensions, 4, 3)
    solver_steps, of_drives, of_body = 10, 4 * 3, 6 + 2
    assert found.cost.wrenches == 2 * solver_steps * (of_drives + of_body)
    assert found.cost.systems >= 2 * solver_steps and found.cost.broken == 0
    assert 0.0 < found.cost.wall_s < 60.0


@pytest.mark.parametrize("sweep", SWEEPS, ids=lambda sweep: sweep.name)
def test_sweeps_have_the_sizes_that_they_say(sweep) -> None:
    assert list(sweep.sizes) == sorted(set(sweep.sizes))
    for dimensions in PLACES:
        scenes = [sweep.setting(size).scene(dimensions) for size in sweep.sizes]
        assert all(scene.dimensions == dimensions for scene in scenes)


def test_the_ranges_end_where_scenes_are_refused() -> None:
    for setting in BEYOND:
        with pytest.raises(SceneError):
            setting.scene(2)
    assert len(refusals()) == len(BEYOND)


def made(sweep: str, dimensions: int, count: int) -> Point:
    sizes = dict.fromkeys(("environments", "threads", "nodes", "magnets", "drive_magnets"), 1) | {
        sweep: count
    }
    cost = Cost(1e-3 * count**1.25, 2e-3 * count, 10.0 * count, 30.0, 2 if dimensions == 3 else 0)
    return Point(sweep, Size(dimensions, **sizes), cost)


def test_the_page_holds_every_point_and_exponent() -> None:
    points = [made(sweep.name, of, size) for sweep in SWEEPS for of in PLACES for size in sweep.sizes]
    page = text(points, [Memory(2, 11e3, 900.0), Memory(3, None, 2700.0)], Machine(2, ["refused"]), [])
    assert page.count("1.25 ± 0.00") == 2 * 4 and "| plane | 11.0 | 0.9 |" in page
    assert "not told by the system" in page and "environments broke on the way" in page
    assert "- refused" in page
    for sweep in SWEEPS:
        assert f"## {sweep.title.capitalize()}" in page
    assert [panel.get_xlabel() for panel in figure(points).axes] == [
        sweep.title for sweep in SWEEPS if sweep.name != "threads"
    ]


def test_what_surrounds_the_simulator_is_timed_alone() -> None:
    found = around_s(Case("crawl", 5.0))
    assert 0.0 < found < 1.0
