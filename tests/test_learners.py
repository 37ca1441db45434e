"""The comparison of learning algorithms."""

import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("stable_baselines3")

SCRIPT = Path(__file__).parent.parent / "studies" / "learners.py"


def test_a_page_says_how_far_each_algorithm_turned(tmp_path: Path) -> None:
    page = tmp_path / "learners.md"
    flags = ["--seconds", "1", "--algorithms", "PPO", "--out", str(page)]
    subprocess.run([sys.executable, str(SCRIPT), *flags], check=True, timeout=300)
    rows = [line.split("|") for line in page.read_text(encoding="utf-8").splitlines() if "| PPO |" in line]
    assert len(rows) == 1
    assert int(rows[0][4]) > 0
    assert -90.0 < float(rows[0][6]) < 90.0
