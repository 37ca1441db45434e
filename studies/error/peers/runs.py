"""What each peer that is installed gives on its case, and a sentence for each that is not."""

import importlib.metadata
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from studies.error.cases import MAGNETS
from studies.error.peers.cantilever import TIP_MM, tip_only
from studies.error.peers.measure import Measured, Series, Track, apart
from studies.kit.passes import MM

ELASTICA, MUJOCO, MAGPYLIB = ("pyelastica", 1), ("mujoco", 3), ("magpylib", 6)
"""Packages on PyPI and the major versions whose interfaces are used. MuJoCo 4 comes without the plugin of the
cable; magpylib 5 cuts magnets by another interface, and 6 needs Python 3.11."""


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
    packages: Mapping[str, int]
    module: str
    case: str


PEERS = (
    Peer("PyElastica", dict([ELASTICA]), "elastica_rod", "cantilever"),
    Peer("MuJoCo cable", dict([MUJOCO]), "mujoco_cable", "cantilever"),
    Peer("PyElastica with magpylib", dict([ELASTICA, MAGPYLIB]), "elastica_magnets", "magnets"),
)


@dataclass(frozen=True)
class PeerRun:
    """A peer's second.

    Attributes:
        case: What was run.
        peer: Which.
        scheme: How it stepped.
        version: Of its packages.
        elements: Along the rod, with the one half of which is inside the wall.
        step_s: Step [s].
        tip_x_mm, tip_y_mm: Place of the tip, or of its magnet, after the second, along and up [mm].
        error: Distance to the reference, over the length: of the tip, or root mean square of all magnets
            over all time. Of mesh, step and model: where the peer's rod shears, thins or cannot stretch,
            finer runs do not end at the reference.
        own_error: Distance to what the same peer gives on a mesh finer than any here, over the
            length: of mesh and step alone.
        wall_s: Wall time on one thread, median of three after a warm-up [s].
    """

    case: str
    peer: str
    scheme: str
    version: str
    elements: int
    step_s: float
    tip_x_mm: float
    tip_y_mm: float
    error: float
    own_error: float
    wall_s: float


def why_missing(peer: Peer) -> str | None:
    """One sentence where a peer cannot run, else none."""
    for package, major in peer.packages.items():
        try:
            version = importlib.metadata.version(package)
        except importlib.metadata.PackageNotFoundError:
            state = "is not installed"
        else:
            if version.split(".")[0] == str(major):
                continue
            state = f"{version} is installed, not {major}"
        return f"{peer.name} is left out: {package} {state} (pip install '.[rivals]' installs it)."
    return None


def reference_mm(case: str) -> Track:
    """What the runs of a case are compared with [mm]."""
    if case == "cantilever":
        return tip_only(*TIP_MM)
    tracks = MAGNETS.run(MAGNETS.reference).tracks
    assert tracks is not None
    return np.asarray(MM * tracks[0])


def runs_of(peer: Peer) -> list[PeerRun]:
    """All runs of a peer that is installed, minutes."""
    version = ", ".join(map(importlib.metadata.version, peer.packages))
    found: list[Series] = importlib.import_module(f"studies.error.peers.{peer.module}").series()
    true_mm = reference_mm(peer.case)
    return [peer_run(peer, version, one, run, true_mm) for one in found for run in one.runs]


def peer_run(peer: Peer, version: str, series: Series, run: Measured, true_mm: Track) -> PeerRun:
    """What was measured, with its errors."""
    x_mm, y_mm = map(float, run.track_mm[-1, -1])
    return PeerRun(
        *(peer.case, peer.name, series.scheme, version, run.elements, run.step_s, x_mm, y_mm),
        error=apart(run.track_mm, true_mm),
        own_error=apart(run.track_mm, series.finest_mm),
        wall_s=run.wall_s,
    )
