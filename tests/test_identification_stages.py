"""What stages wrote down: read as spreadsheets save it, resampled with a bound, averaged."""

import numpy as np
import pytest
from tracks import entries, saved

from magworm_gym.identification import (
    ProblemError,
    make_problem,
)
from magworm_gym.identification.drive_motion import MOST_WAYPOINTS, drive_from_stage, read_stage, thinned


@pytest.mark.parametrize("form", ["semicolons", "more columns", "empty"])
def test_stages_are_read_as_spreadsheets_save_them(tmp_path, form):
    rows = [["time_s", "x_m", "y_m"], ["0.0", "-0.05", "-0.022"], ["0.5", "0.0", "-0.022"]]
    separator = ","
    if form == "semicolons":
        rows, separator = [[cell.replace(".", ",") for cell in row] for row in rows], ";"
    elif form == "more columns":
        rows = [["", "force_n", "y_m", "time_s", "x_m"]] + [["", "1.0", y, t, x] for t, x, y in rows[1:]]
    else:
        rows = [[*row, "", ""] for row in [*rows, [""] * 3]]
    log = read_stage(saved(tmp_path / "stage.csv", rows, separator))
    assert log.time_s.tolist() == [0.0, 0.5] and log.points_m.tolist() == [[-0.05, -0.022], [0.0, -0.022]]


def test_a_stage_of_any_rate_is_resampled_with_a_bound_that_is_said(tmp_path):
    time_s = np.arange(120_001) * 1e-5
    x_m = -0.05 + 0.1 * time_s + 2e-5 * np.sin(2.0 * np.pi * 300.0 * time_s)
    rows = [
        ["time_s", "x_m", "y_m"],
        *([f"{t:.5f}", f"{x:.9f}", "-0.022"] for t, x in zip(time_s, x_m, strict=True)),
    ]
    saved(tmp_path / "stage.csv", rows)
    target = {"quantity": "stride_m", "value": 4e-3, "tolerance": 1e-3}
    experiment = {"name": "pass", "duration_s": 1.2, "targets": [target], "drive": {"file": "stage.csv"}}
    problem = make_problem({**entries(), "experiment": [experiment]}, tmp_path)
    (remark,) = problem.remarks
    said_m = float(remark.split("more than ")[1].split()[0])
    motion = problem.experiments[0].scene.to_toml().split("[drive.motion]")[1]
    kept = [[float(each) for each in motion.split(f"{name} = [")[1].split("]")[0].split(",") if each.strip()]
            for name in ("time_s", "x_m")]  # fmt: skip
    assert len(kept[0]) == MOST_WAYPOINTS
    assert np.abs(np.interp(time_s, *kept) - x_m).max() <= said_m + 2e-9 < 1e-5


def test_rows_of_a_stage_that_share_their_time_are_averaged(tmp_path):
    rows = [
        ["time_s", "x_m", "y_m"],
        *([t, x, "-0.022"] for t, x in (("0", "0"), ("0.1", "0"), ("0.1", "2e-6"), ("0.2", "1e-5"))),
    ]
    log = read_stage(saved(tmp_path / "stage.csv", rows))
    assert log.time_s.tolist() == [0.0, 0.1, 0.2]
    assert log.points_m[:, 0] == pytest.approx([0.0, 1e-6, 1e-5]) and log.spread_m == pytest.approx(1e-6)
    _, (remark,) = drive_from_stage(log, 0.0, 0.2)
    assert "3 waypoints for its 4 rows miss none by more than 1e-06 m" in remark
    _, (remark, _) = drive_from_stage(log, 0.0, 1e-3)
    assert "are 0 to 0.2 s, and the experiment lasts 0.001 s: are they in s?" in remark
    with pytest.raises(ProblemError, match=r"line 4, time_s is 0.1; allowed: rising"):
        read_stage(saved(tmp_path / "stage.csv", [*rows[:2], ["0.2", "0", "0"], ["0.1", "0", "0"]]))


def test_thinned_points_miss_none_by_more_than_they_say():
    time_s = np.sort(np.random.default_rng(0).random(400))
    points_m = np.stack([np.sin(9.0 * time_s), time_s], axis=1)
    kept, error_m = thinned(time_s, points_m, 40)
    away = [np.interp(time_s, time_s[kept], points_m[kept, axis]) - points_m[:, axis] for axis in (0, 1)]
    assert len(kept) == 40 and np.abs(away).max() == pytest.approx(error_m, rel=1e-9)
    assert thinned(time_s, points_m * 0.0, 40) == ([0, 399], 0.0)
