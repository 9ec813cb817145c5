"""Friction and foam against their equations, solved by other means."""

import math

import pytest
from scipy.integrate import solve_ivp

from twintube.core.kernel import prepare, stribeck
from twintube.core.kernel.forces import dahl, foam_factor, share_above
from twintube.core.variables import Derived, blank
from twintube.dampers import load

SATURATED = (
    1e-6  # share of the friction that is left to come: where the root has no derivative, the solver would stand still
)


@pytest.mark.parametrize("exponent", [0.5, 1.0, 1.7, 3.0])
@pytest.mark.parametrize("start", [-50.0, -20.0, 0.0, 35.0, 49.0])
@pytest.mark.parametrize("dz", [2e-4, -2e-4, 1e-3])
def test_dahl_solves_equation_2(exponent: float, start: float, dz: float) -> None:
    p = load("SA1", as_published=True).with_(delta_D=exponent).parameters
    d = blank(Derived)
    prepare(p, d)
    direction = math.copysign(1.0, dz)

    def rate(_: float, force: list[float]) -> list[float]:
        gap = 1 - direction * force[0] / d.F_FrS
        return [direction * p.sigma_0 * math.copysign(1.0, gap) * abs(gap) ** exponent]

    def saturated(_: float, force: list[float]) -> float:
        return 1 - direction * float(force[0]) / d.F_FrS - SATURATED

    saturated.terminal = True  # type: ignore[attr-defined]
    solved = solve_ivp(rate, (0, abs(dz)), [start], rtol=1e-10, atol=1e-9, max_step=abs(dz) / 300, events=saturated)
    assert dahl(p, d, start, dz) == pytest.approx(solved.y[0, -1], abs=2e-2)


def test_dahl_does_not_depend_on_the_step() -> None:
    p = load("SA1", as_published=True).parameters
    d = blank(Derived)
    prepare(p, d)
    force = -20.0
    for _ in range(100):
        force = dahl(p, d, force, 5e-6)
    assert force == pytest.approx(dahl(p, d, -20.0, 5e-4), rel=1e-10)


def test_stribeck_is_one_at_rest_and_settles() -> None:
    p = load("SA1", as_published=True).parameters
    assert stribeck(p, 0.0) == 1.0
    assert stribeck(p, -5.0) == pytest.approx(p.k_high)


def test_foam_force_equation_36() -> None:
    p = load("SA1", as_published=True).with_(B=0.5, E=2.0).parameters
    assert foam_factor(p, 0.25, 1.0) == pytest.approx(0.5 * 0.25**2)
    assert foam_factor(p, 0.0, 1.0) == 0.0
    assert foam_factor(load("SA1", as_published=True).with_(B=0.5, E=0.0).parameters, 0.25, 1.0) == 0.5


def test_share_above_a_threshold() -> None:
    assert share_above(0.0, 1.0, 0.75) == pytest.approx(0.25)
    assert share_above(-1.0, 0.0, 0.75) == pytest.approx(0.25)
    assert share_above(2.0, 3.0, 1.0) == 1.0
    assert share_above(0.2, -0.3, 1.0) == 0.0
