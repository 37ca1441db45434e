"""Instructions of a solver step by what they do: callgrind says how often each runs, objdump what it is.

On AVX2, whose vectors hold four of the eight lanes: an operation of eight lanes is two instructions.
"""

import re
import shutil
import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import astuple, dataclass, fields
from functools import cache

from studies.needs.counts import PROGRAM, compiler, for_all, output, profiled
from studies.peak.program import STEP

CLASSES = {
    "arithmetic": "arithmetic",
    "choice": "comparisons, selections, bits",
    "moves": "vectors loaded and stored",
    "spills": "vectors put aside and fetched again",
    "other": "other vector instructions",
    "scalar": "integers, addresses, branches",
}
"""Classes and what they are called."""

_STACK = re.compile(r"\(%r[sb]p")
_KINDS = {
    "arithmetic": re.compile(r"v?(add|sub|mul|div|sqrt)[ps]d$"),
    "choice": re.compile(
        r"v?(cmp\w*|u?comis|blendv?|max|min|and|or|xor|andn)p?[sd]$|v?p(and|or|xor|andn|cmp\w+|s[rl]l)[bdq]?$"
    ),
}
_MOVE = re.compile(r"v(mov\w+|maskmov\w+|broadcast\w+|pbroadcast\w+)$|movs?[au]?p[sd]$|movsd$")


@dataclass(frozen=True)
class Classes:
    """Instructions of a step by class, see :data:`CLASSES`."""

    arithmetic: float
    choice: float
    moves: float
    spills: float
    other: float
    scalar: float

    @property
    def total(self) -> float:
        """All of them."""
        return float(sum(astuple(self)))

    def share(self, name: str) -> float:
        """Part of all that a class has."""
        return float(getattr(self, name)) / self.total


@dataclass(frozen=True)
class PhaseClasses:
    """Those of a phase, or of the whole step, and the compiler that chose them."""

    place: str
    phase: str
    classes: Classes
    compiler: str


def count_classes(phases: Iterable[tuple[str, str]]) -> list[PhaseClasses]:
    """Counts the instructions of phases, each in the plane or in space."""
    for tool, package in (("valgrind", "valgrind"), ("objdump", "binutils")):
        if shutil.which(tool) is None:
            sys.exit(f"{tool} is missing: install it with the system's packages: apt install {package}")
    disassembly()
    return [PhaseClasses(*key, found, compiler()) for key, found in for_all(classes, phases).items()]


def classes(place_and_phase: tuple[str, str]) -> Classes:
    """Instructions of one phase, or of the whole step."""
    place, phase = place_and_phase
    names = [f"step-{place}"] if phase == STEP else [f"step-{place}", phase]
    units, profile = profiled(names, "--dump-instr=yes", "--compress-strings=no", "--compress-pos=no")
    executed = Counter[str]()
    for program, address, times in costs(profile.splitlines()):
        # The C library's part fills and copies rows.
        known = disassembly().get(address) if program == str(PROGRAM) else ("vmovups", "(%rdi)")
        executed[kind_of(*known) if known else "other"] += times
    return Classes(*(executed[field.name] / units for field in fields(Classes)))


def kind_of(name: str, operands: str) -> str:
    """The class of an instruction, in the words of AT&T's assembler."""
    for kind, pattern in _KINDS.items():
        if pattern.match(name):
            return kind
    if _MOVE.match(name) and "(" in operands:
        return "spills" if _STACK.search(operands) else "moves"
    return "other" if name.startswith("v") or _MOVE.match(name) else "scalar"


def costs(lines: Iterable[str]) -> Iterator[tuple[str, int, int]]:
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
    found = {}
    command = ["objdump", "--disassemble", "--no-show-raw-insn", "--wide", str(PROGRAM)]
    for line in output(command).splitlines():
        match = re.match(r"\s*([0-9a-f]+):\s+(\S+)\s*([^#<]*)", line)
        if match:
            found[int(match[1], 16)] = (match[2], match[3].strip())
    return found
