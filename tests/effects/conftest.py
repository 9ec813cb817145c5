"""What the tests of the effects share: a degraded damper, and every effect made active without being named."""

from typing import Any

import pytest

from twintube.core.effects import EFFECTS
from twintube.core.variables import FV_POINTS
from twintube.dampers import Damper, load
from twintube.rig.signals import Signal, harmonic_block


def strong(name: str, share: float = 0.1) -> dict[str, Any]:
    """Strengths of an effect at a share of their upper bounds."""
    effect = EFFECTS[name]
    return {item.name: share * item.metadata["upper"] for item in effect.parameters if item.name in effect.strength}


@pytest.fixture
def sa8() -> Damper:
    """SA8 at 60 % oil without preload: foam and cavitation at work."""
    return load("SA8", as_published=True).with_(oil_level=0.6, gas_preload=0)


@pytest.fixture
def block() -> Signal:
    """The end of the preconditioning, a rest of a minute, and six fast oscillations; 2 ms."""
    whole = harmonic_block(1.572, dt=2e-3, rest=60.0)
    first, last = int(whole.marks[0]) - 300, int(whole.marks[6]) + 1
    part = slice(first, last)
    return Signal(whole.time[part], whole.stroke[part], whole.velocity[part], whole.marks[:7] - first)


@pytest.fixture(params=EFFECTS)
def active(request: pytest.FixtureRequest) -> dict[str, Any]:
    """One effect after the other."""
    return strong(request.param)


@pytest.fixture
def everything() -> dict[str, Any]:
    """All effects at once."""
    return {key: value for name in EFFECTS for key, value in strong(name).items()}


@pytest.fixture
def dashpot() -> Damper:
    """An intact damper that is nothing but a linear dashpot of 2000 N s/m."""
    v = [0.1 * (i + 1) for i in range(FV_POINTS)]
    F = [2000.0 * x for x in v]
    return load("SA8", as_published=True).with_(v_re=v, F_re=F, v_co=v, F_co=F, F_FrS=0.0, F_0=0.0, c_gas=0.0)
