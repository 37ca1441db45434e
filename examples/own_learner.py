"""A learner of one's own: ``python examples/own_learner.py crawl --algorithm evolution``."""

from typing import Annotated

import numpy as np
from gymnasium.vector import AutoresetMode
from msgspec import Meta, Struct

from magworm_gym.learning import train
from magworm_gym.learning.command_line import run
from magworm_gym.learning.learner import Learner, Round, register_learner
from magworm_gym.policy import Layer, Network, Normaliser

Positive = Annotated[float, Meta(gt=0, le=10, description="a number above 0, up to 10")]


class Evolution(Learner):
    """Gives each environment a linear policy that differs at random, and goes towards those that got more."""

    class Options(Struct, frozen=True, forbid_unknown_fields=True):
        """How much the policies differ, and how far to go."""

        noise: Positive = 1.0
        rate: Positive = 1.0

    def __init__(self, place, options, steps, folder):
        self.options, self.generator = options, np.random.default_rng(place.seed)
        self.worms = place.native(autoreset_mode=AutoresetMode.SAME_STEP)
        self.seen, _ = self.worms.reset(seed=place.first_seed)
        self.weights = np.zeros((self.worms.single_action_space.shape[0], self.seen.shape[1]))

    def advance(self):
        """Two seconds of all environments."""
        change = self.options.noise * self.generator.standard_normal((len(self.seen), *self.weights.shape))
        gained = np.zeros(len(self.seen))
        for _ in range(100):
            actions = np.einsum("nao,no->na", self.weights + change, self.seen)
            self.seen, rewards, *_ = self.worms.step(actions)
            gained += rewards
        better = (gained - gained.mean()) / (gained.std() + 1e-9)
        self.weights += self.options.rate * np.tensordot(better, change, 1) / len(better)
        return Round(100 * len(gained), gained.sum())

    def actor(self):
        """The policy in the middle."""
        bias = np.zeros(len(self.weights), np.float32)
        return Network([Layer(self.weights.astype(np.float32), bias)]), Normaliser.none(self.seen.shape[1])

    def state(self):
        """All that a round changes."""
        worms, drawn = np.frombuffer(self.worms.get_state(), np.uint8), self.generator.bit_generator.state
        return {"weights": self.weights, "seen": self.seen, "worms": worms, "drawn": drawn}

    def restore(self, state):
        """Goes on from it."""
        self.weights, self.seen = state["weights"], state["seen"]
        self.worms.set_state(state["worms"].tobytes())
        self.generator.bit_generator.state = state["drawn"]


register_learner("evolution", Evolution)

if __name__ == "__main__":
    run("own_learner.py", train.main)
