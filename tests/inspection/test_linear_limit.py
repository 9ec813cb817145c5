"""The benches with a linear damper against the transfer function and the eigenvalues of the linear quarter car."""

from dataclasses import replace

import numpy as np
import pytest

from tests.inspection import linear
from tests.inspection.linear import SLOW, answer, linear_car, linear_damper
from twintube.dampers import load
from twintube.inspection import Plate, Setting, read
from twintube.inspection.benches import DT, after_bump, axle_acceleration, on_plate, plate_motion
from twintube.inspection.figures import ABOVE_BODY, measured_cycles
from twintube.vehicle.cars import load_car
from twintube.vehicle.drive import drive
from twintube.vehicle.quarter_car import static_load

DAMPINGS = (700.0, 1000.0, 1500.0, 2000.0)  # [N.s/m] from weak to strong, the wheel stays on the plate
STEADY = Setting(replace(SLOW, coast=600.0))


def test_the_plate_has_the_stated_motion():
    run = plate_motion(Plate(), DT)
    assert run.heights.max() == pytest.approx(3e-3, rel=1e-3)
    assert run.heights.min() == pytest.approx(-3e-3, rel=1e-3)
    assert run.frequency.max() == 25.0
    assert run.frequency[run.coasting][[0, -1]] == pytest.approx([25.0, 0.0], abs=0.01)
    assert np.gradient(run.heights, DT)[1:-1] == pytest.approx(run.rates[1:-1], abs=0.005 * run.rates.max())


@pytest.mark.parametrize("c", DAMPINGS)
def test_eusama_is_that_of_the_transfer_function(c):
    expected = linear.eusama(linear_car(), c, SLOW)
    read_off = read(linear_damper(c), linear_car(), ("eusama",), Setting(SLOW))["eusama"]
    # One per cent of the static force, of which the figure is a share.
    assert read_off == pytest.approx(expected, abs=1.0)
    assert 100 - read_off == pytest.approx(100 - expected, rel=0.01)


@pytest.mark.parametrize("c", DAMPINGS)
def test_force_and_phase_of_every_cycle_are_those_of_the_transfer_function(c):
    run = plate_motion(STEADY.plate, DT)
    found = measured_cycles(run, on_plate(linear_damper(c), linear_car(), run).wheel_load)
    used = (found.frequency >= ABOVE_BODY) & (found.frequency <= 20.0)
    expected = answer(linear_car(), c, found.frequency[used])
    assert np.abs(found.answer[used]) == pytest.approx(np.abs(expected), rel=0.01)
    assert found.phase[used] == pytest.approx(np.degrees(np.angle(expected)), abs=0.5)


@pytest.mark.parametrize("c", DAMPINGS)
def test_the_smallest_phase_is_that_of_the_transfer_function(c):
    run = plate_motion(STEADY.plate, DT)
    found = measured_cycles(run, on_plate(linear_damper(c), linear_car(), run).wheel_load)
    expected = linear.phase(linear_car(), c, np.linspace(ABOVE_BODY, found.wheel_frequency, 2000)).min()
    read_off = read(linear_damper(c), linear_car(), ("phase_shift",), STEADY)["phase_shift"]
    assert read_off == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize("c", DAMPINGS)
def test_the_fitted_damping_ratio_is_that_of_the_wheels_mode(c):
    """The body stands still in the fit, and moves a little in the mode: 2 %."""
    expected = linear.ratios(linear_car(), c)[1]
    assert read(linear_damper(c), linear_car(), ("damping_ratio",), Setting(SLOW))["damping_ratio"] == pytest.approx(
        expected, rel=0.02
    )


@pytest.mark.parametrize("c", DAMPINGS)
def test_the_decrement_of_the_push_down_is_that_of_the_bodys_mode(c):
    ratio = linear.ratios(linear_car(), c)[0]
    expected = 2 * np.pi * ratio / np.sqrt(1 - ratio**2)
    assert read(linear_damper(c), linear_car(), ("push_down",), Setting())["push_down"] == pytest.approx(expected, rel=0.01)


def test_more_damping_is_better_on_every_bench_up_to_a_ratio_of_a_third():
    methods = ("eusama", "damping_ratio", "push_down")
    rows = np.array([list(read(linear_damper(c), linear_car(), methods, Setting()).values()) for c in DAMPINGS])
    assert (np.diff(rows, axis=0) > 0).all()


def test_without_damping_every_figure_says_so():
    """The wheel leaves the plate, and the body swings on; the stops hold the damper."""
    car = replace(load_car().corner(load("SA8"), d_links=0.0, friction=0.0, d_tyre=0.0), F_rest=0.0)
    found = read(linear_damper(0.01), car, ("eusama", "phase_shift", "push_down"), Setting())
    assert found["eusama"] == 0.0
    assert found["phase_shift"] < 10.0
    assert found["push_down"] == pytest.approx(0.0, abs=0.1)


def test_a_locked_suspension_is_one_mass_on_the_tyre():
    """Body and wheel move as one: the resonance is that of the whole mass on the tyre, near 4 Hz."""
    car = linear_car(d_tyre=5000.0, c_body=1e6)
    car.c_body = 5e7
    run = plate_motion(STEADY.plate, DT)
    found = measured_cycles(run, on_plate(linear_damper(1500.0), car, run).wheel_load)
    w = 2 * np.pi * found.frequency
    tyre = car.c_tyre + 1j * w * car.d_tyre
    expected = tyre * (1 - tyre / (tyre - (car.m_body + car.m_wheel) * w**2))
    assert np.abs(expected).max() * STEADY.plate.amplitude < static_load(car), "the wheel stays on the plate"
    used = (found.frequency >= ABOVE_BODY) & (found.frequency <= 8.0)
    assert np.abs(found.answer[used]) == pytest.approx(np.abs(expected[used]), rel=0.01)


def test_an_upside_down_plate_turns_the_force_of_a_linear_corner_round():
    run, car = plate_motion(Plate(), DT), linear_car()
    down = drive(linear_damper(1500.0), car, -run.heights, DT, rates=-run.rates)
    up = drive(linear_damper(1500.0), car, run.heights, DT, rates=run.rates)
    assert up.wheel_load - static_load(car) == pytest.approx(static_load(car) - down.wheel_load, abs=0.5)


def test_the_axles_acceleration_is_the_change_of_its_velocity():
    """With an undamped tyre the height of the wheel follows from its load."""
    run, car = plate_motion(Plate(), DT), linear_car(d_tyre=0.0)
    result = on_plate(linear_damper(1500.0), car, run)
    wheel = run.heights - (result.wheel_load - static_load(car)) / car.c_tyre
    used = slice(5000, 15000)
    expected = np.gradient(np.gradient(wheel, DT), DT)[used]
    error = axle_acceleration(result, car)[used] - expected
    assert np.sqrt(np.mean(error**2)) < 0.05 * np.sqrt(np.mean(expected**2))


def test_a_strong_damper_leaves_less_ringing_behind_the_bump():
    rms = [np.sqrt(np.mean(after_bump(linear_damper(c), linear_car(), 8.0) ** 2)) for c in DAMPINGS[:3]]
    assert rms[0] > rms[1] > rms[2]
