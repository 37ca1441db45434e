"""The study of a step against the core's peak."""

import pytest

from studies.peak.account import CHAIN, DIVIDER, FIRST_CACHE, SECOND_CACHE, SUMS, Account
from studies.peak.instructions import Classes, PhaseClasses, costs, kind_of
from studies.peak.program import STEP, Chain, CoreTime, Operations, StepTime, Systems, Timed, Work
from studies.peak.rates import all_rates
from studies.peak.study import PLACES, Results, text, wanted_shares

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


def core() -> list[CoreTime]:
    found = [CoreTime("all", "cycle", 1, made(0.25))]
    for name, slower in (("AVX-512", 1.0), ("AVX2", 1.25)):
        for kernel, (best, waiting) in KERNELS.items():
            found.append(CoreTime(name, kernel, 1, made(slower * waiting)))
            found.append(CoreTime(name, kernel, 4, made(slower * best)))
        found.append(CoreTime(name, "fused", 1, made(slower * 1.0)))
    return found


def operations(scale: float = 1.0) -> Operations:
    return Operations(*(scale * count for count in (60, 40, 5, 2, 3, 3, 1, 1, 90, 20)))


def work(place: str, lanes: int, phase: str, scale: float = 1.0) -> Work:
    return Work(place, lanes, phase, 10.0 * scale, operations(scale))


def works(place: str) -> list[Work]:
    block = [work(place, 8, phase, scale) for phase, scale in (("springs", 1), ("contact", 2), (STEP, 3))]
    return [*block, work(place, 1, "springs"), work(place, 1, "contact", 0.5)]


def results() -> Results:
    phases = ("springs", "contact", STEP)
    kinds = (("AVX-512", 8, 1.0), ("AVX2", 8, 1.5), ("AVX-512", 16, 1.5), ("one lane", 1, 0.5))
    return Results(
        core(),
        [
            StepTime(place, name, lanes, phase, made(250.0 * (3 if phase == STEP else 1) * slower))
            for place in PLACES
            for name, lanes, slower in kinds
            for phase in phases
        ],
        [work for place in PLACES for work in works(place)],
        [Chain(place, phase, 30.0, Operations(*[2.0] * 10)) for place in PLACES for phase in phases],
        [Systems(place, lanes, 1.0 + lanes / 8) for place in PLACES for lanes in (8, 1)],
        [
            PhaseClasses(place, phase, Classes(*[100.0] * 6), "a compiler")
            for place in PLACES
            for phase in phases
        ],
    )


@pytest.mark.parametrize(
    ("instruction", "kind"),
    [
        ("vaddpd (%rax),%zmm0,%zmm1", "arithmetic"),
        ("vsqrtpd %ymm3,%ymm3", "arithmetic"),
        ("divsd %xmm1,%xmm0", "arithmetic"),
        ("vblendvpd %ymm0,%ymm1,%ymm2,%ymm3", "choice"),
        ("vcmplt_oqpd %ymm0,%ymm1,%ymm2", "choice"),
        ("vandpd 0x10(%rsp),%ymm1,%ymm2", "choice"),
        ("vpsrlq $0x34,%ymm0,%ymm0", "choice"),
        ("vmovupd 0x40(%rsp),%ymm1", "spills"),
        ("vmovups %ymm1,-0x40(%rbp)", "spills"),
        ("vmovapd %ymm1,0x40(%rdi,%rcx,1)", "moves"),
        ("vbroadcastsd (%rax),%ymm0", "moves"),
        ("vmovapd %ymm0,%ymm1", "other"),
        ("vzeroupper ", "other"),
        ("movapd %xmm0,%xmm1", "other"),
        ("mov 0x10(%rsp),%rax", "scalar"),
        ("add $0x40,%rax", "scalar"),
        ("cmp %rax,%rcx", "scalar"),
        ("and %rax,%rcx", "scalar"),
        ("shl $0x6,%rcx", "scalar"),
        ("jae 1234", "scalar"),
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
    rates = all_rates(core())
    assert [*rates] == ["AVX-512", "AVX2"]
    of = rates["AVX-512"]
    assert of.peak_gflops == pytest.approx(16.0 / 1.5) and of.fused_gflops == pytest.approx(16.0)
    waits = of.waits_ns()
    assert (waits.root, waits.bits, waits.load, waits.compare) == (20.0, 1.0, 12.0, 2.5)


def test_bounds_are_counts_times_rates() -> None:
    rates = all_rates(core())["AVX-512"]
    chain = Chain("plane", "springs", 30.0, operations())
    of = Account(work("plane", 8, "springs"), chain, made(200.0), rates, 1.0, Classes(*[107.0] * 6), 2.0)
    # By hand: 100 sums and products in pairs of 1.5 ns; 5 · 8 + 2 · 16; 90 loads of 1 ns; 10 rows of 3 ns.
    by_hand = {SUMS: 75.0, DIVIDER: 72.0, FIRST_CACHE: 90.0, SECOND_CACHE: 30.0, CHAIN: 30.0}
    assert of.bounds == pytest.approx({name: ns / 200.0 for name, ns in by_hand.items()})
    assert of.tightest == FIRST_CACHE
    assert of.gflops == pytest.approx(8 * 107 / 200.0)
    assert of.shares == pytest.approx(
        [of.gflops / (16.0 / 1.5) * factor for factor in (1.0, 1 / 1.25, 1 / 0.9)]
    )
    assert of.executed == 0.5


def test_lanes_that_wait_do_what_is_not_wanted() -> None:
    assert wanted_shares(works("plane")) == {"springs": 1.0, "contact": 0.25, STEP: 0.5}


def test_the_page_holds_every_phase_and_says_whether_the_aim_is_reached() -> None:
    page = text(results())
    # 8 · 321 operations in 750 ns, of 10.67 a nanosecond.
    assert "3.4 Gflop/s, 32.1 % (25.7 to 35.7 %) of the peak" in page and "reached in both" in page
    assert page.count("| springs |") == 3 * len(PLACES)
    assert "it costs 50 % of the first in the plane" in page
    assert "nan" not in page and "inf" not in page.replace("information", "")
