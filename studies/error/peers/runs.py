"""What each peer that is installed gives on its case, and a sentence for each that is not."""

import importlib
import importlib.metadata
from dataclasses import dataclass

import numpy as np

from studies.error.magnets import REFERENCE, magnets
from studies.error.peers.cantilever import MM, TIP_MM, tip_only
from studies.error.peers.measure import Measured, Series, Track, apart


@dataclass(frozen=True)
class Package:
    """A package on PyPI.

    Attributes:
        distribution: Its name there.
        major: Its major version whose interface is used.
    """

    distribution: str
    major: int


@dataclass(frozen=True)
class Peer:
    """Another simulator.

    Attributes:
        name: What it is called.
        packages: What it needs.
        module: Ours that runs it; may be imported only where they are installed.
        case: What it runs: "cantilever" or "magnets".
    """

    name: str
    packages: tuple[Package, ...]
    module: str
    case: str


ELASTICA, MUJOCO, MAGPYLIB = Package("pyelastica", 1), Package("mujoco", 3), Package("magpylib", 6)
"""MuJoCo 4 comes without the plugin of the cable; magpylib 5 cuts magnets by another interface,
and 6 needs Python 3.11."""

PEERS = (
    Peer("PyElastica", (ELASTICA,), "studies.error.peers.elastica_rod", "cantilever"),
    Peer("MuJoCo cable", (MUJOCO,), "studies.error.peers.mujoco_cable", "cantilever"),
    Peer("PyElastica with magpylib", (ELASTICA, MAGPYLIB), "studies.error.peers.elastica_magnets", "magnets"),
)


@dataclass(frozen=True)
class Missing:
    """A peer that is not run, and why, in one sentence."""

    name: str
    sentence: str


@dataclass(frozen=True)
class PeerRun:
    """A peer's second.

    Attributes:
        case: What was run.
        name: Peer and scheme.
        version: Of its packages.
        elements: Along the rod, with the one half of which is inside the wall.
        step_s: Step [s].
        tip_mm: Place of the tip, or of its magnet, after the second, along and up [mm].
        error: Distance to the reference, over the length: of the tip, or root mean square of all magnets
            over all time. Of mesh, step and model: where the peer's rod shears, thins or cannot stretch,
            finer runs do not end at the reference.
        own_error: Distance to what the same peer gives on a mesh finer than any here, over the
            length: of mesh and step alone.
        wall_s: Wall time on one thread, median of three after a warm-up [s].
    """

    case: str
    name: str
    version: str
    elements: int
    step_s: float
    tip_mm: tuple[float, float]
    error: float
    own_error: float
    wall_s: float


def why_missing(peer: Peer) -> Missing | None:
    """None where a peer can run."""
    for package in peer.packages:
        try:
            version = importlib.metadata.version(package.distribution)
        except importlib.metadata.PackageNotFoundError:
            state = "is not installed"
        else:
            if version.split(".")[0] == str(package.major):
                continue
            state = f"{version} is installed, not {package.major}"
        return Missing(
            peer.name,
            f"{peer.name} is left out: {package.distribution} {state} (pip install '.[rivals]' installs it).",
        )
    return None


def missing() -> list[Missing]:
    """The peers that are left out."""
    return [found for peer in PEERS if (found := why_missing(peer)) is not None]


def all_runs() -> list[PeerRun]:
    """All runs of all peers that are installed, minutes."""
    return [run for peer in PEERS if why_missing(peer) is None for run in runs_of(peer)]


def reference_mm(case: str) -> Track:
    """What the runs of a case are compared with [mm]."""
    if case == "cantilever":
        return tip_only(*TIP_MM)
    tracks = magnets().run(REFERENCE).tracks
    assert tracks is not None
    return np.asarray(MM * tracks[0])


def runs_of(peer: Peer) -> list[PeerRun]:
    """All runs of a peer that is installed."""
    version = ", ".join(importlib.metadata.version(package.distribution) for package in peer.packages)
    module = importlib.import_module(peer.module)
    true_mm = reference_mm(peer.case)
    found: list[Series] = module.series()
    return [peer_run(peer, version, one, run, true_mm) for one in found for run in one.runs]


def peer_run(peer: Peer, version: str, series: Series, run: Measured, true_mm: Track) -> PeerRun:
    """What was measured, with its errors."""
    x_mm, y_mm = run.track_mm[-1, -1]
    return PeerRun(
        peer.case,
        f"{peer.name}, {series.scheme}",
        version,
        run.elements,
        run.step_s,
        (float(x_mm), float(y_mm)),
        error=apart(run.track_mm, true_mm),
        own_error=apart(run.track_mm, series.finest_mm),
        wall_s=run.wall_s,
    )
