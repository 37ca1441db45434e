"""Training of several seeds side by side, each in a process of its own."""

import multiprocessing
import os
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

from magworm_gym import Scene
from magworm_gym.learning.settings import TrainingSettings


def default_workers() -> int:
    """Number of cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def train_seeds(settings: TrainingSettings, scene: Scene, out: Path, workers: int) -> list[dict[str, Any]]:
    """Trains every seed into its own folder.

    Args:
        settings: Settings of the training.
        scene: Scene to train on.
        out: Folder of the run; a seed has the folder ``seed-N`` in it.
        workers: Processes; 1 trains in this one. The number does not change the results.

    Returns:
        One summary for each seed, see ``crawl_training.train_seed``.
    """
    from magworm_gym.learning.training import FINISHED, train_seed

    folders = [out / f"seed-{seed}" for seed in settings.seeds]
    waiting = sum(not (folder / FINISHED).exists() for folder in folders)
    workers = min(workers, waiting)
    if workers <= 1:
        return [train_seed(settings, scene, *place) for place in zip(settings.seeds, folders, strict=True)]
    threads = max(1, default_workers() // workers)
    # Not forked: a copy of a process with running threads hangs.
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(workers, mp_context=context) as pool:
        jobs = [
            pool.submit(_train_in_worker, settings, scene.to_toml(), seed, folder, place % workers, threads)
            for place, (seed, folder) in enumerate(zip(settings.seeds, folders, strict=True))
        ]
        return [job.result() for job in jobs]


def _train_in_worker(
    settings: TrainingSettings, scene_toml: str, seed: int, folder: Path, row: int, threads: int
) -> dict[str, Any]:
    from magworm_gym.learning.training import train_seed

    return train_seed(settings, Scene.from_toml(scene_toml), seed, folder, row=row, threads=threads)
