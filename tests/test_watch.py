"""``magworm watch``: films and windows of policies at work, and what it refuses."""

from pathlib import Path

import pytest

from magworm_gym.cli import main

Image = pytest.importorskip("PIL.Image")


def run(*words: str) -> int:
    """Exit status of the command."""
    with pytest.raises(SystemExit) as exit_status:
        main(["watch", *words])
    assert isinstance(exit_status.value.code, int)
    return exit_status.value.code


@pytest.mark.parametrize("policy", ["crawl-3", "turn"])
def test_a_film_has_a_frame_for_each_control_step(policy: str, tmp_path: Path) -> None:
    out = tmp_path / "film.gif"
    assert run(policy, "--out", str(out), "--seconds", "0.4", "--seed", "3") == 0
    with Image.open(out) as film:
        assert film.n_frames == 20
        first = film.convert("RGB").tobytes()
        film.seek(19)
        assert film.convert("RGB").tobytes() != first


def test_without_a_film_there_is_a_window(windowless: None, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("--seconds", "0.1") == 0
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--seconds", "0"], "--seconds is 0; allowed: more than 0, at most 3600"),
        (["--seconds", "nan"], "--seconds is nan; allowed: more than 0, at most 3600"),
        (["--seed", "-1"], "--seed is -1; allowed: 0 to 2^63 - 1"),
        (["--out", "film.avi"], "--out is 'film.avi'; allowed: a .gif or .mp4 file in a folder that exists"),
        (["--out", "nowhere/film.gif"], "--out is 'nowhere/film.gif'; allowed: a .gif or .mp4 file"),
        (["crawl-9"], "policy is 'crawl-9'; allowed: crawl-3, crawl-4, crawl-5"),
    ],
)
def test_mistakes_are_told_in_a_sentence(
    words: list[str], told: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert run("--out", str(tmp_path / "film.gif"), *words) == 2
    assert told in capsys.readouterr().err
    assert not list(tmp_path.iterdir())
