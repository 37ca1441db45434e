"""Pages and figures of all studies are those of their committed data."""

import pytest

pytest.importorskip("matplotlib")

from PIL import Image

from studies.__main__ import MODULES
from studies.kit.figures import DOTS_PER_INCH, WIDTH_IN, fingerprint, kept_fingerprint
from studies.kit.study import DOCS, IMAGES, main, named

WIDEST = round(DOTS_PER_INCH * WIDTH_IN)
HEAVIEST = 150_000
STUDIES = {name: named(MODULES, name) for name in MODULES}
each_study = pytest.mark.parametrize("study", STUDIES.values(), ids=STUDIES)


@each_study
def test_the_committed_page_is_that_of_the_committed_data(study):
    for file, text in study.pages().items():
        assert (DOCS / file).read_text(encoding="utf-8") == text


@each_study
def test_the_committed_figures_draw_the_committed_data(study):
    drawn = {file: fingerprint(figure) for file, figure in study.figures().items()}
    assert drawn == {file: kept_fingerprint(IMAGES / file) for file in drawn}


@each_study
def test_every_result_is_as_it_must_be(study):
    assert list(study.complaints()) == []


@each_study
def test_figures_are_small_and_shown(study):
    texts = "".join(study.pages().values())
    for file in study.figures():
        assert f"images/{file})" in texts
        assert (IMAGES / file).stat().st_size <= HEAVIEST
        with Image.open(IMAGES / file) as picture:
            assert picture.width <= WIDEST


def test_rendering_writes_a_page_and_says_so(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("studies.kit.study.DOCS", tmp_path)
    monkeypatch.setattr("studies.kit.study.IMAGES", tmp_path / "images")
    monkeypatch.setattr("studies.kit.study.ROOT", tmp_path)
    assert main(MODULES, ["render", "validation"]) == 0
    written = capsys.readouterr().out.split()
    assert "validation.md" in written
    assert sorted(written) == sorted(str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*.*"))


def test_a_study_that_is_not_there_is_named(capsys):
    with pytest.raises(SystemExit):
        main(MODULES, ["render", "nothing"])
    assert "no study is named nothing; there are" in capsys.readouterr().err
