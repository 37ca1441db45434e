"""Instructions of small fixed tasks, counted by callgrind: equal on every run and every processor with AVX2.

python -m studies.needs.counts            # beside the committed ones; fails beyond 5 %
python -m studies.needs.counts --write    # commits what was counted

The tasks are those of ``rust/magworm-py/examples/count``. Needs nothing but Python and valgrind. The harness
gungraun would not shorten it: it holds a benchmark as a whole against an earlier run or a limit, where here
are units of work, phases of a step and classes of instructions, and its runner would have to be installed.
"""

import argparse
import csv
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TypeVar

T = TypeVar("T")
R = TypeVar("R")

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "target" / "release" / "examples" / "count"
COMMITTED = Path(__file__).parent / "data" / "instructions.csv"
TOLERANCE = 0.05
TUNABLES = ":".join(f"glibc.cpu.x86_rep_{kind}_threshold=0x7fffffff" for kind in ("stosb", "movsb"))
"""A repeated store of the C library is one instruction, but callgrind counts each byte of it."""


def tasks() -> list[str]:
    """Names of all tasks."""
    if not PROGRAM.exists():
        sys.exit(f"{PROGRAM.relative_to(ROOT)} is missing: run make count, which builds it")
    return output([str(PROGRAM)]).split()


def phases(task: str) -> list[str]:
    """Names of the phases of a task's solver step."""
    return output([str(PROGRAM), task, "phases"]).splitlines()


def count(names: Sequence[str]) -> float:
    """Instructions per unit of a task: a step, a wrench of eight lanes, a control step; or of one phase."""
    units, profile = profiled(names)
    found = re.search(r"^(?:totals|summary): (\d+)", profile, re.MULTILINE)
    if not found or int(found[1]) == 0:
        sys.exit(f"callgrind collected nothing in {' '.join(names)}: the function counted was inlined")
    return int(found[1]) / units


def profiled(names: Sequence[str], *options: str) -> tuple[int, str]:
    """Units of work that a task, or one phase of it, has done, and callgrind's profile of them."""
    with tempfile.TemporaryDirectory() as folder:
        profile = Path(folder) / "profile"
        command = ["valgrind", "--tool=callgrind", "--toggle-collect=*counted*", *options]
        units = output([*command, f"--callgrind-out-file={profile}", str(PROGRAM), *names])
        return int(units), profile.read_text(encoding="utf-8")


def for_all(work: Callable[[T], R], items: Iterable[T]) -> dict[T, R]:
    """Does the same for all, on all cores."""
    chosen = list(items)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return dict(zip(chosen, pool.map(work, chosen), strict=True))


def count_all() -> dict[str, float]:
    """Instructions per unit of all tasks."""
    if shutil.which("valgrind") is None:
        sys.exit("valgrind is missing: install it with the system's packages: apt install valgrind")
    return for_all(lambda task: count([task]), tasks())


def committed() -> dict[str, float]:
    """The committed counts."""
    with COMMITTED.open(encoding="utf-8", newline="") as file:
        return {row["task"]: float(row["instructions"]) for row in csv.DictReader(file)}


def compiler() -> str:
    """The compiler that counts depend on."""
    return output(["rustc", "--version"]).strip()


def compare(counted: Mapping[str, float], expected: Mapping[str, float]) -> tuple[str, list[str]]:
    """A table of counts beside the expected ones, and the tasks that differ by more than the tolerance."""
    lines, wrong = [f"{'task':<32}{'instructions':>14}{'committed':>14}{'change':>10}"], []
    for task in [*counted, *(task for task in expected if task not in counted)]:
        here, there = counted.get(task), expected.get(task)
        change = here / there - 1 if here and there else None
        if change is None or abs(change) > TOLERANCE:
            wrong.append(task)
        cells = ["–" if value is None else f"{value:,.0f}" for value in (here, there)]
        lines.append(
            f"{task:<32}{cells[0]:>14}{cells[1]:>14}{'–' if change is None else f'{change:+.2%}':>10}"
        )
    return "\n".join(lines), wrong


def write(counted: Mapping[str, float]) -> None:
    """Commits counts."""
    with COMMITTED.open("w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["task", "instructions", "compiler"])
        rows.writerows([task, f"{value:.1f}", compiler()] for task, value in counted.items())


def output(command: Sequence[str]) -> str:
    """What a program prints; ends with its last words where it fails."""
    environment = {**os.environ, "GLIBC_TUNABLES": TUNABLES}
    run = subprocess.run(command, capture_output=True, text=True, env=environment)
    if run.returncode:
        sys.exit(run.stderr.strip().splitlines()[-1] if run.stderr.strip() else f"{command[0]} failed")
    return run.stdout


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--write", action="store_true", help="commit what was counted")
    arguments = parser.parse_args()
    counted = count_all()
    table, wrong = compare(counted, committed() if COMMITTED.exists() else {})
    print(table)
    if arguments.write:
        write(counted)
    elif wrong:
        sys.exit(
            f"more than {TOLERANCE:.0%} from the committed counts: {', '.join(wrong)}; the compiler is"
            f" {compiler()}. Where that is meant, run make count-write and say why in the commit"
        )


if __name__ == "__main__":
    main()
