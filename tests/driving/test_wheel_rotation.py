"""What the road does to the rotation of a wheel, and what encoder and bus make of it."""

from dataclasses import replace

import numpy as np
import pytest
from scipy import signal

from twintube import load
from twintube.common.arrays import Array
from twintube.driving import sensors
from twintube.driving.channels import PLACES
from twintube.driving.drives import driven
from twintube.driving.scenes import Conditions, Vehicle, Wear, inflated, scene
from twintube.driving.signals import Signals
from twintube.engine import compiled
from twintube.errors import InputError
from twintube.vehicle.cars import load_car
from twintube.vehicle.full.maneuvers import Road
from twintube.vehicle.full.rolling import ROLL_COLUMNS, ROLL_STATES, shrinking
from twintube.vehicle.full.run import DT, FullCar, Underway, drive_car, full_car, together
from twintube.vehicle.road import SPACING

SPEED = 25.0  # [m/s]
VEHICLE = Vehicle(load_car(), load("SA7"), load("SA8"), tooth=0.0, runout=0.0)


@pytest.fixture(scope="module")
def car() -> FullCar:
    return full_car(load_car(), [load("SA7")] * 2 + [load("SA8")] * 2)


def rolled(car: FullCar, load_share: Array, slope: Array, a_x: Array, stiff: float = 3e5) -> Array:
    """Spins and push of wheels that roll at SPEED under shares (n,) of their load at rest."""
    n = len(load_share)
    weights = np.array([wheel.weight for wheel in car.wheels])
    spin = np.full((n, 4), SPEED / car.wheels[0].radius)
    out = np.empty((n, ROLL_COLUMNS))
    compiled.module().roll_wheels(
        together(car.wheels), np.full(4, stiff), np.full(4, 500.0), load_share[:, None] * weights, np.tile(slope[:, None], 4),
        spin, np.zeros((n, 4)), a_x, DT, np.zeros((4, ROLL_STATES)), out,
    )  # fmt: skip
    return out


def test_on_a_smooth_road_nothing_is_added(car: FullCar) -> None:
    out = rolled(car, np.ones(100), np.zeros(100), np.zeros(100))
    assert np.all(out[:, :4] == SPEED / car.wheels[0].radius) and np.all(out[:, 4] == 0.0)


def test_a_wheel_under_more_load_turns_faster_by_its_rolling_radius(car: FullCar) -> None:
    out = rolled(car, np.full(4000, 1.2), np.zeros(4000), np.zeros(4000))
    for i, wheel in enumerate(car.wheels):
        rest, pressed = wheel.weight / wheel.F_nominal, 1.2 * wheel.weight / wheel.F_nominal
        radius = wheel.radius - wheel.F_nominal / wheel.c_tyre * (shrinking(pressed) - shrinking(rest))
        assert out[-1, i] == pytest.approx(SPEED / radius, rel=1e-6)
        assert 1e-5 < out[-1, i] * wheel.radius / SPEED - 1.0 < 3e-3


def test_a_wheel_swings_along_on_its_bushings(car: FullCar) -> None:
    kick = np.zeros(2000)
    kick[:5] = 10.0
    push = rolled(car, np.zeros(2000), np.zeros(2000), kick, stiff=4e5)[50:, 4]
    crossings = np.flatnonzero(np.diff(np.sign(push)))[:6]
    # Of wheels of two masses; their frequencies differ by 5 %.
    expected = np.mean([np.sqrt(4e5 / wheel.m_wheel) for wheel in car.wheels]) / (2.0 * np.pi)
    assert 0.5 / (np.mean(np.diff(crossings)) * DT) == pytest.approx(expected, rel=0.05)


def test_a_rise_pushes_the_body_back(car: FullCar) -> None:
    out = rolled(car, np.ones(3000), np.full(3000, 0.01), np.zeros(3000))
    assert out[-1, 4] == pytest.approx(-0.01 * sum(wheel.weight for wheel in car.wheels), rel=1e-3)


def test_a_soft_tyre_has_a_smaller_radius(car: FullCar) -> None:
    wheel = car.wheels[0]
    soft, same = (inflated(wheel, wheel.weight, share * 2.3e5) for share in (0.8, 1.0))
    assert soft.radius < wheel.radius and soft.c_tyre < wheel.c_tyre and same == wheel


def test_an_encoder_shows_the_speed_and_its_runout() -> None:
    turning, radius = 60.0, 0.31
    spin = np.full(40_000, turning)
    good = sensors.wheel_speed(spin, DT, sensors.Encoder(np.zeros(sensors.TEETH)), radius)
    assert len(good) == 4000
    # By half a step of the bus and two of the clock in 10 ms.
    assert np.abs(good[1:] - turning).max() <= 0.5 * sensors.WHEEL_SPEED / radius + 2e-4 * turning
    encoder = sensors.Encoder.drawn(np.random.default_rng(1), 0.0, 0.002)
    shown = sensors.wheel_speed(spin, DT, encoder, radius)
    time = np.arange(4000) * sensors.RASTER
    line = 2.0 * np.abs(np.mean((shown[1:] - turning) * np.exp(1j * turning * time[1:])))
    # A turn takes 0.1 s; a mean over 10 ms takes 1.6 % of its first order.
    assert line == pytest.approx(0.002 * turning, rel=0.05)


def test_a_standing_wheel_keeps_its_last_message() -> None:
    spin = np.concatenate([np.full(1000, 30.0), np.zeros(1000)])
    shown = sensors.wheel_speed(spin, DT, sensors.Encoder(np.zeros(sensors.TEETH)), 0.31)
    assert len(shown) == 200 and np.all(shown[110:] == shown[110])


def test_a_sensor_is_filtered_sampled_and_rounded() -> None:
    sensor = sensors.Inertial(18.0, 0.0, 0.05)
    time = np.arange(20_000) * DT
    random = np.random.default_rng(1)
    slow = sensors.sensed(np.sin(2 * np.pi * time), DT, sensor, random)
    assert len(slow) == 2000 and np.all(slow[::2] == slow[1::2])
    np.testing.assert_allclose(slow / 0.05, np.round(slow / 0.05), atol=1e-9)
    at_corner = sensors.sensed(np.sin(2 * np.pi * 18.0 * time), DT, sensor, random)
    assert np.sqrt(2.0) * at_corner[200:].std() == pytest.approx(np.sqrt(0.5), rel=0.05)


def test_a_drive_by_stretches_is_that_at_once(car: FullCar) -> None:
    heights = Road("C", 3).heights(car, 60.0)
    inputs = np.tile([0.0, 0.0, 15.0], (3000, 1))
    whole = drive_car(car, heights, SPACING, inputs, 15.0)
    way = Underway(car, heights, SPACING, 15.0)
    first, second = way.on(inputs[:1234]), way.on(inputs[1234:])
    for name in ("time", "spin", "load", "a_wheel", "damper_work"):
        np.testing.assert_array_equal(np.concatenate([getattr(first, name), getattr(second, name)]), getattr(whole, name))


def hop(signals: Signals, place: str) -> float:
    """Power of a wheel speed at wheel hop [rad2/s2]."""
    f, density = signal.welch(signals.values[f"wheel_speed_{place}_rad_per_s"], 100.0, nperseg=512)
    return float(density[(f >= 9.0) & (f <= 16.0)].mean())


def test_a_worn_damper_shows_in_the_speed_of_its_wheel() -> None:
    where = Conditions("C", 80.0, 30.0)
    good = driven(scene(VEHICLE, where, Wear()))
    worn = driven(scene(VEHICLE, where, Wear((1.0, 1.0, 0.4, 1.0), (1, 1, 0, 1))))
    ratios = {place: hop(worn, place) / hop(good, place) for place in PLACES}
    assert ratios["rl"] > 2.0 and max(ratios["fl"], ratios["fr"]) < 1.2
    assert worn.labels["wheels"]["rl"]["oil_level"] == 0.4
    again = driven(scene(VEHICLE, where, Wear()))
    assert all(np.array_equal(again.values[name], values) for name, values in good.values.items())


def test_a_car_that_leaves_the_road_is_said() -> None:
    wear = Wear((0.2,) * 4, (0,) * 4)
    with pytest.raises(InputError, match=r"off the ground|must stay within"):
        driven(scene(VEHICLE, Conditions("E", 130.0, 20.0), wear))
    with pytest.raises(InputError, match=r"oil_level \(rr\) = 1.2"):
        replace(wear, oil_level=(1.0, 1.0, 1.0, 1.2))
