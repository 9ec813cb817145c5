"""What identification and diagnosis share: derivatives, least squares, pulls, intervals and velocities."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from twintube.common.arrays import Array
from twintube.core import effects
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import load
from twintube.dampers.gas_spring import P_ATM, gas_factors
from twintube.data.records.condition import is_intact
from twintube.engine import compiled
from twintube.engine.loops import Means, Records
from twintube.fitting.intervals import impulse, means
from twintube.fitting.least_squares import STEP, bounded, derivatives, pulls, sandwich
from twintube.fitting.parameters import DEGRADATION, FASTER, ranges
from twintube.fitting.simulation import SimulatedRecords
from twintube.fitting.splits import distinct

LOW, HIGH = np.array([0.0, 10.0]), np.array([1.0, 30.0])


def line(X: Array) -> Array:
    """Residuals (m, 3) that are linear in the parameters (m, 2)."""
    return np.column_stack([X[:, 0], X[:, 1], X[:, 0] + X[:, 1]])


def test_derivatives_are_by_the_parameters_in_units_of_their_ranges_and_stay_inside() -> None:
    seen: list[Array] = []

    def watched(X: Array) -> Array:
        seen.append(X)
        return line(X)

    J = derivatives(watched, np.array([1.0, 20.0]), LOW, HIGH)
    assert pytest.approx(np.array([[1.0, 0.0], [0.0, 20.0], [1.0, 20.0]])) == J
    assert seen[0].max(axis=0) == pytest.approx([1.0, 20.0 + 20 * STEP])  # at the upper end the step goes down
    assert seen[0][1, 0] == pytest.approx(1.0 - STEP)


def test_least_squares_ends_at_the_optimum_or_at_the_bound() -> None:
    A, b = np.array([[2.0, 0.0], [0.0, 1.0], [1.0, 1.0]]), np.array([1.0, 0.3, 0.8])
    u, cost = bounded(lambda u: A @ u - b, lambda u: A, np.array([0.1, 0.9]), 50)
    assert u == pytest.approx([0.5, 0.3], abs=1e-6)
    assert cost == pytest.approx(0.0, abs=1e-10)
    outside, _ = bounded(lambda u: u + 1.0, lambda u: np.eye(2), np.array([0.5, 0.5]), 50)
    assert outside == pytest.approx([0.0, 0.0], abs=1e-3)


def test_errors_that_a_record_s_samples_share_widen_the_sandwich() -> None:
    """A constant fitted to records of many samples: its variance is that of the records' means."""
    rng = np.random.default_rng(1)
    records, samples = 40, 50
    errors = np.repeat(rng.standard_normal(records), samples)
    J = np.ones((records * samples, 1))
    own = pulls(J, errors - errors.mean(), np.arange(records + 1) * samples)
    inverse = np.linalg.inv(J.T @ J)
    shared = sandwich(inverse, own.T @ own)[0, 0]
    assert shared == pytest.approx(1 / records, rel=0.4)
    assert shared > 10 * inverse[0, 0]


def test_mean_forces_keep_the_impulse() -> None:
    time = np.array([0.0, 0.1, 0.3, 0.35, 1.0])
    force = np.array([1.0, -2.0, 5.0, 5.0, 0.0])
    integral = impulse(time, force)
    assert means(time, integral) @ np.diff(time) == pytest.approx(np.trapezoid(force, time))


def test_velocities_that_differ_by_their_noise_are_counted_once() -> None:
    assert distinct([1.0, 0.5, 0.51, 0.499, 1.04], 1.05) == [0.499, 1.0]


def test_ranges_are_those_of_the_table_and_cavitation_begins_within_reach() -> None:
    limits = dict(zip(DEGRADATION, ranges(DEGRADATION, 0.5).tolist(), strict=True))
    table = effects.Parameters.__dataclass_fields__
    assert limits["X_Re"] == [table["X_Re"].metadata["lower"], table["X_Re"].metadata["upper"]]
    assert limits["v_cav"][1] == pytest.approx(FASTER * 0.5)


def test_a_damper_is_intact_with_its_preload_and_all_but_half_a_percent_of_its_oil() -> None:
    assert is_intact(1.0, gas_preload=True) and is_intact(0.995, gas_preload=1)
    assert not is_intact(0.99, gas_preload=True)
    assert not is_intact(1.0, gas_preload=False)


def test_the_gas_force_goes_with_the_gauge_pressure_and_its_stiffness_with_the_absolute() -> None:
    damper = load("SA8", as_published=True)
    given = damper.parameters.F_0 / (0.25 * np.pi * damper.parameters.D_PR**2)
    assert gas_factors(damper, None) == (1.0, 1.0)
    assert gas_factors(damper, given) == pytest.approx((1.0, 1.0))
    force, stiffness = gas_factors(damper, given + 2 * (given + P_ATM))
    assert stiffness == pytest.approx(3.0)
    assert force > 3.0
    assert gas_factors(damper, 0.0) == pytest.approx((0.0, P_ATM / (given + P_ATM)))


def test_a_record_does_not_depend_on_what_stands_before_it() -> None:
    """It begins at rest, with the scratch values of the last step before it, which may be next to nothing."""
    damper = load("SA8", as_published=True).with_(tau_build=5e-4, gas_preload=0, oil_level=0.5)
    time = np.linspace(0.0, 1.0, 41)
    stroke, velocity = -0.04 * np.cos(6.0 * time), 0.24 * np.sin(6.0 * time)
    states, starts, samples = np.array([[0.5, 0.0, 1.0, 1.0]]), np.array([0, 41]), np.ones(41, dtype=np.int64)
    forces = []
    for left in (1.0, 1e-310):
        rows = [
            compiled.as_row(record)[0] for record in (damper.parameters, blank(Derived), blank(effects.State), blank(Flow))
        ]
        rows[3]["k_degr"] = left
        found = Means(*np.empty((3, 41)))
        records = Records(states, starts, time, stroke, velocity, np.zeros(41), samples, parts=4)
        compiled.module().run_means(*rows, records, found)
        forces.append(np.concatenate(found))
    assert np.isfinite(forces[0]).all()
    assert np.array_equal(*forces)


def test_threads_end_with_their_owner() -> None:
    still: Any = SimpleNamespace(
        oil_level=1.0, gas_preload=1, time=np.arange(3) * 5e-3, stroke=np.zeros(3), velocity=np.zeros(3)
    )
    with SimulatedRecords(load("SA8"), [still], parts=1, failed=np.inf) as run:
        assert list(run.threads.map(abs, (-1, 2))) == [1, 2]
    with pytest.raises(RuntimeError, match="after shutdown"):
        run.threads.submit(abs, 1)
