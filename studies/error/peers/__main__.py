"""Runs the peers that are installed on the falling cantilever, prints a table and may write it.

python -m studies.error.peers --out studies/error/peers.csv    # minutes; needs the extra `rivals`
"""

import argparse
from pathlib import Path

from studies.error.peers.runs import cantilever_runs, missing
from studies.error.peers.table import peers_csv, peers_text


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--out", type=Path, help="CSV file to write")
    arguments = parser.parse_args()
    for peer in missing():
        print(peer.sentence)
    runs = cantilever_runs()
    print(peers_text(runs))
    if arguments.out is not None:
        arguments.out.parent.mkdir(parents=True, exist_ok=True)
        arguments.out.write_text(peers_csv(runs), encoding="utf-8")


if __name__ == "__main__":
    main()
