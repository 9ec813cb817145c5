"""Each hidden cause follows its physics; nothing hidden is the kernel's own force."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial

import numpy as np
import pytest

from twintube.common.arrays import Array
from twintube.dampers import load
from twintube.engine.simulate import simulate
from worlds.bench.plan import Record
from worlds.challenge import fluid, mechanics, oil, sensors
from worlds.challenge.catalogue import CAUSES
from worlds.challenge.plan import Order, bench_for, motion
from worlds.model.run import Run, Step, begun, copied, finished

DAMPER = load("SA8", as_published=True)


@cache
def base(level: float = 1.0, speed: float = 0.524, count: int = 4, scale: float = 1.0, rest: float = 0.0) -> Run:
    order = Order("amplitude", speed, 0.045, 0.05, 2, rest, 0.0, False, count, 1)
    record = Record("r", 0, "harmonic", level, level == 1.0, 23.0, 0.0)
    return finished(begun(record, motion(order, 1e-3, scale), DAMPER))


def with_(run: Run, apply: Callable[..., None], x: float, stage: str = "forces", **constants: object) -> Run:
    start = begun(run.record, run.motion, DAMPER) if stage == "setup" else copied(run)
    return finished(start, [Step(stage, partial(apply, x=x, c=constants))])


def rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))


def block(run: Run) -> slice:
    """The samples after the preconditioning."""
    return slice(int(np.argmax(np.abs(run.motion.velocity) > 0.06)), None)


@pytest.mark.parametrize("level", [1.0, 0.5])
def test_nothing_hidden_is_the_kernel(level: float) -> None:
    run = base(level)
    told = simulate(
        DAMPER.with_(oil_level=level, gas_preload=int(level == 1.0)), run.motion.stroke, run.motion.velocity, run.time
    )
    assert np.array_equal(run.force, told.force)


def test_steps_are_fine_enough() -> None:
    coarse, fine = base(0.5), base(0.5, scale=0.25)
    at = np.linspace(coarse.time[0], coarse.time[-1] * 0.999, 5000)
    change = np.interp(at, coarse.time, coarse.parts["k_degr"]) - np.interp(at, fine.time, fine.parts["k_degr"])
    assert abs(change.mean()) < 1e-3 and np.mean(np.abs(change) > 0.02) < 0.01


def test_every_formulation_changes_a_channel() -> None:
    bench = replace(bench_for(frozenset({"degraded", "sine"}), False, np.random.default_rng(4)), largest=1000.0)
    for name, cause in CAUSES.items():
        for item in cause.formulations:
            drawn = item.draw(np.random.default_rng(1), bench)
            constants = {**drawn, "files": [0], "file": 0, "from": 0, "state": 0.5, "where": "all", "damper": "SA1"}
            changed = 0.0
            for plain in (base(0.5, 1.31, 2, 4.0, 10.0), base(1.0, 0.524, 2, 4.0)):
                run = with_(plain, item.apply, item.highest, item.stage, **constants)
                assert np.isfinite(run.force).all(), (name, item.name)
                changed += rms(run.force - plain.force) + 1e6 * rms(run.stroke - plain.stroke)
                changed += (run.force_time is not None) + (run.unit != (1.0, 1.0))
            assert changed > 0.5, (name, item.name)


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


def test_foam_collapses_freed_gas_dissolves_and_a_leak_takes_the_force() -> None:
    plain = base(0.5, 1.31, rest=10.0)
    for apply in (oil.foam_half_life, oil.foam_drainage):
        assert rms(with_(plain, apply, 0.5, "setup", power=1.0).force - plain.force) > 0.0
    size = {}
    for henry in (False, True):
        run = with_(plain, partial(oil.dissolving, henry=henry), 1.0, "setup")
        size[henry] = rms(run.parts["fluid"])
        assert size[henry] > rms(plain.parts["fluid"])
    assert size[True] > size[False], "pressure helps"
    plain = base(0.5)
    for apply, x in ((oil.film_leak, 2e-6), (oil.orifice_leak, 1e-6)):
        assert rms(with_(plain, apply, x, "setup", carried=False).parts["fluid"]) < rms(plain.parts["fluid"])


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


def test_a_file_of_another_setting_is_odd_alone() -> None:
    plain = base()
    assert rms(with_(plain, sensors.odd_setting, 0.3, "sensors", file=0, sign=1.0).force) > rms(plain.force)
    assert np.array_equal(with_(plain, sensors.odd_setting, 0.3, "sensors", file=1, sign=1.0).force, plain.force)
