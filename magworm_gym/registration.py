"""Entries of Gymnasium's registry."""

import gymnasium

CRAWL_ID = "MagWorm/Crawl-v0"
"""Identifier of the crawling task."""
TURN_ID = "MagWorm/Turn-v0"
"""Identifier of the task of turning to a heading, in space."""
REACH_ID = "MagWorm/Reach-v0"
"""Identifier of the task of crawling to a point, in space."""

ARGUMENTS: dict[str, dict[str, str]] = {CRAWL_ID: {}, TURN_ID: {"task": "turn"}, REACH_ID: {"task": "reach"}}
"""Arguments that make the environment of each identifier."""


def register_environments() -> None:
    """Registers the environments of this package, once.

    Entry points are strings, so that a specification can be written as JSON and
    ``"magworm_gym:MagWorm/Crawl-v0"`` works in a process that has not imported the package.
    No ``max_episode_steps`` is registered: the time limit is the scene's own.
    """
    for identifier, arguments in ARGUMENTS.items():
        if identifier not in gymnasium.registry:
            gymnasium.register(
                identifier,
                entry_point="magworm_gym.env:MagWormEnv",
                vector_entry_point="magworm_gym.vector_env:MagWormVectorEnv",
                kwargs=dict(arguments),
            )
