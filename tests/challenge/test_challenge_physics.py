"""Each hidden cause follows its physics; nothing hidden is the kernel's own force."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from twintube.arrays import Array
from twintube.dampers import load
from twintube.engine.simulate import simulate
from twintube.lab.challenge import fluid, mechanics, oil, sensors
from twintube.lab.challenge.excitation import STYLES, Order, motion
from twintube.lab.challenge.run import Record, Run, Step, begun, copied, finished, marched
from twintube.lab.challenge.sampling import taken

DAMPER = load("SA8", as_published=True)
SIGN = {"sign": 1.0, "reach": 0.045}


@cache
def base(level: float = 1.0, speed: float = 0.524, count: int = 4, scale: float = 1.0, rest: float = 0.0) -> Run:
    order = Order("amplitude", speed, 0.045, 0.05, 2, rest, 0.0, False, count, 1)
    record = Record("r", 0, level, level == 1.0, speed, "harmonic", 23.0, 0.0)
    return finished(marched(begun(record, motion(order, 1e-3, scale), DAMPER)), [])


def with_(run: Run, apply: Callable[..., None], x: float, stage: str = "forces", **constants: object) -> Run:
    start = begun(run.record, run.motion, DAMPER) if stage == "setup" else copied(run)
    return finished(start, [Step(stage, apply, x, constants)])


def rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))


def block(run: Run) -> slice:
    """The samples after the preconditioning."""
    return slice(int(np.argmax(np.abs(run.motion.velocity) > 0.06)), None)


@pytest.mark.parametrize("level", [1.0, 0.5])
def test_nothing_hidden_is_the_kernel(level: float) -> None:
    run = base(level)
    told = simulate(DAMPER.with_(oil_level=level, gas_preload=int(level == 1.0)), run.motion.stroke, run.motion.velocity)
    assert np.array_equal(run.force, told.force)


def test_steps_are_fine_enough() -> None:
    coarse, fine = base(0.5), base(0.5, scale=0.25)
    at = np.linspace(coarse.time[0], coarse.time[-1] * 0.999, 5000)
    change = np.interp(at, coarse.time, coarse.parts["k_degr"]) - np.interp(at, fine.time, fine.parts["k_degr"])
    assert abs(change.mean()) < 1e-3 and np.mean(np.abs(change) > 0.02) < 0.01


@pytest.mark.parametrize("style", STYLES)
def test_motions_stay_in_their_bounds(style: str) -> None:
    m = motion(Order(style, 0.786, 0.045, 0.05, 2, 1.0, 3.0, False, 6, 5), 1e-3)
    assert np.all(np.diff(m.time) > 0.0) and np.abs(m.stroke).max() < 0.0451
    assert np.abs(m.velocity).max() == pytest.approx(0.786, rel=0.02) or np.abs(m.velocity).max() < 0.786
    way = np.cumsum(np.append(0.0, (m.velocity[1:] + m.velocity[:-1]) / 2 * np.diff(m.time)))
    assert np.abs(way - (m.stroke - m.stroke[0])).max() < 0.002


@pytest.mark.parametrize("apply", [fluid.laminar_fade, fluid.linear_fade])
def test_heat_fades_the_force_with_the_work(apply: Callable[..., None]) -> None:
    constants = {**fluid.heat_constants(np.random.default_rng(1))}
    run = with_(base(speed=1.048), apply, 3.0, **constants)
    work = np.array([rms(part) for part in np.array_split(run.force[block(run)] / 1.0, 4)])
    plain = np.array([rms(part) for part in np.array_split(base(speed=1.048).force[block(run)], 4)])
    assert np.all(np.diff(work / plain) < 0.0)


def test_walther_meets_its_two_points() -> None:
    assert fluid.walther(np.array([40.0, 100.0]), 15.0, 4.0) == pytest.approx([15.0, 4.0])


def test_heat_run_raises_gas_and_lowers_friction() -> None:
    run = with_(base(speed=1.048, count=12), fluid.heat_run, 3.0, **fluid.heat_constants(np.random.default_rng(2)))
    plain = base(speed=1.048, count=12)
    assert run.temperature is not None and run.temperature[-1] > run.temperature[0]
    assert run.parts["gas"][-1] < plain.parts["gas"][-1]
    assert rms(run.parts["friction"][block(run)]) < rms(plain.parts["friction"][block(run)])


@pytest.mark.parametrize("apply", [mechanics.kelvin_voigt, mechanics.cubic_mount, mechanics.filled_rubber])
def test_a_mount_takes_stroke_in_proportion_to_the_force(apply: Callable[..., None]) -> None:
    constants = mechanics.mount_constants(np.random.default_rng(3)) | {"loss": 0.0, "cubic_at": 1.0, "friction": 0.0}
    run = with_(base(), apply, 1e-7, "setup", **constants)
    taken_up = run.motion.stroke - run.parts["stroke"]
    force = run.force + DAMPER.parameters.F_0
    assert rms(taken_up - 1e-7 * force) < 0.02 * rms(taken_up)
    assert rms(with_(base(), apply, 1e-11, "setup", **constants).force - base().force) < 2e-3 * rms(base().force)


@pytest.mark.parametrize(
    ("apply", "x"), [(fluid.bulk_modulus, 5.0), (fluid.first_order_lag, 2e-3), (fluid.late_valves, 1e-3)]
)
def test_lag_follows_the_reversal_and_vanishes(apply: Callable[..., None], x: float) -> None:
    constants = {"air": 0.005, "bulk": 1.3e9}
    plain, part = base(), block(base())
    late, none = with_(plain, apply, x, **constants), with_(plain, apply, x * 1e-5, **constants)
    product = np.sign(np.gradient(plain.motion.velocity[part])) * (late.parts["fluid"] - plain.parts["fluid"])[part]
    assert product.mean() < 0.0  # too little while the speed rises
    assert rms(none.force - plain.force) < 1e-3 * rms(plain.force)


@pytest.mark.parametrize("apply", [fluid.sigmoid, fluid.mixing_length])
def test_smooth_steps_keep_their_ends(apply: Callable[..., None]) -> None:
    plain = base(0.5)
    smooth = with_(plain, apply, 2e-3)
    steepest = [np.abs(np.diff(run.parts["fluid"])).max() for run in (plain, smooth)]
    assert steepest[1] < 0.6 * steepest[0]
    assert rms(with_(plain, apply, 1e-7).force - plain.force) < 0.01 * rms(plain.force)


def test_foam_and_gas_go_where_they_belong() -> None:
    plain = base(0.5, 1.31, rest=10.0)
    for apply in (oil.foam_half_life, oil.foam_drainage):
        run = with_(plain, apply, 0.5, "setup", power=1.0)
        assert rms(run.force - plain.force) > 0.0
        assert run.parts["oil"][-1] == pytest.approx(plain.parts["oil"][-1], rel=0.05)
    for apply in (oil.dissolving, oil.dissolving_under_pressure):
        assert with_(plain, apply, 1.0, "setup").parts["oil"][-1] > plain.parts["oil"][-1]


@pytest.mark.parametrize(("apply", "x"), [(oil.film_leak, 2e-6), (oil.orifice_leak, 1e-6)])
def test_a_leak_loses_oil_and_nothing_comes_back(apply: Callable[..., None], x: float) -> None:
    run, plain = with_(base(0.5), apply, x, "setup", carried=False), base(0.5)
    lost = plain.parts["oil"] - run.parts["oil"]
    assert lost[-1] > 1e-7 and lost[-1] < plain.parts["oil"][0]


def test_gas_pushes_the_rod_out_and_stops_push_back() -> None:
    plain = base()
    for apply in (mechanics.linear_gas, mechanics.polytropic_gas):
        change = with_(plain, apply, 50.0, sign=1.0, n=1.2).force - plain.force
        assert np.interp(
            0.0, [plain.stroke.min(), plain.stroke.max()], [change[np.argmin(plain.stroke)], change[np.argmax(plain.stroke)]]
        ) == pytest.approx(-50.0, rel=0.05)
        assert change[np.argmin(plain.stroke)] < change[np.argmax(plain.stroke)]
    constants = {"at": 0.8, "reach": 0.045, "side": 1.0, "power": 2.0}
    for apply in (mechanics.linear_stop, mechanics.progressive_stop, mechanics.single_stop):
        change = with_(plain, apply, 1e5, **constants).force - plain.force
        assert change[np.argmax(plain.stroke)] > 100.0 and np.all(change[np.abs(plain.stroke) < 0.03] == 0.0)
    assert change.min() == 0.0


@pytest.mark.parametrize("apply", [mechanics.coulomb, mechanics.lugre, mechanics.growing_friction])
def test_friction_takes_work(apply: Callable[..., None]) -> None:
    constants = mechanics.friction_constants(np.random.default_rng(4)) | {"reach": 0.045}
    plain = base()
    change = with_(plain, apply, 40.0, **constants).force - plain.force
    assert (change * plain.motion.velocity).sum() > 0.0
    fast = np.abs(plain.motion.velocity) > 0.4
    assert np.abs(change[fast]).mean() == pytest.approx(40.0, rel=0.1)


def test_wear_takes_the_low_speeds_or_the_high() -> None:
    plain, constants = base(), {"re": 1.0, "co": 1.0, "sign": -1.0, "knee": 0.2}
    v = np.abs(plain.motion.velocity)
    slow, fast = (v > 0.03) & (v < 0.05), v > 0.5
    ratios = {}
    for apply in (fluid.uniform_wear, fluid.bleed_wear, fluid.lost_preload):
        worn = with_(plain, apply, 0.1, **constants).parts["fluid"] / plain.parts["fluid"]
        ratios[apply.__name__] = worn[slow].mean(), worn[fast].mean()
    assert ratios["uniform_wear"] == pytest.approx((0.9, 0.9))
    assert ratios["bleed_wear"][0] < ratios["bleed_wear"][1] < 1.0
    assert ratios["lost_preload"][1] < ratios["lost_preload"][0] < 1.0


def test_faults_of_the_channels() -> None:
    plain = base()
    assert rms(with_(plain, sensors.force_late, 0.01, "sensors").force[block(plain)] - plain.force[block(plain)]) > 1.0
    late = with_(plain, sensors.force_late, 0.01, "sensors", **SIGN)
    assert np.interp(plain.time[-1], late.time, late.force) == pytest.approx(
        np.interp(plain.time[-1] - 0.01, plain.time, plain.force)
    )
    drifting = with_(plain, sensors.drift, 2.0, "sensors", **SIGN).force - plain.force
    assert drifting[-1] == pytest.approx(2.0 * (plain.time[-1] - plain.time[0]))
    clock = with_(plain, sensors.force_clock, 0.01, "sensors", **SIGN).force_time
    assert clock is not None and clock(np.array([1.01]))[0] == pytest.approx(1.0)
    other = with_(plain, sensors.odd_setting, 0.3, "sensors", file=0, sign=1.0)
    assert rms(other.force) > rms(plain.force)
    assert np.array_equal(with_(plain, sensors.odd_setting, 0.3, "sensors", file=1, sign=1.0).force, plain.force)
    assert np.array_equal(with_(replace(plain), sensors.flip_force, 1.0, "sensors").force, -plain.force)


def test_sampling_kinds() -> None:
    time = np.linspace(0.0, 2.0, 20001)
    values = np.sin(2 * np.pi * time)
    at = np.arange(0.1, 1.9, 0.01)
    point = taken(time, values, at, 100.0, "point", False)
    assert point == pytest.approx(np.sin(2 * np.pi * at), abs=1e-6)
    assert taken(time, values, at, 100.0, "mean", True) == pytest.approx(np.sin(2 * np.pi * (at - 0.005)), abs=1e-3)
    assert taken(time, values, at, 100.0, "mean", False) == pytest.approx(np.sin(2 * np.pi * at), abs=1e-3)
    delay = np.sqrt(2.0) / (2 * np.pi * 40.0)  # of a Butterworth filter of second order at low frequency
    assert taken(time, values, at, 100.0, "filtered", False) == pytest.approx(np.sin(2 * np.pi * (at - delay)), abs=5e-3)
