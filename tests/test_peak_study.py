"""The study of a step against the core's peak."""

import pytest

from studies.peak.account import CHAIN, DIVIDER, FIRST_CACHE, SECOND_CACHE, SUMS, account, useful
from studies.peak.instructions import (
    ARITHMETIC,
    CHOICE,
    CLASSES,
    MOVES,
    OTHER,
    SCALAR,
    SPILLS,
    costs,
    kind_of,
)
from studies.peak.page import PLACES, Place, Results, page
from studies.peak.program import STEP, Counted, Timed, Work
from studies.peak.rates import rates, sets

KINDS = ("add", "multiply", "divide", "root", "compare", "select", "bits", "mask", "load", "store")
KERNELS = {
    # Where nothing waits, and where each round waits for the one before [ns].
    "add": (1.0, 3.0),
    "multiply": (1.0, 4.0),
    "add beside multiply": (1.5, 4.0),
    "load, load, multiply, add": (2.0, 7.0),
    "divide": (8.0, 13.0),
    "add, root": (16.0, 23.0),
    "compare, select": (2.0, 5.0),
    "add, bits": (1.5, 4.0),
    "store, load, add": (4.0, 15.0),
    "load, add, store": (2.0, 4.0),
    "far load, add": (3.0, 6.0),
    "far store": (5.0, 5.0),
}


def made(ns: float) -> Timed:
    return Timed(ns, 0.9 * ns, 1.25 * ns)


def rounds() -> dict[tuple[str, str, int], Timed]:
    found = {("all", "cycle", 1): made(0.25)}
    for name, slower in (("AVX-512", 1.0), ("AVX2", 1.25)):
        for kernel, (best, waiting) in KERNELS.items():
            found[name, kernel, 1] = made(slower * waiting)
            found[name, kernel, 4] = made(slower * best)
        found[name, "fused", 1] = made(slower * 1.0)
    return found


def work(scale: float = 1.0) -> Work:
    operations = dict(zip(KINDS, (60, 40, 5, 2, 3, 3, 1, 1, 90, 20), strict=True))
    counts = {kind: scale * count for kind, count in operations.items()}
    return Work(10.0 * scale, counts, 30.0, dict.fromkeys(KINDS, 2.0))


def results() -> Results:
    block = {"springs": work(), "contact": work(2.0), STEP: work(3.0)}
    alone = {"springs": work(), "contact": work(0.5)}
    timed = {
        (name, lanes, phase): made(250.0 * (3 if phase == STEP else 1) * slower)
        for name, lanes, slower in (
            ("AVX-512", 8, 1.0),
            ("AVX2", 8, 1.5),
            ("AVX-512", 16, 1.5),
            ("one lane", 1, 0.5),
        )
        for phase in block
    }
    classes = {phase: {name: 100.0 for name in CLASSES} for phase in block}
    place = Place(Counted(block, alone, (2.0, 1.5)), timed, classes)
    return Results(rounds(), dict.fromkeys(PLACES, place), 7)


@pytest.mark.parametrize(
    ("instruction", "kind"),
    [
        ("vaddpd (%rax),%zmm0,%zmm1", ARITHMETIC),
        ("vsqrtpd %ymm3,%ymm3", ARITHMETIC),
        ("divsd %xmm1,%xmm0", ARITHMETIC),
        ("vblendvpd %ymm0,%ymm1,%ymm2,%ymm3", CHOICE),
        ("vcmplt_oqpd %ymm0,%ymm1,%ymm2", CHOICE),
        ("vandpd 0x10(%rsp),%ymm1,%ymm2", CHOICE),
        ("vpsrlq $0x34,%ymm0,%ymm0", CHOICE),
        ("vmovupd 0x40(%rsp),%ymm1", SPILLS),
        ("vmovups %ymm1,-0x40(%rbp)", SPILLS),
        ("vmovapd %ymm1,0x40(%rdi,%rcx,1)", MOVES),
        ("vbroadcastsd (%rax),%ymm0", MOVES),
        ("vmovapd %ymm0,%ymm1", OTHER),
        ("vzeroupper ", OTHER),
        ("mov 0x10(%rsp),%rax", SCALAR),
        ("add $0x40,%rax", SCALAR),
        ("cmp %rax,%rcx", SCALAR),
        ("and %rax,%rcx", SCALAR),
        ("shl $0x6,%rcx", SCALAR),
        ("jae 1234", SCALAR),
    ],
)
def test_instructions_are_told_apart(instruction: str, kind: str) -> None:
    name, _, operands = instruction.partition(" ")
    assert kind_of(name, operands) == kind


def test_what_a_callee_took_counts_only_there() -> None:
    profile = """positions: instr line
events: Ir
ob=program
fn=caller
0x10 5 100
calls=3 0x40 7
0x14 6 900
0x18 6 30
ob=library
fn=callee
0x40 7 870""".splitlines()
    found = list(costs(profile))
    assert found == [("program", 0x10, 100), ("program", 0x18, 30), ("library", 0x40, 870)]


def test_rates_are_the_best_number_of_chains_and_a_single_one() -> None:
    assert sets(rounds()) == ["AVX-512", "AVX2"]
    of = rates(rounds(), "AVX-512")
    assert of.peak_gflops == pytest.approx(16.0 / 1.5) and of.fused_gflops == pytest.approx(16.0)
    waits = of.waits_ns()
    assert waits.keys() == set(KINDS)
    assert (waits["root"], waits["bits"], waits["load"], waits["compare"]) == (20.0, 1.0, 12.0, 2.5)


def test_bounds_are_counts_times_rates() -> None:
    of = account(work(), made(200.0), rates(rounds(), "AVX-512"))
    # By hand: 100 sums and products in pairs of 1.5 ns; 5 · 8 + 2 · 16; 90 loads of 1 ns; 10 rows of 3 ns.
    by_hand = {SUMS: 75.0, DIVIDER: 72.0, FIRST_CACHE: 90.0, SECOND_CACHE: 30.0, CHAIN: 30.0}
    assert of.bounds == pytest.approx({name: ns / 200.0 for name, ns in by_hand.items()})
    assert of.tightest == FIRST_CACHE
    assert of.gflops == pytest.approx(8 * 107 / 200.0)
    assert of.share == pytest.approx(
        [of.gflops / (16.0 / 1.5) * factor for factor in (1.0, 1 / 1.25, 1 / 0.9)]
    )


def test_lanes_that_wait_do_what_is_not_wanted() -> None:
    counted = results().places["plane"].counted
    assert useful(counted, "springs") == 1.0 and useful(counted, "contact") == 0.25
    assert useful(counted, STEP) == 0.5


def test_the_page_holds_every_phase_and_says_whether_the_aim_is_reached() -> None:
    text = page(results())
    # 8 · 321 operations in 750 ns, of 10.67 a nanosecond.
    assert "3.4 Gflop/s, 32.1% (25.7% to 35.7%) of the peak" in text and "reached in both" in text
    assert text.count("| springs |") == 3 * len(PLACES)
    assert "a second block" in text.lower() and "50%" in text
    assert "nan" not in text and "inf" not in text.replace("information", "")
