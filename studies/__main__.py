"""``python -m studies measure NAME``, ``python -m studies render [NAME ...]``: see :mod:`studies.kit`."""

import sys

from studies.kit.study import main

MODULES = {
    "error": "studies.error.study",
    "growth": "studies.growth.study",
    "learners": "studies.learners.study",
    "needs": "studies.needs.study",
    "paper": "studies.paper.study",
    "peak": "studies.peak.study",
    "speed": "studies.speed.study",
    "stability": "studies.stability.study",
    "turning": "studies.turning.study",
    "validation": "studies.validation.study",
}
"""Every study, and the module that holds it."""

if __name__ == "__main__":
    sys.exit(main(MODULES))
