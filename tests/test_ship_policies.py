"""The policies that come with the package are what their trainings left, with what they reach measured."""

from pathlib import Path

import pytest

pytest.importorskip("stable_baselines3")

from magworm_gym import load_policy, policies
from magworm_gym.learning.command_line import UsageError
from training import ship_policies

TINY = """
[tiny]
environment = "MagWorm/Turn-v1"
sentence = "In {seconds:.1f} s {success_share:.0%} of the goals, {episodes} tried, {return_per_s:.1f} °/s."
[tiny.training]
num_envs = 2
steps = 16
seeds = [3, 5]
environment = { max_episode_steps = 5 }
learner = { hidden = [4], n_steps = 8, batch_size = 16 }
"""


def test_a_policy_is_trained_measured_and_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    configs = tmp_path / "configs"
    configs.mkdir()
    (configs / "shipped.toml").write_text(TINY)
    (configs / "ppo.toml").write_text("[default]\n")
    monkeypatch.setattr(ship_policies, "CONFIGS", configs)
    monkeypatch.setattr(ship_policies, "RUNS", tmp_path / "runs")
    ship_policies.main(["tiny", "--out", str(tmp_path / "shipped")])
    policy = load_policy(tmp_path / "shipped" / "tiny")
    reached = ship_policies.measured(policy)
    assert policy.provenance["reaches"] == reached and reached["seconds"] == pytest.approx(0.1)
    assert reached["return_per_s"] == pytest.approx(reached["mean_return"] / 0.1)
    assert policy.sentence.startswith("In 0.1 s ") and policy.sentence in capsys.readouterr().out
    seeds = [load_policy(tmp_path / "runs" / "tiny" / f"seed-{seed}" / "policy") for seed in (3, 5)]
    returns = [ship_policies.measured(one)["mean_return"] for one in seeds]
    assert reached["mean_return"] == max(returns) != min(returns)
    assert policy.provenance["settings"]["steps"] == 16 and policy.provenance["seed"] in (3, 5)
    with pytest.raises(UsageError, match="allowed: tiny"):
        ship_policies.main(["turn"])


def test_every_policy_that_is_listed_is_there_and_says_what_it_reaches() -> None:
    assert policies().keys() == ship_policies.tables().keys()
    for name, table in ship_policies.tables().items():
        policy = load_policy(name)
        reached = policy.provenance["reaches"]
        assert policy.environment_id == table["environment"]
        assert policy.sentence == table["sentence"].format(**reached)
        assert policy.provenance["settings"]["environment_id"] == table["environment"]


@pytest.mark.parametrize(("name", "figure", "least"), [("crawl-3", "return_per_s", 20.0)])
def test_a_policy_still_reaches_what_it_says(name: str, figure: str, least: float) -> None:
    policy = load_policy(name)
    again = ship_policies.measured(policy, 16)[figure]
    assert again > least and again == pytest.approx(policy.provenance["reaches"][figure], rel=0.2)


def test_all_of_them_are_small() -> None:
    sizes = [path.stat().st_size for path in ship_policies.SHIPPED.rglob("*") if path.is_file()]
    assert sum(sizes) < 1_000_000
