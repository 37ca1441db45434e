"""Drives that do not learn, as rivals in the same limits of the stage.

* ``sweep_belt``: the paper's belt of magnets at constant speed.
* ``Shuttle``: one magnet to and fro under the robot; ``Tow``: one held at a fixed place, which tows the robot
  if it is too strong; ``sweep`` finds their best settings.
* ``StrokeSearch``, ``PeriodicStrokes``: the best periodic stroke that CMA-ES finds.
* ``CycleSearch``, ``FAMILIES``, ``Steered``: cycles in space, mirrored to the side on which a goal is.
* ``Still``, ``UniformlyRandom``: no drive, and noise.

A ``Runner`` holds the robots: ``Trial`` measures their speeds, ``fly`` sends them to goals, ``record`` films.
"""

from magworm_gym.baselines.belt import PAPER_PITCHES_M, belt_scene, belt_starts, sweep_belt
from magworm_gym.baselines.controller import Still, UniformlyRandom
from magworm_gym.baselines.cycle import Cycle, Steered
from magworm_gym.baselines.family import FAMILIES, Family
from magworm_gym.baselines.flight import AIMS, Flight, fly
from magworm_gym.baselines.runner import Controller, OpenLoop, Runner, record
from magworm_gym.baselines.search import Found, search
from magworm_gym.baselines.searches import CycleSearch, StrokeSearch
from magworm_gym.baselines.shuttle import SHUTTLE_AXES, Shuttle
from magworm_gym.baselines.stroke import PeriodicStrokes, Stroke, stroke_from_unit
from magworm_gym.baselines.sweep import Sweep, sweep
from magworm_gym.baselines.tow import TOW_AXES, Tow
from magworm_gym.baselines.trial import Trial, centre_x_m
from magworm_gym.recording import Recording

__all__ = [
    "AIMS",
    "FAMILIES",
    "PAPER_PITCHES_M",
    "SHUTTLE_AXES",
    "TOW_AXES",
    "Controller",
    "Cycle",
    "CycleSearch",
    "Family",
    "Flight",
    "Found",
    "OpenLoop",
    "PeriodicStrokes",
    "Recording",
    "Runner",
    "Shuttle",
    "Steered",
    "Still",
    "Stroke",
    "StrokeSearch",
    "Sweep",
    "Tow",
    "Trial",
    "UniformlyRandom",
    "belt_scene",
    "belt_starts",
    "centre_x_m",
    "fly",
    "record",
    "search",
    "stroke_from_unit",
    "sweep",
    "sweep_belt",
]
