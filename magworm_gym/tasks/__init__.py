"""What is asked of a worm: each task in a file, chosen by its name."""

from magworm_gym.arguments import choice
from magworm_gym.tasks.crawl import Crawl
from magworm_gym.tasks.reach import Reach
from magworm_gym.tasks.task import Goal, GoalOption, Simulation, Task, TaskResult
from magworm_gym.tasks.turn import Turn

TASKS: dict[str, type[Task]] = {task.name: task for task in (Crawl, Turn, Reach)}
"""The tasks, by name."""

__all__ = [
    "TASKS",
    "Crawl",
    "Goal",
    "GoalOption",
    "Reach",
    "Simulation",
    "Task",
    "TaskResult",
    "Turn",
    "task_named",
]


def task_named(name: str) -> type[Task]:
    """The task of a name; make it with the scene and the number of environments.

    Raises:
        ValueError: There is none of that name.
    """
    return TASKS[choice("task", name, tuple(TASKS))]
