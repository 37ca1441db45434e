"""Reports as data, and the pages that are filled from them."""

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import pytest

pytest.importorskip("msgspec")

from magworm_gym.learning.results import Column, Interval, Report, Table, read_report

DOCS = Path(__file__).parent.parent / "docs"
TABLE = Table(
    [Column("drive", "drive"), Column("speed_m_s", "speed [mm/s]", ".1f", 1000.0)],
    [{"drive": "belt", "speed_m_s": Interval(0.006, 0.005, 0.0071, 4)}, {"drive": "none", "speed_m_s": 0.0}],
)
MARKDOWN = "| drive | speed [mm/s] |\n| --- | --- |\n| belt | 6.0 [5.0, 7.1] |\n| none | 0.0 |"
PAGE = """A <!-- =speed -->0<!-- /=speed --> b
<!-- crawl.table -->

<!-- /crawl.table -->
<!-- words -->
x
<!-- /words -->
"""


@pytest.fixture
def program(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.syspath_prepend(str(DOCS))
    specification = importlib.util.spec_from_file_location("docs_results", DOCS / "results.py")
    assert specification is not None and specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    monkeypatch.setitem(sys.modules, "docs_results", module)
    specification.loader.exec_module(module)
    return module


@pytest.fixture
def docs(tmp_path: Path) -> Path:
    folder = tmp_path / "docs"
    (folder / "results").mkdir(parents=True)
    Report("Crawling", {"words": "Words.", "table": TABLE}, {"speed": 2.5}).write(
        folder / "results" / "crawl.json"
    )
    (folder / "results" / "numbers.toml").write_text(
        '[speed]\nreport = "crawl"\nat = ["data", "speed"]\nform = ".2f"\n'
    )
    (tmp_path / "README.md").write_text(PAGE)
    return folder


def test_a_report_is_read_as_it_was_written(docs: Path) -> None:
    report = read_report(docs / "results" / "crawl.json")
    assert report == Report("Crawling", {"words": "Words.", "table": TABLE}, {"speed": 2.5})
    assert report.markdown("![x](x.png)") == f"# Crawling\n\nWords.\n\n{MARKDOWN}\n\n![x](x.png)\n"
    (docs / "results" / "crawl.json").write_text('{"title": 3}')
    with pytest.raises(ValueError, match=r"crawl\.json holds no report"):
        read_report(docs / "results" / "crawl.json")


def test_pages_are_filled_and_checked(docs: Path, program: ModuleType) -> None:
    assert program.main(["--check"], docs) == 1
    assert program.main([], docs) == 0
    assert program.main(["--check"], docs) == 0
    page = docs.parent / "README.md"
    filled = PAGE.replace(">0<", ">2.50<").replace("\n\n<!-- /c", f"\n{MARKDOWN}\n<!-- /c")
    assert page.read_text() == filled
    for stale in (filled.replace("2.50", "2.51"), filled.replace("6.0 [", "6.1 [")):
        page.write_text(stale)
        assert program.main(["--check"], docs) == 1
        assert page.read_text() == stale
    page.write_text(filled)
    (docs / "results" / "crawl.md").write_text("# Other\n")
    assert program.main(["--check"], docs) == 1


@pytest.mark.parametrize("name", ["=wings", "crawl.wings", "fly.table"])
def test_a_block_of_nothing_is_named(
    name: str, docs: Path, program: ModuleType, capsys: pytest.CaptureFixture[str]
) -> None:
    (docs.parent / "README.md").write_text(f"<!-- {name} -->1<!-- /{name} -->")
    assert program.main([], docs) == 1
    assert f"<!-- {name} --> is in no report" in capsys.readouterr().err


def test_pages_of_this_project_are_up_to_date(program: ModuleType) -> None:
    assert program.main(["--check"]) == 0


def test_tables_of_spaces_stand_on_their_page(docs: Path, program: ModuleType) -> None:
    page = (DOCS / "environments.md").read_text(encoding="utf-8")
    assert page.count("<!-- spaces -->") == page.count("<!-- /spaces -->") == 1
    (docs / "environments.md").write_text("<!-- spaces -->\nx\n<!-- /spaces -->\n", encoding="utf-8")
    assert program.main([], docs) == 0
    tables = (docs / "environments.md").read_text(encoding="utf-8")
    assert "| `last_action` |" in tables and tables.strip() in page
