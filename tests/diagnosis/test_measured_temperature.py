"""A column of temperatures means to diagnosis, identification and check what it means to `simulate`."""

import re
from pathlib import Path

import numpy as np
import pytest

from tests.diagnosis import small
from twintube.core.checks import KELVIN
from twintube.dampers import load
from twintube.dampers.temperature import at_temperature, held_at
from twintube.data import load_dataset
from twintube.engine.simulate import simulate


def test_diagnosis_compares_with_what_simulate_gives_at_the_temperatures() -> None:
    damper = load("SA8", as_published=True)
    r = small.run(0.6)
    degC = np.linspace(30.0, 70.0, len(r.time))
    force = simulate(damper, r.stroke, r.velocity, r.time, temperature=degC + KELVIN).force
    warm = small.record(r, force, noise=1e-4, temperature=degC)
    told, untold = (
        np.sqrt(np.mean(small.problem([each]).errors({}) ** 2)) for each in (warm, small.record(r, force, noise=1e-4))
    )
    peak = np.abs(force).max()
    assert told < 0.003 * peak
    assert untold > 10.0 * told


def test_a_record_that_says_no_temperature_has_that_of_the_others() -> None:
    r = small.run(0.3)
    warm = small.record(r, temperature=np.full(len(r.time), 50.0))
    ready = small.problem([warm, small.record(small.run(0.6))]).records
    assert {float(each) for record in ready for each in record.kelvins} == {50.0 + KELVIN}
    alone = small.problem([small.record(r)]).records[0]
    assert set(alone.kelvins.tolist()) == {load("SA8").parameters.T_curve}


def test_a_curve_measured_warm_keeps_the_law() -> None:
    """The same law from another temperature on: what is between any two temperatures stays."""
    damper = load("SA8")
    warm = held_at(damper, 45.0 + KELVIN)
    assert warm.parameters.T_curve == 45.0 + KELVIN
    for degC in (-25.0, 0.0, 23.0, 70.0):
        then = (
            at_temperature(damper, degC + KELVIN).parameters.F_re[3]
            / at_temperature(damper, 45.0 + KELVIN).parameters.F_re[3]
        )
        assert at_temperature(warm, degC + KELVIN).parameters.F_re[3] / warm.parameters.F_re[3] == pytest.approx(
            then, rel=1e-9
        )


def test_a_record_beyond_the_law_is_named(tmp_path: Path) -> None:
    r = small.run(0.3)
    folder = small.write([small.record(r, temperature=np.full(len(r.time), 95.0))], tmp_path / "hot")
    (found,) = (each for each in load_dataset(folder).findings if each.column == "temperature")
    assert found.severity == "warning"
    assert re.search(r"95 to 95 degC: the law of .* holds from -30 to 80 degC", found.message)
