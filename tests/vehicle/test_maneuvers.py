"""The standards' manoeuvres: symmetry, single-track theory, what one worn wheel and unequal grip do."""

from dataclasses import replace

import numpy as np
import pytest

from twintube.dampers import load
from twintube.vehicle.cars import load_car
from twintube.vehicle.full import standards
from twintube.vehicle.full.catalogue import MANEUVERS, STANDARDS, Case
from twintube.vehicle.full.figures import braking_figures
from twintube.vehicle.full.lane_change import corners, entry_of, excess, lane_change, lanes, width_of
from twintube.vehicle.full.maneuvers import Road, braking
from twintube.vehicle.full.run import FullCar, Pursuit, drive_car, full_car
from twintube.vehicle.full.study import dampers_of, figures_of
from twintube.vehicle.road import SPACING

SMOOTH = Road("smooth")


def car_with(worn: str, level: float) -> FullCar:
    return full_car(
        load_car(),
        dampers_of(load("SA7"), load("SA8"), worn, Case("ride", 80.0, "C", 1, level, gas_preload=int(level == 1.0))),
    )


@pytest.fixture(scope="module")
def passat() -> FullCar:
    return car_with("all", 1.0)


def single_track_understeer(car: FullCar) -> float:
    """Understeer gradient [deg/g] from cornering stiffnesses at the static load and the steer compliance.

    m b / (l c_front) - m a / (l c_rear) of the axles, written with the axle loads; apart from the car's own equations.
    """
    slips = []
    for w in (car.wheels[0], car.wheels[2]):
        x = w.weight / w.F_nominal
        stiffness = x * (2 * w.rise_y - w.rise_y2 / 2 - (w.rise_y - w.rise_y2 / 2) * x)
        slips.append(w.weight / stiffness + w.steer_compliance * w.weight)
    return float(np.degrees(slips[0] - slips[1]))


def test_the_circle_has_the_gradients_of_the_single_track_model(passat: FullCar) -> None:
    slow = MANEUVERS["circle"].drive(passat, Case("circle", 60.0, "smooth", 1))
    on = (slow.time > standards.TURN_APPROACH) & (slow.a_y > 1.0) & (slow.a_y < 1.8)
    ackermann = passat.body.wheelbase * slow.yaw_rate / slow.v_x
    gradient = np.degrees(np.polyfit(slow.a_y[on] / 9.80665, (slow.steer - ackermann)[on], 1)[0])
    # Drag and its drive torque, load transfer and the tyre's bend are not in the single track model.
    assert gradient == pytest.approx(single_track_understeer(passat), abs=0.25)
    radius = slow.v_x[on] / slow.yaw_rate[on]
    assert np.abs(radius - standards.RADIUS).max() < 0.02 * standards.RADIUS
    figures = figures_of(passat, Case("circle", 90.0, "smooth", 1))
    assert figures["understeer_deg_per_g"] == pytest.approx(3.6, abs=0.15)  # the car's file sets this
    assert 3.0 < figures["roll_deg_per_g"] < 7.0


def test_a_step_of_the_steer_is_answered_as_by_usual_cars(passat: FullCar) -> None:
    intact = figures_of(passat, Case("step_steer", 80.0, "smooth", 1))
    assert intact["steady_lateral_acceleration_m_s2"] == pytest.approx(standards.STEP_LATERAL, rel=0.03)
    assert 0.1 < intact["yaw_rate_t90_s"] < 0.3
    # A second measure of the gain: the single-track model with the gradient of the circle.
    speed, base = 80.0 / 3.6, passat.body.wheelbase
    assert intact["yaw_rate_gain_1_s"] == pytest.approx(speed / (base + np.radians(3.62) / 9.80665 * speed**2), rel=0.03)
    worn = figures_of(car_with("all", 0.3), Case("step_steer", 80.0, "smooth", 1, 0.3))
    assert worn["roll_peak_ratio"] > intact["roll_peak_ratio"] + 0.1
    assert worn["yaw_rate_gain_1_s"] == pytest.approx(intact["yaw_rate_gain_1_s"], rel=0.01)


def test_left_and_right_are_mirrored(passat: FullCar) -> None:
    road, n = SMOOTH.heights(passat, 200.0), 4000
    path = standards.circle_path(15.0, 200.0)
    runs = []
    for sign in (1.0, -1.0):
        inputs = np.zeros((n, 3))
        inputs[:, 2], inputs[2500:, 1] = 15.0, 4e6
        inputs[:, 0] = sign * 0.01 * np.sin(np.arange(n) / 300.0)
        runs.append(drive_car(passat, road, SPACING, inputs, 15.0, pursuit=Pursuit(path * [1.0, sign]),
                              grips=(0.8, 0.6)[:: int(sign)]))  # fmt: skip
    for name in ("y", "yaw", "roll", "steer"):
        left, right = (getattr(run, name) for run in runs)
        assert np.abs(left + right).max() <= 1e-9 * np.abs(left).max(), name
    assert np.abs(runs[0].x - runs[1].x).max() < 1e-9


def test_a_stop_on_unequal_grip_turns_the_car_to_the_side_that_grips(passat: FullCar) -> None:
    for grips, sign in (((1.0, 0.6), 1.0), ((0.6, 1.0), -1.0)):
        figures = braking_figures(passat, braking(passat, 60.0, Road("smooth", grips=grips)))
        assert sign * figures["heading_deg"] > 3.0
    dry, wet = (braking_figures(passat, braking(passat, 60.0, Road("smooth", grips=(g, g)))) for g in (1.0, 0.5))
    assert wet["stopping_distance_m"] == pytest.approx(dry["stopping_distance_m"] / 0.5, rel=0.15)
    assert wet["heading_deg"] == pytest.approx(0.0, abs=1e-9)


def test_one_worn_wheel_turns_a_stop_aside_and_all_four_do_not() -> None:
    one, other, all_four = (
        braking_figures(car, braking(car, 80.0, SMOOTH))
        for car in (car_with("rear_left", 0.4), car_with("rear_right", 0.4), car_with("all", 0.4))
    )
    assert one["yaw_rate_max_deg_s"] > 0.5 and abs(one["heading_deg"]) > 0.1
    assert one["heading_deg"] == pytest.approx(-other["heading_deg"], rel=1e-6)
    assert all_four["yaw_rate_max_deg_s"] < 1e-9


def test_the_lanes_are_those_of_the_standard_and_a_slow_car_keeps_in_them(passat: FullCar) -> None:
    width = width_of(passat)
    first, third, fifth = lanes(width)
    assert fifth.end == 61.0  # ISO 3888-2, clause 4.1
    assert first.left - first.right == pytest.approx(1.1 * width + 0.25)
    assert third.right - first.left == pytest.approx(1.0)
    run = lane_change(passat, 60.0, SMOOTH)
    assert excess(passat, run, entry_of(60.0 / 3.6)) < 0.0
    x, y = corners(passat, run)
    assert np.hypot(x[:, 0] - x[:, 1], y[:, 0] - y[:, 1]) == pytest.approx(width)
    assert excess(passat, lane_change(passat, 90.0, SMOOTH), entry_of(25.0)) > 0.0


def test_a_car_without_grip_at_the_rear_fails_the_sine_and_the_lanes(passat: FullCar) -> None:
    """The figures see what they are for: a rear axle of 40 % less grip turns the car round."""
    bad = {name: getattr(passat.wheels[2], name) * 0.6 for name in ("most_y", "most_y2", "slide_y", "slide_y2")}
    wheels = (*passat.wheels[:2], *(replace(w, **bad) for w in passat.wheels[2:]))
    loose = replace(passat, wheels=wheels)
    good, poor = (figures_of(car, Case("sine_with_dwell", 80.0, "smooth", 1)) for car in (passat, loose))
    assert good["amplitude_passed_A"] >= 5.0 > (poor["amplitude_passed_A"] or 0.0)
    assert abs(good["yaw_ratio_1_s"]) < 0.35 and good["displacement_1.07_s_m"] > 1.83
    assert poor["side_slip_max_deg"] > 2.0 * good["side_slip_max_deg"]


def test_braking_in_a_turn_begins_on_the_circle(passat: FullCar) -> None:
    run = standards.braking_in_turn(passat, 70.0, SMOOTH)
    at = int(np.searchsorted(run.time, standards.TURN_APPROACH)) - 1
    assert run.v_x[at] / run.yaw_rate[at] == pytest.approx(standards.RADIUS, rel=0.01)
    assert np.all(run.steer[at + 1 :] == run.steer[at + 1])
    assert run.v_x[-1] == pytest.approx(0.0, abs=0.2)


@pytest.mark.parametrize("name", STANDARDS)
def test_every_manoeuvre_has_the_figures_it_compares(passat: FullCar, name: str) -> None:
    each = MANEUVERS[name]
    figures = figures_of(passat, Case(name, each.speeds[0], "smooth", 1))
    assert all(figures[key] is not None for key, _, _ in (each.headline, *each.beside))
