"""Instructions of a solver step by what they do: callgrind says how often each runs, objdump what it is.

On AVX2, whose vectors hold four of the eight lanes: an operation of eight lanes is two instructions.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

from studies.needs.counts import PROGRAM, THREADS, environment

ARITHMETIC = "arithmetic"
CHOICE = "comparisons, selections, bits"
MOVES = "vectors loaded and stored"
SPILLS = "vectors put aside and fetched again"
OTHER = "other vector instructions"
SCALAR = "integers, addresses, branches"
CLASSES = (ARITHMETIC, CHOICE, MOVES, SPILLS, OTHER, SCALAR)

_STACK = re.compile(r"\(%r[sb]p")
_KINDS = (
    (ARITHMETIC, re.compile(r"v?(add|sub|mul|div|sqrt)[ps]d$")),
    (
        CHOICE,
        re.compile(
            r"v?(cmp\w*|u?comis|blendv?|max|min|and|or|xor|andn)p?[sd]$|v?p(and|or|xor|andn|cmp\w+|s[rl]l)[bdq]?$"
        ),
    ),
)
_MOVE = re.compile(r"v(mov\w+|maskmov\w+|broadcast\w+|pbroadcast\w+)$|movs?[au]?p[sd]$|movsd$")


def kind_of(name: str, operands: str) -> str:
    """The class of an instruction, in the words of AT&T's assembler."""
    for kind, pattern in _KINDS:
        if pattern.match(name):
            return kind
    if _MOVE.match(name):
        if "(" not in operands:
            return OTHER
        return SPILLS if _STACK.search(operands) else MOVES
    return OTHER if name.startswith("v") else SCALAR


def classes(task: str, phase: str | None = None) -> dict[str, float]:
    """Instructions of a solver step, or of one phase of it, by class."""
    names = [task] if phase is None else [task, phase]
    with tempfile.TemporaryDirectory() as folder:
        profile = Path(folder) / "profile"
        options = ["--toggle-collect=*counted*", "--dump-instr=yes", "--compress-strings=no"]
        command = ["valgrind", "--tool=callgrind", *options, "--compress-pos=no"]
        command += [f"--callgrind-out-file={profile}", str(PROGRAM), *names]
        run = subprocess.run(command, capture_output=True, text=True, env=environment())
        if run.returncode:
            sys.exit(run.stderr.strip().splitlines()[-1])
        executed = Counter[str]()
        for program, address, times in costs(profile.read_text(encoding="utf-8").splitlines()):
            # The C library's part fills and copies rows.
            known = disassembly().get(address) if program == str(PROGRAM) else ("vmovups", "(%rdi)")
            executed[kind_of(*known) if known else OTHER] += times
        units = int(run.stdout)
    return {kind: executed[kind] / units for kind in CLASSES}


def all_classes(pairs: list[tuple[str, str | None]]) -> dict[tuple[str, str | None], dict[str, float]]:
    """The same for tasks and phases."""
    for tool, package in (("valgrind", "valgrind"), ("objdump", "binutils")):
        if shutil.which(tool) is None:
            sys.exit(f"{tool} is missing: install it with the system's packages: apt install {package}")
    disassembly()
    with ThreadPoolExecutor(THREADS) as pool:
        return dict(zip(pairs, pool.map(lambda pair: classes(*pair), pairs), strict=True))


def costs(lines: list[str]) -> Iterator[tuple[str, int, int]]:
    """Object file, address and number of executions of each instruction in a profile of callgrind."""
    program, of_call = "", False
    for line in lines:
        if line.startswith("ob="):
            program = line[3:]
        elif line.startswith("calls="):
            of_call = True
        elif line.startswith("0x"):
            address, _, times = line.split()[:3]
            # What follows a call is what the callee took.
            if not of_call:
                yield program, int(address, 16), int(times)
            of_call = False


@cache
def disassembly() -> Mapping[int, tuple[str, str]]:
    """Name and operands of the instruction at each address of the program."""
    command = ["objdump", "--disassemble", "--no-show-raw-insn", "--wide", str(PROGRAM)]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    found = {}
    for line in run.stdout.splitlines():
        match = re.match(r"\s*([0-9a-f]+):\s+(\S+)\s*([^#<]*)", line)
        if match:
            found[int(match[1], 16)] = (match[2], match[3].strip())
    return found
