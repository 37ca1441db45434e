"""Other simulators on the cases of the study, where they are installed: `pip install '.[rivals]'`."""

from studies.error.peers.runs import Missing, PeerRun, all_runs, missing

__all__ = ["Missing", "PeerRun", "all_runs", "missing"]
