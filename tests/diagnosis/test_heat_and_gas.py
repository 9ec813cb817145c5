"""Heat with its measured temperature, and a wrong gas pressure: named from records that are made with formulas of their own."""

from pathlib import Path

import numpy as np
import pytest

from tests.diagnosis import small
from twintube.arrays import Array
from twintube.dampers import load
from twintube.data import Record
from twintube.diagnosis import diagnose

ROOM = 22.0  # [degC]
PSI = 6894.757  # [Pa]
AMBIENT = 1.013e5  # [Pa]


def heated(r: small.Run, begin: float, seed: int, gun: float = 500.0) -> Record:
    """A heat gun of so many W blows at the damper: a heat capacity with a way out; hyperbolic viscosity, softer seals, an enclosed gas."""
    power = np.abs(r.force * r.velocity) + gun  # [W]
    temperature = np.empty(len(r.time))
    temperature[0] = begin
    for i, dt in enumerate(np.diff(r.time)):
        temperature[i + 1] = temperature[i] + dt * (power[i] - 3.0 * (temperature[i] - ROOM)) / 200.0
    warmer = temperature - ROOM
    force = r.fluid / (1 + 0.009 * warmer) + r.friction * (1 - 0.004 * warmer) + r.gas * (1 + 1.2 * warmer / 295.0)
    return small.record(r, force, seed=seed, temperature=temperature)


def test_a_force_that_fades_with_its_measured_temperature_is_heat(tmp_path: Path) -> None:
    records = [
        heated(small.run(speed, turns=12), begin, i)
        for i, (speed, begin) in enumerate(((0.2, 22.0), (0.35, 22.5), (0.6, 23.0), (0.9, 21.5)))
    ]
    answer = diagnose(small.write(records, tmp_path))
    assert (answer.verdict, [cause.effect for cause in answer.causes]) == ("cause", ["oil_temperature"])
    fade = answer.causes[0].parameters["fade_kelvin"]
    assert fade.value == pytest.approx(0.009, rel=0.2)
    assert answer.causes[0].gain.heldout > 0.9
    ahead = answer.causes[0].parameters.get("fade_heat")  # of the oil, of a thermometer on the tube: here there is no such
    assert ahead is None or ahead.low == 0.0
    assert answer.errors["heldout"]["extended"].force_rmse_N < answer.errors["heldout"]["base"].force_rmse_N / 4


@pytest.mark.slow
@pytest.mark.parametrize("gun", [500.0, 100.0])
def test_records_that_begin_hotter_and_hotter_are_heat_alone(gun: float, tmp_path: Path) -> None:
    """The F-v curve is that of the first temperature, whatever the damper has become by the other records."""
    speeds = (0.1, 0.3, 0.5, 0.8)
    records = [heated(small.run(speed, turns=12), ROOM + 8.0 * i, i, gun) for i, speed in enumerate(speeds)]
    answer = diagnose(small.write(records, tmp_path))
    assert (answer.verdict, [cause.effect for cause in answer.causes]) == ("cause", ["oil_temperature"])


def overcharged(r: small.Run, more: float) -> Array:
    """The force with an enclosed gas of `more` [Pa]: p V^1.3 is constant, V has the stiffness of the parameter set."""
    p, n = load("SA8", as_published=True).parameters, 1.3
    area = 0.25 * np.pi * p.D_PR**2
    given = p.F_0 / area + AMBIENT
    volume = n * given * area**2 / p.c_gas
    pressure = (given + more) * (volume / (volume + area * r.stroke)) ** n
    return np.asarray(r.force - r.gas - (pressure - AMBIENT) * area)


def test_fifty_psi_too_much_in_an_intact_damper_is_gas(tmp_path: Path) -> None:
    more = 50 * PSI
    records = small.records(lambda r: overcharged(r, more), speeds=(0.05, 0.1, 0.3, 0.6, 1.0))
    answer = diagnose(small.write(records, tmp_path))
    assert (answer.verdict, [cause.effect for cause in answer.causes]) == ("cause", ["gas_spring"])
    surplus = answer.causes[0].parameters["F_surplus"]
    assert surplus.value == pytest.approx(more * 0.25 * np.pi * load("SA8", as_published=True).parameters.D_PR ** 2, rel=0.2)
    assert set(answer.causes[0].parameters) == {"F_surplus"}  # no record is without preload
