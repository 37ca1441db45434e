"""Says on the terminal what a study has done, and when."""

import time


class Stopwatch:
    """Started when it is made."""

    def __init__(self) -> None:
        self.start = time.perf_counter()

    def said(self, name: str) -> None:
        """Prints the name of a part that has just ended, and the time since the start [s]."""
        print(f"{name:<22}{time.perf_counter() - self.start:6.1f} s", flush=True)
