"""Drives that do not learn, as rivals in the same limits of the stage.

* ``sweep_belt``: the paper's belt of magnets at constant speed.
* ``sweep_shuttle``, ``Shuttle``: one magnet to and fro under the robot.
* ``search_stroke``, ``PeriodicStrokes``: the best periodic stroke that CMA-ES finds.
* ``sweep_tow``, ``Tow``: a magnet held at a fixed place, which tows the robot if it is too strong.
* ``Still``, ``UniformlyRandom``: no drive, and noise.
"""

from magworm_gym.baselines.belt import PAPER_PITCHES_M, BeltCurve, belt_scene, belt_starts, sweep_belt
from magworm_gym.baselines.controller import Controller, OpenLoop, Still, UniformlyRandom
from magworm_gym.baselines.search import SearchResult, SearchSettings, search_stroke
from magworm_gym.baselines.shuttle import Shuttle, ShuttleCurve, sweep_shuttle
from magworm_gym.baselines.stroke import PeriodicStrokes, Stroke, stroke_from_unit
from magworm_gym.baselines.tow import Tow, TowCurve, sweep_tow
from magworm_gym.baselines.trial import Trial, centre_x_m, crawl_speed_m_s, record
from magworm_gym.recording import Recording

__all__ = [
    "PAPER_PITCHES_M",
    "BeltCurve",
    "Controller",
    "OpenLoop",
    "PeriodicStrokes",
    "Recording",
    "SearchResult",
    "SearchSettings",
    "Shuttle",
    "ShuttleCurve",
    "Still",
    "Stroke",
    "Tow",
    "TowCurve",
    "Trial",
    "UniformlyRandom",
    "belt_scene",
    "belt_starts",
    "centre_x_m",
    "crawl_speed_m_s",
    "record",
    "search_stroke",
    "stroke_from_unit",
    "sweep_belt",
    "sweep_shuttle",
    "sweep_tow",
]
