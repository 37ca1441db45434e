"""Fitting a scene to a robot: from measured numbers and tracks of a film to parameters.

>>> from pathlib import Path
>>> from magworm_gym.identification import identify, read_problem, write_results
>>> found = identify(read_problem(Path("problem.toml")))  # doctest: +SKIP
>>> found.values, found.findings[0].verdict  # doctest: +SKIP

The command line is ``magworm identify``. Needs the extra ``identify``.
"""

from magworm_gym.identification.camera import Camera
from magworm_gym.identification.deeplabcut import Tracks, read_deeplabcut
from magworm_gym.identification.example_tracks import Blur, write_example_tracks
from magworm_gym.identification.findings import Finding
from magworm_gym.identification.identify import Identification, identify
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.problem import Problem, make_problem
from magworm_gym.identification.problem_file import read_problem
from magworm_gym.identification.report import write_results
from magworm_gym.identification.settings import SearchSettings

__all__ = [
    "Blur",
    "Camera",
    "Finding",
    "Identification",
    "Problem",
    "ProblemError",
    "SearchSettings",
    "Tracks",
    "identify",
    "make_problem",
    "read_deeplabcut",
    "read_problem",
    "write_example_tracks",
    "write_results",
]
