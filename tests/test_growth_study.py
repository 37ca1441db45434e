"""The study of how cost grows."""

import numpy as np
import pytest

from magworm_gym import SceneError
from studies.growth.fit import exponent
from studies.growth.measure import CONTROL_STEPS, Cost, cost, setting
from studies.growth.memory import Memory
from studies.growth.page import PLACES, beyond, page
from studies.growth.sweeps import BEYOND, SWEEPS

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


@pytest.mark.parametrize("space", [False, True])
def test_wrenches_are_counted_for_every_pair_of_magnets(space: bool) -> None:
    """Two of a body's six pairs lie evenly about its middle and count twice."""
    row = {"kind": "belt", "pitch_m": 0.05, "count": 3}
    found = cost(setting(space, {"body.magnets": 4, "drive.arrangement": row}, environments=BLOCK + 1))
    solver_steps, of_drives, of_body = 10, 4 * 3, 6 + 2
    assert found.wrenches == 2 * solver_steps * (of_drives + of_body)
    assert found.systems >= 2 * solver_steps and found.broken == 0
    assert 0.0 < found.seconds < 60.0 and CONTROL_STEPS > 1


@pytest.mark.parametrize("sweep", SWEEPS, ids=lambda sweep: sweep.name)
def test_sweeps_have_the_sizes_that_they_say(sweep: object) -> None:
    for space in PLACES:
        settings = sweep.settings(space)  # type: ignore[attr-defined]
        sizes = [sweep.size(each) for each in settings]  # type: ignore[attr-defined]
        assert sizes == sorted(set(sizes))
        assert all(each.scene.dimensions == (3 if space else 2) for each in settings)


def test_the_ranges_end_where_scenes_are_refused() -> None:
    for edits in BEYOND:
        with pytest.raises(SceneError):
            setting(False, edits)
    assert len(beyond().splitlines()) == len(BEYOND)


def test_the_page_holds_every_point_and_exponent() -> None:
    def made(space: bool, size: int) -> Cost:
        return Cost(1e-3 * size**1.25, 2e-3 * size, 10.0 * size, 30.0, 2 if space else 0)

    results = {
        (sweep.name, space): [(each, made(space, sweep.size(each))) for each in sweep.settings(space)]
        for sweep in SWEEPS
        for space in PLACES
    }
    text = page(SWEEPS, results, {False: Memory(11e3, 900.0), True: Memory(None, 2700.0)}, [])
    assert text.count("1.25 ± 0.00") == 2 * 4 and "| plane | 11.0 | 0.9 |" in text
    assert "not told by the system" in text and "environments broke on the way" in text
    for sweep in SWEEPS:
        assert f"## {sweep.title.capitalize()}" in text
