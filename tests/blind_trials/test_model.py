"""The model of the trials: agreement with the package without hidden physics, balances, convergence."""

import numpy as np
import pytest

from twintube.dampers import load
from twintube.engine.simulate import simulate
from worlds.blind_trials.damper import march, tube
from worlds.blind_trials.excitation import VELOCITIES, harmonic, quasi_static
from worlds.blind_trials.model import FOAMED, FORCE, FREED, LOST, OIL
from worlds.blind_trials.quantities import Hidden


def sampled(excitation, per=300, velocity=1.0):
    rate = max(100.0, per * velocity / (2 * np.pi * 0.045))
    return np.arange(int(excitation.duration * rate)) / rate


def run(level, velocity, name="SA8", preload=False, hidden=None, *, pause=0.0, **options):
    excitation = harmonic(velocity, pause)
    time = sampled(excitation, velocity=velocity)
    out = march(tube(name, level, preload), hidden or Hidden(), excitation, time, **options)
    return excitation, time, *excitation.sampled(time), out


@pytest.mark.parametrize("name", ["SA1", "SA3", "SA7", "SA8"])
@pytest.mark.parametrize(("level", "preload"), [(1.0, True), (0.56, False), (0.30, False)])
def test_nothing_hidden_is_the_package_s_model(name, level, preload):
    for velocity in (VELOCITIES[1], VELOCITIES[4], VELOCITIES[7]):
        _, _, z, v, out = run(level, velocity, name, preload)
        force = simulate(load(name, as_published=True).with_(oil_level=level, gas_preload=int(preload)), z, v).force
        error = np.sqrt(np.mean((out[:, FORCE] - force) ** 2)) / np.abs(force).max()
        assert error < 0.005, (velocity, error)


def test_oil_is_free_in_foam_freed_or_leaked():
    hidden = Hidden(drain_fast=0.3, drain_slow=0.05, dissolve=0.08, leak=1e-7)
    for name in ("SA3", "SA8"):
        *_, out = run(0.56, 1.572, name, hidden=hidden, pause=5.0)
        total = out[:, OIL] + out[:, FREED] + out[:, LOST]
        assert np.ptp(total) < 1e-9 * total[0]
        assert out[:, FREED].max() > 1e-7 and out[-1, LOST] > 1e-7 and (out[:, FOAMED] >= 0).all()


def test_halving_the_step_changes_little_and_ever_less():
    for level, velocity in ((0.56, 1.572), (0.30, 0.524)):
        forces = [run(level, velocity, dz=dz)[-1][:, FORCE] for dz in (160e-6, 80e-6, 40e-6, 20e-6, 5e-6)]
        errors = [np.sqrt(np.mean((force - forces[-1]) ** 2)) / np.abs(forces[-1]).max() for force in forces[:-1]]
        assert max(errors) < 0.005 and errors[2] < 0.001, errors
        assert errors[3] < errors[0], errors


def test_excitations_start_and_end_at_rest_in_the_middle():
    for excitation in (harmonic(1.572, 60.0), quasi_static()):
        time = np.linspace(0, excitation.duration, 40001)
        z, v = excitation.sampled(time)
        assert abs(z[0]) < 1e-12 and abs(z[-1]) < 1e-9 and np.abs(z).max() <= 0.045 * (1 + 1e-9)
        np.testing.assert_allclose(np.gradient(z, time), v, atol=0.05)
    begin, end = harmonic(0.524).blocks[0]
    z, v = harmonic(0.524).sampled(np.linspace(begin, end, 20001))
    assert np.sum((z[1:] > 1e-6) & (z[:-1] <= 1e-6)) == 19
    assert v.max() == pytest.approx(0.524, rel=1e-3)
