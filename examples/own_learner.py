"""A learner of one's own: ``python examples/own_learner.py crawl --algorithm evolution``."""

import numpy as np

from magworm_gym.documents import Table
from magworm_gym.learning import train
from magworm_gym.learning.command_line import run
from magworm_gym.learning.learner import Learner, Round, Share, register_learner
from magworm_gym.policy import Layer, Network, Normaliser


class Evolution(Learner):
    """Gives each environment a linear policy that differs at random, and goes towards those that got more."""

    class Options(Table, frozen=True):
        """How much the policies differ."""

        noise: Share = 1.0

    def __init__(self, place, options, steps, folder):
        self.noise, self.worms = options.noise, place.native()
        self.random = np.random.default_rng(place.seed)
        self.seen, _ = self.worms.reset(seed=place.first_seed)
        self.weights = np.zeros((self.worms.single_action_space.shape[0], self.seen.shape[1]))

    def advance(self):
        """Two seconds of all environments."""
        gained = np.zeros(len(self.seen))
        change = self.noise * self.random.standard_normal((len(gained), *self.weights.shape))
        for _ in range(100):
            actions = np.einsum("nao,no->na", self.weights + change, self.seen)
            self.seen, rewards, *_ = self.worms.step(actions)
            gained += rewards
        self.weights += np.tensordot((gained - gained.mean()) / gained.std(), change, 1) / len(gained)
        return Round(100 * len(gained), gained.sum())

    def actor(self):
        """The policy in the middle."""
        layer = Layer(self.weights.astype(np.float32), np.zeros(len(self.weights), np.float32))
        return Network([layer]), Normaliser.none(self.seen.shape[1])

    def state(self):
        """All that a round changes."""
        worms, drawn = self.worms.get_state(), self.random.bit_generator.state
        return {"weights": self.weights, "seen": self.seen, "worms": worms, "drawn": drawn}

    def restore(self, state):
        """Goes on from it."""
        self.worms.set_state(state["worms"])
        self.weights, self.seen = state["weights"], state["seen"]
        self.random.bit_generator.state = state["drawn"]


register_learner("evolution", Evolution)
if __name__ == "__main__":
    run("own_learner.py", train.main)
