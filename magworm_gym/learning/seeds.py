"""Training of several seeds side by side, each in a process of its own."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from importlib import import_module
from pathlib import Path
from typing import Any

from magworm_gym.learning.command_line import UsageError
from magworm_gym.learning.settings import TrainingSettings
from magworm_gym.learning.training import FINISHED, train_seed


def default_workers() -> int:
    """Number of cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def train_seeds(
    settings: TrainingSettings, scenes: Sequence[str], out: Path, workers: int, modules: Sequence[str] = ()
) -> list[dict[str, Any]]:
    """Trains every seed into its own folder.

    Args:
        settings: Settings of the training.
        scenes: Scenes to train in, in TOML.
        out: Folder of the run; a seed has the folder ``seed-N`` in it.
        workers: Processes; 1 trains in this one. The number does not change the results.
        modules: What a process imports first, to register environments and learners.

    Returns:
        One summary for each seed, see :func:`~magworm_gym.learning.training.train_seed`.

    Raises:
        UsageError: A process was ended from outside, or a training diverged.
    """
    folders = [out / f"seed-{seed}" for seed in settings.seeds]
    jobs = list(zip(settings.seeds, folders, strict=True))
    workers = min(workers, sum(not (folder / FINISHED).exists() for folder in folders))
    if workers <= 1:
        return [train_seed(settings, scenes, seed, folder) for seed, folder in jobs]
    threads = max(1, default_workers() // workers)
    # Not forked: a copy of a process with running threads hangs.
    context, others = multiprocessing.get_context("spawn"), set(multiprocessing.active_children())
    with ProcessPoolExecutor(workers, context, _begin_worker, (modules,)) as pool:
        waiting = [
            pool.submit(train_seed, settings, scenes, seed, folder, alone=False, threads=threads)
            for seed, folder in jobs
        ]
        try:
            return [job.result() for job in waiting]
        except BrokenProcessPool:
            raise UsageError("a process that trained a seed was ended, perhaps for want of memory") from None
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
            for process in set(multiprocessing.active_children()) - others:
                process.terminate()


def _begin_worker(modules: Sequence[str]) -> None:
    """A worker ends with the process that started it, which alone hears Ctrl-C: nobody writes on alone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    for module in modules:
        import_module(module)


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    assert parent is not None, "this runs in a worker"
    parent.join()
    os._exit(1)
