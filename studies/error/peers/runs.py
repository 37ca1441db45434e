"""What each peer that is installed gives on the cantilever, and a sentence for each that is not."""

import importlib
import importlib.metadata
from dataclasses import dataclass

from studies.error.peers.cantilever import TIP_MM, apart
from studies.error.peers.measure import Measured, Tip


@dataclass(frozen=True)
class Peer:
    """Another simulator.

    Attributes:
        name: What it is called.
        distribution: Its package on PyPI.
        major: Its major version whose interface is used.
        module: Ours that runs it; may be imported only where the peer is installed.
    """

    name: str
    distribution: str
    major: int
    module: str


PEERS = (
    Peer("PyElastica", "pyelastica", 1, "studies.error.peers.elastica_rod"),
    Peer("MuJoCo cable", "mujoco", 3, "studies.error.peers.mujoco_cable"),
)
"""MuJoCo 4 comes without the plugin of the cable."""


@dataclass(frozen=True)
class Missing:
    """A peer that is not run, and why, in one sentence."""

    name: str
    sentence: str


@dataclass(frozen=True)
class PeerRun:
    """A peer's cantilever after a second.

    Attributes:
        name: Peer and scheme.
        version: Of the peer.
        elements: Along the rod, with the one half of which is inside the wall.
        step_s: Step [s].
        tip_mm: Place of the tip, along and up [mm].
        error: Distance to the reference's tip, over the length. Of mesh, step and model: where the peer's
            rod shears, thins or cannot stretch, finer runs do not end at the reference.
        own_error: Distance to the tip of the same peer on a mesh finer than any here, over the
            length: of mesh and step alone.
        wall_s: Wall time on one thread, median of three after a warm-up [s].
    """

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
    try:
        version = importlib.metadata.version(peer.distribution)
    except importlib.metadata.PackageNotFoundError:
        state = "is not installed"
    else:
        if version.split(".")[0] == str(peer.major):
            return None
        state = f"{version} is installed, not {peer.major}"
    return Missing(
        peer.name,
        f"{peer.name} is left out: {peer.distribution} {state} (pip install '.[rivals]' installs it).",
    )


def missing() -> list[Missing]:
    """The peers that are left out."""
    return [found for peer in PEERS if (found := why_missing(peer)) is not None]


def cantilever_runs() -> list[PeerRun]:
    """All runs of all peers that are installed, minutes."""
    return [run for peer in PEERS if why_missing(peer) is None for run in runs_of(peer)]


def runs_of(peer: Peer) -> list[PeerRun]:
    """All runs of a peer that is installed."""
    version = importlib.metadata.version(peer.distribution)
    module = importlib.import_module(peer.module)
    finest_mm: Tip = module.finest_tip_mm()
    schemes: dict[str, list[Measured]] = module.runs()
    return [
        peer_run(f"{peer.name}, {scheme}", version, one, finest_mm)
        for scheme, measured in schemes.items()
        for one in measured
    ]


def peer_run(name: str, version: str, run: Measured, finest_mm: Tip) -> PeerRun:
    """What was measured, with its errors."""
    return PeerRun(
        name,
        version,
        run.elements,
        run.step_s,
        run.tip_mm,
        error=apart(run.tip_mm, TIP_MM),
        own_error=apart(run.tip_mm, finest_mm),
        wall_s=run.wall_s,
    )
