"""Entries of Gymnasium's registry."""

import gymnasium

CRAWL_ID = "MagWorm/Crawl-v0"
"""Identifier of the crawling task."""


def register_environments() -> None:
    """Registers the environments of this package, once.

    Entry points are strings, so that a specification can be written as JSON and
    ``"magworm_gym:MagWorm/Crawl-v0"`` works in a process that has not imported the package.
    No ``max_episode_steps`` is registered: the time limit is the scene's own.
    """
    if CRAWL_ID not in gymnasium.registry:
        gymnasium.register(
            CRAWL_ID,
            entry_point="magworm_gym.env:MagWormEnv",
            vector_entry_point="magworm_gym.vector_env:MagWormVectorEnv",
        )
