"""Every loop of the library gives the bits of its Python, in what it returns, writes and leaves in the records."""

from collections.abc import Callable
from dataclasses import fields
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from twintube.common.arrays import Array
from twintube.core.agreement import Agreement
from twintube.core.effects import EFFECTS
from twintube.core.frame import stroke_limit
from twintube.core.publishing import NAMES
from twintube.core.variables import blank
from twintube.dampers import Damper, load
from twintube.diagnosis import memory_loops
from twintube.engine import compiled, loops
from twintube.engine.simulate import at_rest
from twintube.lab.virtual_rig import physics, virtual_damper
from twintube.lab.virtual_rig.rig import initial_state
from twintube.native import library, sources
from twintube.native.translate import Reader
from twintube.rig.signals import harmonic_block
from twintube.vehicle import loops as drive_loops
from twintube.vehicle.cars import load_car
from twintube.vehicle.full import car, loop, rolling, signals, steering
from twintube.vehicle.full.run import DT, Pursuit, full_car, pursuer, started
from twintube.vehicle.quarter_car import Motion

RANDOM = np.random.default_rng(3)
WORN = {"oil_level": 0.6, "gas_preload": 0}
# The paper's model, and an effect of each way to act: memory, mount, time, hysteresis.
CASES: dict[str, dict[str, float]] = {
    "paper": {},
    "lag and mount": {"C_fluid": 2e-7, "V_air": 1e-6, "C_mount": 1e-6},
    "time": {"fade_heat": 1e-5, "foam_decay_rate": 0.5, "leak_film": 1e-7},
    "gradual": {"build_up": 2e-3, "bleed_re": 0.05, "F_stop_re": 500.0, "displaced_share": 0.5},
}


def damper(case: str) -> Damper:
    return load("SA8", as_published=True).with_(**WORN, **CASES[case])


def short_block() -> tuple[Array, Array, Array]:
    block = harmonic_block(1.048, dt=4e-3)
    return tuple(np.array(values[-700:]) for values in (block.time, block.stroke, block.velocity))  # type: ignore[return-value]


def plain(value: Any) -> Any:
    """A record as one that the interpreter may change, several as a list; arrays as they are."""
    if isinstance(value, list):
        return [plain(each) for each in value]
    if hasattr(value, "__dataclass_fields__"):
        return SimpleNamespace(**{item.name: getattr(value, item.name) for item in fields(value)}, kind=type(value))
    return value.copy() if isinstance(value, np.ndarray) else value


def as_array(value: Any) -> Any:
    """The same for the library: rows of structured arrays."""
    if isinstance(value, list):
        return np.concatenate([compiled.as_row(each) for each in value])
    if hasattr(value, "__dataclass_fields__"):
        return compiled.as_row(value)[0]
    return value.copy() if isinstance(value, np.ndarray) else value


def assert_same(run: Callable[..., Any], arguments: list[Any], name: str = "", prefix: str = "kernel") -> Any:
    """Run both on copies of the arguments; returns what they return."""
    slow, fast = [plain(each) for each in arguments], [as_array(each) for each in arguments]
    with np.errstate(all="ignore"):
        expected = run(*slow)
    found = getattr(library.module(prefix), name or run.__name__)(*fast)
    assert found == expected
    for a, b in zip(slow, fast, strict=True):
        if isinstance(a, SimpleNamespace | list):
            pairs = [(a, b)] if isinstance(a, SimpleNamespace) else list(zip(a, b, strict=True))
            for record, row in pairs:
                for key in row.dtype.names:
                    assert np.array_equal(getattr(record, key), row[key], equal_nan=True), key
        elif isinstance(a, np.ndarray):
            assert np.array_equal(a, b, equal_nan=True)
    return found


@pytest.mark.parametrize("case", CASES)
def test_records(case: str) -> None:
    t, z, v = short_block()
    records = at_rest(damper(case), float(z[0]))
    assert assert_same(
        loops.run_record, [*records, t, z, v, np.linspace(250.0, 350.0, len(z)), np.zeros((len(z), len(NAMES)))]
    ) == len(z)
    marks = np.arange(0, len(z), 50)
    assert assert_same(loops.run_work, [*records, t, z, v, marks, np.zeros(len(marks))]) == len(z)
    assert assert_same(loops.run_held, [*records, z, 4e-3]) == len(z) - 1
    a = blank(Agreement)
    assert assert_same(loops.first_parted, [a, t, z, v]) == -1
    assert assert_same(loops.first_parted, [a, t, z, -v]) > 0


@pytest.mark.parametrize("case", CASES)
def test_means_over_intervals(case: str) -> None:
    t, z, v = short_block()
    n = len(t) // 7
    t, z, v = (np.ascontiguousarray(values[::7][:n]) for values in (t, z, v))
    starts = np.array([0, n // 2, n])
    states = np.array([[0.6, 0.0, 1.0, 1.0], [1.0, 1.0, 0.9, 1.1]])
    samples = RANDOM.integers(0, 4, n)
    samples[starts[:-1]] = 0  # no interval ends at the first sample
    given = loops.Records(states, starts, t, z, v, np.full(n, 3.0), samples, 4)
    slow, fast = (loops.Means(*np.zeros((3, n))) for _ in range(2))
    records = at_rest(damper(case), 0.0)
    with np.errstate(all="ignore"):
        assert loops.run_means(*[plain(each) for each in records], given, slow) == 2
    assert library.module().run_means(*[as_array(each) for each in records], given, fast) == 2
    for a, b in zip(slow, fast, strict=True):
        assert np.array_equal(a, b) and np.isfinite(a).all()


@pytest.mark.parametrize("case", CASES)
def test_quarter_car(case: str) -> None:
    records = at_rest(damper(case), 0.0)
    road = 0.003 * np.cumsum(RANDOM.standard_normal(400)) / 5
    rates = np.gradient(road) / DT
    corner = load_car().corner(damper(case))
    given = [*records, corner, blank(Motion), road, rates, np.full(400, 50.0), DT, stroke_limit(records[1])]
    assert assert_same(drive_loops.run_drive, [*given, np.zeros((400, 6))]) == 400


def whole_car(case: str) -> tuple[Any, list[Any]]:
    whole = full_car(load_car(), [damper(case)] * 4)
    body, wheels = started(whole, 20.0)
    return whole, [whole.body, body, list(whole.wheels), wheels, whole.brakes]


@pytest.mark.parametrize("case", CASES)
def test_whole_car_that_brakes_and_follows_a_path(case: str) -> None:
    whole, given = whole_car(case)
    records = [list(each) for each in zip(*[at_rest(damper(case), 0.0) for _ in range(4)], strict=True)]
    road = 0.004 * np.cumsum(RANDOM.standard_normal((2, 1200)), axis=1) / 20
    inputs = np.zeros((150, 3))
    inputs[:70, 2], inputs[80:, 1], inputs[30:, 0] = 20.0, 8e6, 0.02
    path = np.column_stack([np.linspace(0.0, 30.0, 301), 0.1 * np.sin(np.linspace(0.0, 6.0, 301)), *np.zeros((2, 301))])
    _, table = pursuer(whole, Pursuit(np.ascontiguousarray(path[:, :2])))
    q = steering.Pursuer(0.7, 0.17, 0.1, 1.1, 0.6, whole.body.wheelbase, 1e-3, 0.1, 0.0, 0.0)
    out = np.zeros((len(inputs), loop.BODY_COLUMNS + 4 * loop.WHEEL_COLUMNS))
    grips = np.array([1.0, 0.4])
    arguments = [*records, *given, road, 0.02, grips, q, table, inputs, 0, DT, out]
    assert assert_same(loop.run_car, arguments) == len(inputs)


def test_rotation_of_the_wheels() -> None:
    whole, _ = whole_car("paper")
    n = 60
    load_, spin = 4000.0 + 3000.0 * RANDOM.standard_normal((n, 4)), 60.0 + RANDOM.standard_normal((n, 4))
    given = [np.full(4, 1e6), np.full(4, 3e3), load_, 0.01 * RANDOM.standard_normal((n, 4)), spin]
    force, a_x = 200.0 * RANDOM.standard_normal((n, 4)), RANDOM.standard_normal(n)
    state, out = np.zeros((4, rolling.ROLL_STATES)), np.zeros((n, rolling.ROLL_COLUMNS))
    assert_same(rolling.roll_wheels, [list(whole.wheels), *given, force, a_x, DT, state, out])


def test_noise_with_memory() -> None:
    n, k = 80, 5
    values, kept = RANDOM.standard_normal((n, k)), RANDOM.random(n)
    given = [values, 0.5 + RANDOM.random(n), RANDOM.random(n), kept]
    assert_same(memory_loops.filter_noise, [*given, np.zeros(k), np.zeros((n, k))])
    assert_same(memory_loops.lag, [np.ascontiguousarray(values[:, 0]), kept, np.zeros(n)])


@pytest.mark.parametrize("preload", [True, False])
def test_virtual_rig(preload: bool) -> None:
    made = virtual_damper("SA8")
    c = made.constants(preload, 25.0)
    breaks = np.linspace(0.0, 1.0, 21)
    spline = 0.01 * RANDOM.standard_normal((4, 20))
    for t in (-0.1, 0.0, 0.3, 0.9999, 1.0, 2.0):
        y = initial_state(0.01, 0.7 * made.V_oil, 40.0, c) * (1.0 + 0.01 * RANDOM.random(physics.STATES))
        assert_same(physics.right_hand_side, [t, y, breaks, spline, c, np.zeros(physics.STATES)], prefix="rig")
    states = np.array([y, 1.1 * y])
    z, v = np.array([0.01, -0.02]), np.array([0.5, -0.3])
    assert_same(physics.outputs, [z, v, states, c, np.zeros((4, 2))], prefix="rig")


@pytest.mark.parametrize("equations", [sources.loops, sources.car])
def test_records_have_the_layout_of_numpy(equations: Callable[[], Any]) -> None:
    """All fields have eight bytes, so that order, names and sizes decide."""
    kinds = {**vars(car), **vars(signals), **vars(loop), **vars(steering), **vars(drive_loops), "Agreement": Agreement}
    records = Reader(equations()).types.records
    assert {"Wheel", "BodyMotion"} <= set(records)
    for name, members in records.items():
        kind = kinds.get(name)
        if kind is None or not hasattr(kind, "__dataclass_fields__"):
            continue
        wanted = compiled.dtype(kind)
        assert [member.name for member in members] == list(wanted.names or ()), name
        sizes = [wanted[member.name].itemsize // 8 for member in members]
        assert [member.size for member in members] == sizes
        assert wanted.itemsize == 8 * sum(sizes)


def test_every_effect_is_in_the_library() -> None:
    text = "\n".join(sources.loops().sources)
    assert all(f"core/effects/{name}.py" in text for name in EFFECTS)
