"""Runs the peers that are installed on the cantilevers, prints tables and may write one.

python -m studies.error.peers --out studies/error/peers.csv    # minutes; needs the extra `rivals`
"""

import argparse
from pathlib import Path

from studies.error.peers.runs import PEERS, PeerRun, runs_of, why_missing
from studies.error.peers.table import peers_csv, peers_text


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--out", type=Path, help="CSV file to write")
    arguments = parser.parse_args()
    runs: list[PeerRun] = []
    for peer in PEERS:
        absent = why_missing(peer)
        found = runs_of(peer) if absent is None else []
        print(peers_text(found) if absent is None else absent.sentence, flush=True)
        runs += found
    if arguments.out is not None:
        arguments.out.parent.mkdir(parents=True, exist_ok=True)
        arguments.out.write_text(peers_csv(runs), encoding="utf-8")


if __name__ == "__main__":
    main()
