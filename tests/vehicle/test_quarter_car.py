"""The quarter car against frequency-domain theory, physics and its own step."""

from pathlib import Path

import fmpy
import numpy as np
import pytest

import build_fmu
from twintube import quarter_car, road
from twintube.drive import drive
from twintube.parameters import Damper, continued, load
from twintube.quarter_car import GRAVITY, PASSAT_REAR, Car, static_load
from vehicle_demo.measures import measures
from vehicle_demo.ride import Case, Ride, heights, ride

DT = 1e-3
SPEED = 50 / 3.6
C_DAMPER = 1500.0  # [N.s/m]


def linear_damper() -> Damper:
    """A damper without friction and gas whose F-v curve is a straight line."""
    points = continued([(0.5, 0.5 * C_DAMPER), (1.0, C_DAMPER)])
    v, F = [p[0] for p in points], [p[1] for p in points]
    return load("SA8").with_(v_re=v, F_re=F, v_co=v, F_co=F, F_FrS=0.0, F_0=0.0, c_gas=0.0)


def linear_car() -> dict[str, float]:
    return PASSAT_REAR | {"travel": 10.0}


def analytic_dlc(profile: road.Road, scale: float) -> float:
    """Standard deviation of the wheel load over the static load, from the transfer function at the road's own waves."""
    car = linear_car()
    count = len(profile.enveloped)
    n = np.fft.rfftfreq(count, road.SPACING)[1:]
    waves = np.fft.rfft(profile.enveloped)[1:] / count * 2 * scale
    w = 2 * np.pi * n * SPEED
    c, k, kt = C_DAMPER + car["d_links"], car["c_body"], car["c_tyre"] + 1j * w * car["d_tyre"]
    suspension = k + 1j * w * c
    body = suspension / (suspension - w**2 * car["m_body"])  # body over wheel
    wheel = kt / (kt - w**2 * car["m_wheel"] + suspension * (1 - body))  # wheel over road
    load = kt * (1 - wheel) * waves
    static = (car["m_body"] + car["m_wheel"]) * GRAVITY
    return float(np.sqrt(0.5 * np.sum(np.abs(load) ** 2)) / static)


def smooth_road_run(profile: road.Road, dt: float, scale: float) -> np.ndarray:
    """Heights over two periods of the road; the second one is the steady state."""
    time = np.arange(0, 2 * profile.length / SPEED, dt)
    return scale * profile.at(time * SPEED) * np.clip(time, 0, 1)


def test_linear_damper_gives_the_analytic_dlc() -> None:
    profile, scale = road.generate(300, seed=5), 0.25
    run = drive(linear_damper(), linear_car(), smooth_road_run(profile, DT, scale), DT)
    second = run.time >= profile.length / SPEED
    car = linear_car()
    static = (car["m_body"] + car["m_wheel"]) * GRAVITY
    assert run.wheel_load.min() > 0
    assert run.wheel_load[second].std() / static == pytest.approx(analytic_dlc(profile, scale), rel=0.01)


def test_linear_damper_as_fmu_gives_the_analytic_dlc(tmp_path: Path) -> None:
    profile, scale = road.generate(300, seed=5), 0.25
    damper = linear_damper()
    fmu = build_fmu.build(damper, tmp_path / "linear.fmu", platforms=(fmpy.platform,))
    car = Car(**linear_car(), F_rest=0.0)
    found = ride(fmu, car, Case(50, 1.0, 1), smooth_road_run(profile, DT, scale), DT)
    second = found.time >= profile.length / SPEED
    assert found.wheel_load[second].std() / static_load(car) == pytest.approx(analytic_dlc(profile, scale), rel=0.01)


@pytest.mark.parametrize("oil_level", [1.0, 0.9, 0.6, 0.4])
@pytest.mark.parametrize("speed", [30.0, 50.0])
def test_halving_the_step_changes_the_dlc_by_less_than_one_percent(sa8_native: Path, oil_level: float, speed: float) -> None:
    car = Car(**PASSAT_REAR, F_rest=-load("SA8").parameters.F_0)
    case = Case(speed, oil_level, 0)
    found = []
    for dt in (1e-3, 5e-4):
        result = ride(sa8_native, car, case, heights(case, 30.0, dt, seed=2), dt)
        found.append(measures(result, static_load(car))["dlc"])
    assert found[0] == pytest.approx(found[1], rel=0.01)


def test_wheel_leaves_the_road_and_never_pulls(sa8_native: Path) -> None:
    car = Car(**PASSAT_REAR, F_rest=-load("SA8").parameters.F_0)
    case = Case(50.0, 0.3, 0)
    result = ride(sa8_native, car, case, heights(case, 20.0, DT, seed=1), DT)
    assert result.wheel_load.min() == 0.0
    found = measures(result, static_load(car))
    assert found["contact_losses"] > 0
    assert 0 < found["contact_loss_share"] < 0.5


def test_car_at_rest_stays_at_rest(sa8_native: Path) -> None:
    car = Car(**PASSAT_REAR, F_rest=-load("SA8").parameters.F_0)
    result = ride(sa8_native, car, Case(30.0, 1.0, 1), np.zeros(2000), DT)
    assert np.abs(result.stroke).max() < 2e-4  # what friction of the preconditioning leaves
    assert result.wheel_load[-1] == pytest.approx(static_load(car), rel=0.01)


def test_energy_of_the_road_is_dissipated_or_stored() -> None:
    """Over a whole ride the tyre's work on the car is what damper, links and stops took, within the discretisation."""
    damper = load("SA8")
    car = linear_car() | {"d_tyre": 0.0}
    height = heights(Case(50.0, 1.0, 1), 30.0, DT, seed=3) * 0.5
    run = drive(damper, car, height, DT)
    static = (car["m_body"] + car["m_wheel"]) * GRAVITY
    spring = run.wheel_load - static
    assert run.wheel_load.min() > 0
    # Tyre deflection from its force; the rest of the road's motion is the wheel's.
    wheel = height - spring / car["c_tyre"]
    into_car = np.sum(0.5 * (spring[1:] + spring[:-1]) * np.diff(wheel))
    force = 0.5 * (run.force[1:] + run.force[:-1]) + damper.parameters.F_0
    links = car["d_links"] * np.sum(run.velocity**2) * DT
    taken = np.sum(force * np.diff(run.stroke)) + links
    stored = 0.5 * car["c_body"] * run.stroke[-1] ** 2 + 0.5 * car["m_body"] * 1.0**2
    assert into_car == pytest.approx(taken, abs=0.02 * taken + stored)


def test_oil_loss_raises_the_wheel_load_fluctuation_and_it_grows_during_the_ride(sa8_native: Path) -> None:
    car = Car(**PASSAT_REAR, F_rest=-load("SA8").parameters.F_0)

    def of(level: float, preload: int) -> tuple[Ride, dict]:
        case = Case(50.0, level, preload)
        result = ride(sa8_native, car, case, heights(case, 60.0, DT, seed=1), DT)
        return result, measures(result, static_load(car))

    _, intact = of(1.0, 1)
    result, degraded = of(0.6, 0)
    assert degraded["dlc"] > 1.1 * intact["dlc"]
    power = [w["damping_work_J"] for w in degraded["development"]]
    assert power[-1] < 0.5 * power[0]
    oil = [w["oil_mL"] for w in degraded["development"]]
    assert oil[-1] < oil[0]
    assert result.volumes.shape == (len(result.time[::20]), 9)


def test_stops_only_push() -> None:
    car = Car(**PASSAT_REAR, F_rest=0.0)
    assert quarter_car.stop_force(car, -0.01, 1.0) == 0.0
    assert quarter_car.stop_force(car, 0.01, -50.0) == 0.0
    assert quarter_car.stop_force(car, 0.01, 0.0) == pytest.approx(1e9 * 1e-6)
