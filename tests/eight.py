"""The eight dampers where they all take the same way: three of them by default, all at night."""

import pytest

from twintube.dampers import names

SHOWN = ("SA1", "SA4", "SA8")  # a front one, one without cavitation, a rear one
EIGHT = [name if name in SHOWN else pytest.param(name, marks=pytest.mark.slow) for name in names()]
