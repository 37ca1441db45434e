"""A checker for vector environments of Gymnasium, of any make.

Gymnasium checks single environments (``gymnasium.utils.env_checker.check_env``); nothing checks a
``gymnasium.vector.VectorEnv``. :func:`check_vector_env` does: it plays short episodes and compares
what comes back with the interface of Gymnasium 1.2 and later, autoreset mode by autoreset mode.

>>> import gymnasium
>>> from magworm_gym.testing import check_vector_env
>>> print(check_vector_env(lambda: gymnasium.make_vec("CartPole-v1", num_envs=3)))
"""

from collections.abc import Callable
from typing import Any

from magworm_gym.testing import autoreset, independence, interface, seeding
from magworm_gym.testing.bench import AnyVectorEnv, Bench
from magworm_gym.testing.report import Finding, Report

__all__ = ["Finding", "Report", "check_vector_env"]

CHECKS = (*interface.CHECKS, *seeding.CHECKS, *independence.CHECKS, *autoreset.CHECKS, interface.closing)


def check_vector_env(
    env_or_factory: AnyVectorEnv | Callable[..., AnyVectorEnv],
    *,
    seed: int = 0,
    max_steps: int = 300,
    options: dict[str, Any] | None = None,
    strict: bool = False,
    raise_on_failure: bool = True,
) -> Report:
    """Checks that a vector environment keeps to Gymnasium's interface.

    Checked are: attributes and spaces; signature of ``reset``; shapes, dtypes and bounds of what
    ``reset`` and ``step`` return, and that no later call changes it; the form of infos; options
    left unchanged; rendered frames; same trajectories from same seeds, a seed of its own for each
    environment; independence of each environment from the others and, where the factory takes
    ``num_envs``, from their number; the declared autoreset mode, with what ends and starts in which
    step; closing twice.

    Args:
        env_or_factory: An environment, or better a callable that makes a new one on each call; if
            it takes an argument ``num_envs`` it is called with 1 and 3. An environment given itself
            is reset and stepped, not closed, and checks that need a second one are skipped.
        seed: Of resets and of the random actions.
        max_steps: Steps after which waiting for the end of an episode is given up. Autoreset can
            only be checked on episodes that end: pass environments with short ones.
        options: Passed to the resets; None for none.
        strict: Counts what is noted as failed.
        raise_on_failure: False returns the report whatever was found.

    Returns:
        The report of all checks.

    Raises:
        AssertionError: Checks failed; one sentence for each.
        TypeError: `env_or_factory` is neither an environment nor a callable.
    """
    bench = Bench(env_or_factory, seed, max_steps, options)
    findings = tuple(check(bench) for check in CHECKS)
    report = Report(bench.name, findings)
    bad = [*report.with_outcome("failed"), *(report.with_outcome("noted") if strict else ())]
    if bad and raise_on_failure:
        raise AssertionError("\n".join([f"{bench.name}:", *(f"- {f.check}: {f.sentence}" for f in bad)]))
    return report
