"""A task of one's own on a robot of one's own: crawl a given distance ahead and stop there."""

from dataclasses import dataclass
from pathlib import Path

import gymnasium
import numpy as np

from magworm_gym import register_task
from magworm_gym.spaces import Part
from magworm_gym.tasks import Task, TaskResult, setting


@dataclass
class Stop(Task):
    """Reward: what the robot came nearer to the place where it is to stop [mm]."""

    default_scene = Path(__file__).with_name("own_scene.toml")
    reward_unit = "mm"
    parts = (Part("left", "m", 1, -np.inf, np.inf, "distance that is left, negative beyond the place"),)

    distance_m: float = setting(0.020, 0.0, 1.0)
    tolerance_m: float = setting(0.001, 0.0, 1.0)

    def prepare(self, scene, observed, num_envs):
        """Remembers the distance that is left."""
        self.state = {"left_m": np.zeros(num_envs)}

    def begin(self, simulation, mask, requested_goal, uniform):
        """All of it is left where an episode starts."""
        self.state["left_m"] = np.where(mask, self.distance_m, self.state["left_m"])

    def evaluate(self, simulation, progress_m, mask):
        """Counts the progress of the environments that stepped; no episode ends but by its time."""
        before = self.state["left_m"]
        left = self.state["left_m"] = before - np.where(mask, progress_m, 0.0)
        nearer_mm = 1000.0 * (np.abs(before) - np.abs(left))
        return TaskResult(nearer_mm, np.zeros(len(mask), bool), success=np.abs(left) < self.tolerance_m)

    def observe(self, simulation):
        """What is left."""
        return self.state["left_m"][:, np.newaxis]


register_task("Own/Stop-v0", Stop)

if __name__ == "__main__":
    worms = gymnasium.make_vec("Own/Stop-v0", num_envs=4, distance_m=0.010)
    worms.reset(seed=0)
    plans = np.random.default_rng(0).uniform(-1.0, 1.0, (100, 256, 3))
    best = worms.rollout(plans, start=0)
    print(f"best of 256 random plans: {best.returns.max():.1f} of 10 mm in 2 s")
