"""The slip control: it cycles, knows the car's speed well enough, and takes no more out of the car than was in it."""

from dataclasses import replace

import numpy as np
import pytest

from twintube.dampers import load
from twintube.vehicle.cars import load_car
from twintube.vehicle.full.brakes import BUILD, HOLD, RECOVER, RELEASE, next_order, seen_speed
from twintube.vehicle.full.figures import braking_figures
from twintube.vehicle.full.maneuvers import APPROACH, Road, braking
from twintube.vehicle.full.run import CarRun, FullCar, full_car, started


@pytest.fixture(scope="module")
def passat() -> FullCar:
    front, rear = (load(name) for name in ("SA7", "SA8"))
    return full_car(load_car(), [front, front, rear, rear])


@pytest.fixture(scope="module")
def stop(passat: FullCar) -> CarRun:
    return braking(passat, 100.0, Road("smooth"))


def test_a_stop_from_100_lies_within_published_tests(passat: FullCar, stop: CarRun) -> None:
    assert 36.0 <= braking_figures(passat, stop)["stopping_distance_m"] <= 42.0


def test_every_wheel_cycles_several_times_a_second(stop: CarRun) -> None:
    on = (stop.time > APPROACH + 0.5) & (stop.v_x > 5.0)
    falls = np.diff(stop.pressure[on], axis=0) < 0.0
    releases = (np.diff(falls.astype(int), axis=0) == 1).sum(axis=0)
    seconds = stop.time[on][-1] - stop.time[on][0]
    assert np.all((releases / seconds > 2.0) & (releases / seconds < 15.0))


def test_the_energy_of_a_stop_is_that_of_the_car(passat: FullCar, stop: CarRun) -> None:
    begin = int(np.searchsorted(stop.time, APPROACH))
    spins = 0.5 * sum(w.I_spin * spin**2 for w, spin in zip(passat.wheels, stop.spin[begin], strict=True))
    energy = 0.5 * passat.mass * stop.v_x[begin] ** 2 + spins
    assert stop.work[begin] - stop.work[-1] == pytest.approx(energy, rel=1e-3)


@pytest.mark.parametrize("grip", [1.0, 0.6, 0.3])
def test_no_wheel_locks_and_the_grip_is_used(passat: FullCar, grip: float) -> None:
    run = braking(passat, 70.0, Road("smooth", grips=(grip, grip)))
    assert np.mean(-run.slip_x[(run.time > APPROACH) & (run.v_x > 3.0)] > 0.5) < 0.02
    most = min(w.most_x / w.F_nominal for w in passat.wheels) * 9.81 * grip
    assert braking_figures(passat, run)["deceleration_m_s2"] > 0.75 * most


def test_orders_follow_slip_and_rim(passat: FullCar) -> None:
    h = passat.brakes
    assert next_order(h, BUILD, 0.03, -h.fall - 1.0) == HOLD
    assert next_order(h, HOLD, h.slip_release + 0.01, -5.0) == RELEASE
    assert next_order(h, RELEASE, 0.4, 0.0) == RELEASE  # a locked wheel is released until it turns faster
    assert next_order(h, RELEASE, 0.4, h.rise + 1.0) == RECOVER
    assert next_order(h, RECOVER, 0.5 * h.slip_build, h.rise + 1.0) == BUILD


def test_the_estimated_speed_follows_the_second_fastest_rim_and_the_accelerometer(passat: FullCar) -> None:
    exact = replace(passat.brakes, drift=0.0)
    body, _ = started(passat, 20.0)
    body.a_x = -8.0
    for rims in ((20.0, 3.0, 2.0, 1.0), (2.0, 3.0, 1.0, 25.0)):
        body.seen = 20.0
        for _ in range(100):
            seen_speed(exact, body, *rims, 1e-3)
        assert body.seen == pytest.approx(20.0 - 0.8)
    seen_speed(exact, body, 25.0, 24.0, 1.0, 1.0, 1e-3)
    assert body.seen < 20.0  # rims that run ahead are followed slowly
