"""Says which claims of a problem robots meet that are given as scenes.

python -m studies.identification.judge studies/identification/paper-joint.toml runs/joint/scene.toml
python -m studies.identification.judge ... --set solver.step_s 0.0005 --set body.elements_per_bridge 8
"""

import argparse
from pathlib import Path

from magworm_gym.cli.flags import add_set, set_values
from magworm_gym.identification import read_problem
from magworm_gym.identification.evaluation import Evaluator
from magworm_gym.identification.paths import scene_numbers
from magworm_gym.identification.problem import Problem
from magworm_gym.scene import load_scene


def main() -> None:
    """Prints a table for each scene."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("problem", type=Path)
    parser.add_argument("scenes", nargs="+", help="presets or files")
    add_set(parser)
    arguments = parser.parse_args()
    problem = read_problem(arguments.problem, values=set_values(arguments.set))
    for scene in arguments.scenes:
        print("\n".join(table(problem, scene)))


def table(problem: Problem, scene: str) -> list[str]:
    """Each target with what the robot does; parameters of the problem are taken from the scene."""
    unit = problem.space.unit_of(scene_numbers(load_scene(scene)))
    outcomes = Evaluator(problem).outcomes(unit)
    met = [sum(each.met for each in outcomes if each.fitted is fitted) for fitted in (True, False)]
    loss = sum(each.loss for each in outcomes if each.fitted)
    rows = [f"{scene}: fitted targets met {met[0]}, held out {met[1]}, loss {loss:.4g}", ""]
    rows += ["| target | fitted | wanted | model | met |", "|---|---|---|---|---|"]
    for each in sorted(outcomes, key=lambda outcome: (outcome.met, not outcome.fitted)):
        fitted, reached = "yes" if each.fitted else "no", "yes" if each.met else "**no**"
        rows.append(f"| {each.name} | {fitted} | {each.target} | {each.model:.4g} | {reached} |")
    return [*rows, ""]


if __name__ == "__main__":
    main()
