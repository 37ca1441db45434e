"""What is asked of a worm: each task in a file, and what tasks of one's own are made of."""

from typing import Literal

from magworm_gym.arguments import choice
from magworm_gym.tasks.crawl import Crawl
from magworm_gym.tasks.reach import Reach
from magworm_gym.tasks.task import Goal, GoalOption, Simulation, Task, TaskResult, setting
from magworm_gym.tasks.turn import Turn

TaskName = Literal["crawl", "turn", "reach"]
"""Names of the tasks of this package."""

TASKS: dict[str, type[Task]] = {task.name: task for task in (Crawl, Turn, Reach)}
"""The tasks of this package, by name."""

__all__ = [
    "TASKS",
    "Crawl",
    "Goal",
    "GoalOption",
    "Reach",
    "Simulation",
    "Task",
    "TaskName",
    "TaskResult",
    "Turn",
    "setting",
    "task_of",
]


def task_of(task: Task | str) -> Task:
    """A task as it is; or one of this package by its name, with its usual settings.

    Raises:
        ValueError: It is neither.
    """
    return task if isinstance(task, Task) else TASKS[choice("task", task, tuple(TASKS))]()
