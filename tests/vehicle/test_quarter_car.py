"""The quarter car against frequency-domain theory, energy balance and a halved step."""

from pathlib import Path

import fmpy
import numpy as np
import pytest

from twintube.core.variables import blank
from twintube.dampers import Damper, ParameterError, load
from twintube.dampers.curve import continued
from twintube.demo.ride import Ride, RideCase, ride
from twintube.fmu import build_fmu
from twintube.vehicle import quarter_car
from twintube.vehicle.cars import FOLDER, RUBBER, load_car
from twintube.vehicle.drive import drive
from twintube.vehicle.quarter_car import REACH, Car, Motion, leapfrog_step, rub, static_load
from twintube.vehicle.ride import Track, measures, track
from twintube.vehicle.ride import ride as ride_compiled

DT = 1e-3
SPEED = 50 / 3.6
C_DAMPER = 1500.0  # [N.s/m]


@pytest.fixture(scope="module")
def fmu_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The FMU of SA8 as `build_fmu.py` makes it."""
    return build_fmu(load("SA8"), tmp_path_factory.mktemp("fmu") / "SA8.fmu", platforms=(fmpy.platform,))


def rear(**changes: float) -> Car:
    return load_car().corner(load("SA8"), **changes)


def linear_damper() -> Damper:
    """A damper without friction and gas whose F-v curve is a straight line."""
    points = continued([(0.5, 0.5 * C_DAMPER), (1.0, C_DAMPER)])
    v, F = [p[0] for p in points], [p[1] for p in points]
    return load("SA8").with_(v_re=v, F_re=F, v_co=v, F_co=F, F_FrS=0.0, F_0=0.0, c_gas=0.0)


def linear_car() -> Car:
    car = rear()
    car.friction, car.travel, car.F_rest = 0.0, 10.0, 0.0
    return car


WAVES = (0.05, 0.11, 0.23, 0.47, 0.83, 1.27)  # [cycles/m], from the body's to beyond the wheel's resonance


def waves(time: np.ndarray, scale: float = 0.002) -> np.ndarray:
    """A road of a few sines, which begins at 0 and fades in."""
    heights = sum(scale * 0.1 / n * np.sin(2 * np.pi * n * SPEED * time + 7.0 * n) for n in WAVES)
    return np.asarray((heights - heights[0]) * np.clip(time, 0, 1))


def analytic_dlc(car: Car, scale: float = 0.002) -> float:
    """Standard deviation of the wheel load over the static load, from the transfer function at the road's own waves."""
    power = 0.0
    for n in WAVES:
        w = 2 * np.pi * n * SPEED
        c, k, kt = C_DAMPER * car.ratio**2 + car.d_links, car.c_body, car.c_tyre + 1j * w * car.d_tyre
        suspension = k + 1j * w * c
        body = suspension / (suspension - w**2 * car.m_body)  # body over wheel
        wheel = kt / (kt - w**2 * car.m_wheel + suspension * (1 - body))  # wheel over road
        power += 0.5 * abs(kt * (1 - wheel) * scale * 0.1 / n) ** 2
    return float(np.sqrt(power) / static_load(car))


def steady(load: np.ndarray, time: np.ndarray, car: Car) -> float:
    """DLC over the last 72 s: whole periods of every wave, as 100 m are."""
    return float(load[time >= time[-1] - 72.0 + DT].std() / static_load(car))


def test_linear_damper_gives_the_analytic_dlc() -> None:
    time = np.arange(0, 82.0, DT)
    run = drive(linear_damper(), linear_car(), waves(time), DT)
    assert run.wheel_load.min() > 0
    assert steady(run.wheel_load, time, linear_car()) == pytest.approx(analytic_dlc(linear_car()), rel=0.01)


def test_linear_damper_as_fmu_gives_the_analytic_dlc(tmp_path: Path) -> None:
    time = np.arange(0, 82.0, DT)
    heights = waves(time)
    fmu = build_fmu(linear_damper(), tmp_path / "linear.fmu", platforms=(fmpy.platform,))
    result = ride(fmu, linear_car(), RideCase(50, 1.0, 1), Track(50.0, DT, heights, np.gradient(heights, DT)))
    assert steady(result.wheel_load, time, linear_car()) == pytest.approx(analytic_dlc(linear_car()), rel=0.01)


@pytest.mark.parametrize("oil_level", [1.0, 0.9, 0.6, 0.4])
@pytest.mark.parametrize("speed", [30.0, 50.0])
def test_halving_the_step_changes_the_dlc_by_less_than_one_percent(oil_level: float, speed: float) -> None:
    """A wheel that leaves the road without damping moves chaotically: one percent, or twice the standard error over twelve roads."""
    car, state = rear(), load("SA8").with_(oil_level=oil_level, gas_preload=0)
    coarse, fine = np.array([
        [measures(ride_compiled(state, car, track(speed, 60.0, seed=seed, dt=dt)), car)["dlc"] for seed in range(1, 13)]
        for dt in (1e-3, 5e-4)
    ])  # fmt: skip
    change = coarse / fine - 1
    assert abs(change.mean()) < max(0.01, 2 * change.std() / np.sqrt(len(change)))


@pytest.mark.parametrize(("level", "preload"), [(1.0, 1), (0.8, 0), (0.4, 0)])
def test_the_fmu_and_the_compiled_damper_give_the_same_bits(fmu_file: Path, level: float, preload: int) -> None:
    route = track(50.0, 20.0)
    by_fmu = ride(fmu_file, rear(), RideCase(50.0, level, preload), route)
    compiled = ride_compiled(load("SA8").with_(oil_level=level, gas_preload=preload), rear(), route)
    assert np.array_equal(by_fmu.wheel_load, compiled.wheel_load)
    assert np.array_equal(by_fmu.force, compiled.force)


def test_wheel_leaves_the_road_and_never_pulls(fmu_file: Path) -> None:
    car = rear()
    case = RideCase(50.0, 0.3, 0)
    result = ride(fmu_file, car, case, track(50.0, 20.0))
    assert result.wheel_load.min() == 0.0
    figures = measures(result, car)
    assert figures["contact_losses"] > 0
    assert 0 < figures["contact_loss_share"] < 0.5


def test_car_at_rest_stays_at_rest(fmu_file: Path) -> None:
    car = rear()
    result = ride(fmu_file, car, RideCase(30.0, 1.0, 1), Track(30.0, DT, np.zeros(2000), np.zeros(2000)))
    assert np.abs(result.stroke).max() < 2e-4  # offset that the friction of the preconditioning leaves
    assert result.wheel_load[-1] == pytest.approx(static_load(car), rel=0.01)


def rubbed(most: float, strokes: np.ndarray) -> np.ndarray:
    """Friction [N] at each stroke [m] of a wheel that begins at rest at the first one."""
    forces = [0.0]
    for way in np.diff(strokes).tolist():
        forces.append(rub(most, forces[-1], way))
    return np.array(forces)


@pytest.mark.parametrize("amplitude", [0.5 * REACH, 2.0 * REACH, 5e-3])
@pytest.mark.parametrize("steps", [20, 2000])
def test_a_loop_of_friction_has_the_area_of_a_spring_with_a_slider(amplitude: float, steps: int) -> None:
    """Four times force and slid way, whatever the step; nothing while the spring alone gives way."""
    quarter = np.linspace(0.0, amplitude, steps + 1)
    strokes = np.concatenate([quarter, np.tile(np.concatenate([quarter[::-1], -quarter, -quarter[::-1], quarter]), 2)])
    forces = rubbed(100.0, strokes)
    last = slice(-4 * steps - 4, None)  # a whole cycle after a first one
    work = np.sum(0.5 * (forces[last][1:] + forces[last][:-1]) * np.diff(strokes[last]))
    # With few steps the corner of the loop falls between two of them.
    assert work == pytest.approx(400.0 * max(amplitude - REACH, 0.0), rel=0.01, abs=400.0 * amplitude / steps)
    assert np.abs(forces).max() <= 100.0


def test_a_body_that_only_friction_brakes_swings_out_in_a_straight_line() -> None:
    """Coulomb's free vibration: each swing is smaller by 4 F / c, and friction has taken all the energy that is gone."""
    car = linear_car()
    car.d_links, car.d_tyre, car.c_tyre, car.friction = 0.0, 0.0, 5e6, 100.0
    m, heights, strokes = blank(Motion), [0.05], [0.05]
    m.z_body = 0.05
    for _ in range(6000):
        leapfrog_step(car, m, 0.0, 0.0, 0.0, 0.0, DT)
        heights.append(m.z_body)
        strokes.append(m.z_body - m.z_wheel)
    z, stroke = np.array(heights), np.array(strokes)
    slip = car.friction / car.c_body
    peaks = z[1:-1][(z[1:-1] > z[:-2]) & (z[1:-1] >= z[2:]) & (z[1:-1] > 2.0 * slip)]
    assert len(peaks) >= 2
    assert -np.diff(np.array([0.05, *peaks])) == pytest.approx(4.0 * slip, rel=0.1), "REACH takes 2 %, the tyre gives way"
    assert abs(z[-1000:].mean()) <= 1.01 * slip
    forces = rubbed(car.friction, stroke)
    slid = np.sum(0.5 * (forces[1:] + forces[:-1]) * np.diff(stroke))
    body, wheel = m.v_body + 0.5 * m.dv_body, m.v_wheel + 0.5 * m.dv_wheel
    left = car.m_body * body**2 + car.m_wheel * wheel**2 + car.c_body * stroke[-1] ** 2 + car.c_tyre * m.z_wheel**2
    assert 0.5 * (car.c_body * 0.05**2 - left) == pytest.approx(slid, rel=1e-3)


@pytest.mark.parametrize("friction", [0.0, 50.0, 150.0])
def test_energy_of_the_road_is_dissipated_or_stored(friction: float) -> None:
    """Over a whole ride the tyre's work on the car is that of damper, links and friction, within the discretisation."""
    damper = load("SA8")
    car = rear(d_tyre=0.0, friction=friction)
    car.travel = 10.0
    height = track(50.0, 30.0, seed=3).heights * 0.4
    run = drive(damper, car, height, DT)
    static = static_load(car)
    spring = run.wheel_load - static
    assert run.wheel_load.min() > 0
    # Tyre deflection from its force; the rest of the road's motion is the wheel's.
    wheel = height - spring / car.c_tyre
    into_car = np.sum(0.5 * (spring[1:] + spring[:-1]) * np.diff(wheel))
    force = 0.5 * (run.force[1:] + run.force[:-1]) + damper.parameters.F_0
    links = car.d_links * np.sum((run.velocity / car.ratio) ** 2) * DT
    rubs = rubbed(friction, run.stroke / car.ratio)
    slid = np.sum(0.5 * (rubs[1:] + rubs[:-1]) * np.diff(run.stroke / car.ratio))
    dissipated = np.sum(force * np.diff(run.stroke)) + links + slid
    stored = 0.5 * car.c_body * (run.stroke[-1] / car.ratio) ** 2 + 0.5 * car.m_body * 1.0**2
    assert into_car == pytest.approx(dissipated, abs=0.02 * dissipated + stored)


def test_oil_loss_raises_the_wheel_load_fluctuation_and_it_grows_during_the_ride(fmu_file: Path) -> None:
    car = rear()

    def ridden(level: float, preload: int) -> Ride:
        return ride(fmu_file, car, RideCase(50.0, level, preload), track(50.0, 60.0))

    intact, result = ridden(1.0, 1), ridden(0.6, 0)
    degraded = measures(result, car, intact)
    assert degraded["dlc"] > 1.1 * measures(intact, car)["dlc"]
    power = degraded["damping_work_window_J"]
    assert power[-1] < 0.7 * power[0]
    assert degraded["oil_mL_window_end"][-1] < degraded["oil_mL_window_end"][0]
    assert degraded["time_to_failure_s"] is not None
    assert measures(intact, car, intact)["time_to_failure_s"] is None
    assert result.volumes.shape == (len(result.time[::20]), 9)


@pytest.mark.parametrize("name", ["SA7", "SA8"])
@pytest.mark.parametrize("level", [1.0, 0.4])
def test_the_stops_hold_the_damper_within_its_stroke(name: str, level: float) -> None:
    damper = load(name)
    run = ride_compiled(damper.with_(oil_level=level, gas_preload=0), load_car().corner(damper), track(70.0, 120.0))
    assert np.abs(run.stroke).max() < damper.parameters.stroke_max


def test_stops_begin_earlier_for_a_damper_with_a_short_stroke() -> None:
    car = load_car().corner(load("SA1"))
    assert car.ratio * (car.travel + RUBBER) == pytest.approx(load("SA1").parameters.stroke_max, abs=0.003)


def test_a_longer_ride_starts_with_the_bits_of_a_shorter_one() -> None:
    car, state = rear(), load("SA8").with_(oil_level=0.6, gas_preload=0)
    short, long = (ride_compiled(state, car, track(50.0, seconds)) for seconds in (60.0, 600.0))
    n = len(short.time)
    for start, whole in ((short.wheel_load, long.wheel_load), (short.force, long.force), (short.oil, long.oil)):
        assert np.array_equal(start, whole[:n])


def test_every_defect_of_a_car_is_named_with_its_line(tmp_path: Path) -> None:
    text = (FOLDER / "passat_b8.toml").read_text(encoding="utf-8")
    path = tmp_path / "car.toml"
    path.write_text(
        text.replace('m_body = "405 kg"', 'm_body = "405 mm"')
        .replace("ratio = 0.9\n", "ratio = 9\nroof = 1\n")
        .replace('friction = "25 N"\n', "", 1)
    )
    with pytest.raises(ParameterError) as caught:
        load_car(path)
    message = str(caught.value)
    assert "line 6: front.m_body" in message
    assert "rear.ratio = 9: must be a number from 0.2 to 1.5" in message
    assert "unknown rear.roof" in message
    assert "front.friction is missing: must be from 0 to 1000 N" in message
    with pytest.raises(ParameterError, match="unknown car saab: neither a file nor one of escort, passat_b8"):
        load_car("saab")


def test_stops_only_push() -> None:
    car = rear()
    assert quarter_car.stop_force(car.c_stop, car.d_stop, -0.01, 1.0) == 0.0
    assert quarter_car.stop_force(car.c_stop, car.d_stop, 0.01, -50.0) == 0.0
    assert quarter_car.stop_force(car.c_stop, car.d_stop, 0.01, 0.0) == pytest.approx(1e9 * 1e-6)
