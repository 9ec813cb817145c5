"""Both kinds of FMU refuse the same, in the same words.

The native kind answers at once with an error. pythonfmu passes on only what a step returns: the Python kind logs the same
message at once, changes nothing, and the coming step is refused.
"""

import json
import logging
from collections.abc import Callable, Iterator
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import fmpy
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave

from twintube.core import messages
from twintube.core.checks import problems, tube_limit
from twintube.core.variables import fmi_name
from twintube.dampers import load
from twintube.fmu import build_fmu
from twintube.fmu.platforms import Kind

H = 1e-3
LIMIT = tube_limit(load("SA8").parameters)


class Unit:
    """An instance with its log."""

    def __init__(self, fmu: Path, *, logging_on: bool = True) -> None:
        description = fmpy.read_model_description(str(fmu))
        assert description.coSimulation is not None
        self.said: list[str] = []
        self.slave = FMU2Slave(guid=description.guid, unzipDirectory=fmpy.extract(str(fmu)),
                               modelIdentifier=description.coSimulation.modelIdentifier, instanceName="x")  # fmt: skip
        callbacks = fmpy.fmi2.fmi2CallbackFunctions()
        callbacks.logger = fmpy.fmi2.fmi2CallbackLoggerTYPE(lambda *said: self.said.append(said[4].decode()))
        callbacks.allocateMemory = fmpy.fmi2.fmi2CallbackAllocateMemoryTYPE(fmpy.calloc)
        callbacks.freeMemory = fmpy.fmi2.fmi2CallbackFreeMemoryTYPE(fmpy.free)
        self.slave.instantiate(callbacks=callbacks, loggingOn=logging_on)
        self.refs = {v.name: v.valueReference for v in description.modelVariables}
        self.time = 0.0

    def initialised(self, stop: float | None = None, **values: float) -> "Unit":
        for name, value in values.items():
            self.slave.setReal([self.refs[name]], [value])
        self.slave.setupExperiment(startTime=0.0, stopTime=stop)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
        return self

    def step(self, h: float = H, velocity: float = 0.2) -> None:
        stroke = self.slave.getReal([self.refs["stroke"]])[0]
        self.slave.setReal([self.refs["velocity"]], [velocity])
        self.slave.doStep(self.time, h)
        self.time += h
        self.slave.setReal([self.refs["stroke"]], [stroke + velocity * h])

    def set(self, name: str, value: float) -> None:
        self.slave.setReal([self.refs[name]], [value])

    def outputs(self) -> list[float]:
        return self.slave.getReal([self.refs[name] for name in ("force", "work", "k_degr", "V1.oil", "V3.gas")])

    def refused(self, call: Callable[[], object]) -> str:
        """The message of a refused call or of the step after it; afterwards the unit is as before and goes on."""
        before, count = self.outputs(), len(self.said)
        with pytest.raises(FMICallException):
            call()
            # The native kind has refused the call, the Python kind refuses the step.
            self.slave.doStep(self.time, H)
        assert self.outputs() == before
        assert len(self.said) > count
        return self.said[count]

    def close(self) -> None:
        self.slave.terminate()
        self.slave.freeInstance()


@pytest.fixture
def unit(sa8_fmu: Path) -> Iterator[Unit]:
    unit = Unit(sa8_fmu).initialised(stop=1.0)
    yield unit
    unit.close()


def test_mistimed_steps_are_refused(unit: Unit) -> None:
    for _ in range(3):
        unit.step()
    assert unit.refused(lambda: unit.slave.doStep(0.5, H)) == messages.MISTIMED % (0.5, unit.time)
    assert unit.refused(lambda: unit.slave.doStep(0.0, H)) == messages.MISTIMED % (0.0, unit.time)
    # Importers add up their steps with rounding.
    unit.time += 5e-10
    unit.step()
    assert len(unit.said) == 2


def test_steps_beyond_the_stop_time_are_refused(unit: Unit) -> None:
    unit.step()
    assert unit.refused(lambda: unit.slave.doStep(unit.time, 2.0)) == messages.BEYOND_STOP % (2.0, unit.time, 1.0)
    unit.step()


def test_steps_that_are_not_numbers_are_refused(unit: Unit) -> None:
    said = unit.refused(lambda: unit.slave.doStep(0.0, float("nan")))
    assert said == "communication step = nan s: must be a number from 0 to 1e+12 s"
    said = unit.refused(lambda: unit.slave.doStep(float("inf"), H))
    assert said == "communication point = inf s: must be a number from -1e+12 to 1e+12 s"
    unit.step()


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("oil_level", 0.5, messages.FIXED % "oil_level"),
        ("fv.F_re[3]", 300.0, messages.FIXED % "fv.F_re[3]"),
        ("force", 1.0, messages.NOT_SETTABLE % "force"),
        ("friction.F_FrS", -1.0, "friction.F_FrS = -1 N: must be a number from 0 to 2000 N"),
        ("foam.B", 1.5, "foam.B = 1.5: must be a number from 0 to 1"),
        ("velocity", 21.0, "velocity = 21 m/s: must be a number from -20 to 20 m/s"),
        ("stroke", 0.6, "stroke = 0.6 m: must be a number from -0.5 to 0.5 m"),
        ("stroke", 0.4, messages.outside("stroke", 0.4, -LIMIT, LIMIT, "m")),
    ],
)
def test_values_are_refused(unit: Unit, name: str, value: float, said: str) -> None:
    unit.step()
    stroke = unit.slave.getReal([unit.refs["stroke"]])[0]
    assert unit.refused(lambda: unit.set(name, value)) == said
    unit.set("stroke", stroke)
    unit.step()


def test_nothing_is_set_where_one_of_several_values_is_refused(unit: Unit) -> None:
    unit.step()
    refs = [unit.refs[name] for name in ("friction.F_FrS", "oil_level")]
    before = unit.slave.getReal(refs)
    unit.refused(lambda: unit.slave.setReal(refs, [20.0, 0.5]))
    assert unit.slave.getReal(refs) == before
    unit.step()


def points(name: str, index: int, value: float) -> dict[str, tuple[float, ...]]:
    """A branch of the F-v curve with another value at a point."""
    values = list(getattr(load("SA8").parameters, name))
    values[index] = value
    return {name: tuple(values)}


BROKEN: dict[int, dict[str, Any]] = {
    1: points("v_re", 0, 0.0),
    2: points("v_re", 5, 0.0),
    3: points("F_re", 2, 10.0),
    4: points("v_co", 0, 0.0),
    5: points("v_co", 19, 0.0),
    6: points("F_co", 1, 0.0),
    7: {"D_PR": 0.05},
    8: {"D_li": 0.1},
    9: {"D_a": 0.03},
    10: {"h_l": 0.05, "dead_length": 0.06},
    11: {"stroke_max": 0.3},
    12: {"V_oil": 1e-5},
    13: {"V_oil": 4e-3},
    14: {"polytropic": 1, "c_gas": 2e4},
    15: {"polytropic": 1, "c_gas_lost": 500.0},
    16: {"T_cold": 300.0},
    17: {"T_hot": 290.0},
}


def test_every_rule_is_broken_here() -> None:
    assert set(BROKEN) == set(messages.RULES)


@pytest.mark.parametrize("rule", BROKEN)
def test_both_kinds_and_the_interpreter_say_the_same_of_parameters(sa8_fmu: Path, kind: Kind, rule: int) -> None:
    p = replace(load("SA8").parameters, **BROKEN[rule])
    expected = problems(p)
    assert expected[0].startswith(messages.RULES[rule].split(" = ")[0].split(" %d")[0])
    unit = Unit(sa8_fmu)
    for item in fields(p):
        value = getattr(p, item.name)
        if item.name not in BROKEN[rule]:
            continue
        if isinstance(value, tuple):
            unit.slave.setReal([unit.refs[f"{fmi_name(item)}[{i + 1}]"] for i in range(len(value))], value)
        elif item.metadata["integer"]:
            unit.slave.setInteger([unit.refs[fmi_name(item)]], [value])
        else:
            unit.set(fmi_name(item), value)
    with pytest.raises(FMICallException):
        unit.initialised()
        unit.step()
    assert unit.said[0] == (expected[0] if kind == "native" else "; ".join(expected))
    unit.slave.freeInstance()


def test_steps_in_the_wrong_mode_are_refused(sa8_fmu: Path) -> None:
    unit = Unit(sa8_fmu)
    with pytest.raises(FMICallException):
        unit.slave.doStep(0.0, H)
    unit.initialised()
    unit.step()
    unit.slave.terminate()
    with pytest.raises(FMICallException):
        unit.slave.doStep(H, H)
    assert unit.said == [messages.NOT_NOW % ("fmi2DoStep", messages.MODES[mode]) for mode in (0, 3)]
    unit.slave.freeInstance()


def test_a_jump_of_the_stroke_is_noticed_and_the_give_of_a_mount_is_not(kind: Kind, tmp_path: Path) -> None:
    """The mount gives way by more than the limit; what is set is its outer end, which the velocity leads."""
    damper = load("SA8").with_(C_mount=2e-5)
    unit = Unit(build_fmu(damper, tmp_path / "mount.fmu", kind, (fmpy.platform,))).initialised()
    for i in range(60):
        unit.step(velocity=2.0 if i % 20 < 10 else -2.0)
    assert unit.said == []
    unit.set("stroke", 0.05)
    unit.step()
    assert len(unit.said) == 1
    assert "check sign, unit and connection of velocity" in unit.said[0]
    unit.close()


def test_nothing_refused_is_silent_without_debug_logging(
    sa8_fmu: Path, kind: Kind, caplog: pytest.LogCaptureFixture
) -> None:
    """pythonfmu drops messages then; the Python kind has them in Python's own log."""
    unit = Unit(sa8_fmu, logging_on=False).initialised()
    with caplog.at_level(logging.WARNING), pytest.raises(FMICallException):
        unit.slave.doStep(0.5, H)
    said = unit.said if kind == "native" else [record.getMessage().removeprefix("x: ") for record in caplog.records]
    assert said == [messages.MISTIMED % (0.5, 0.0)]
    unit.close()


def kept(unit: Unit) -> bytes:
    state = unit.slave.getFMUState()
    stored: bytes = unit.slave.serializeFMUstate(state)
    unit.slave.freeFMUState(state)
    return stored


def restored(unit: Unit, stored: bytes) -> None:
    unit.slave.setFMUState(unit.slave.deSerializeFMUstate(stored))


def test_a_state_of_another_fmu_is_refused(sa8_fmu: Path, sa7_fmu: Path) -> None:
    ours, other = Unit(sa8_fmu).initialised(), Unit(sa7_fmu).initialised()
    other.step()
    stored = kept(other)
    assert "the state belongs to another FMU" in ours.refused(lambda: restored(ours, stored))
    ours.step()
    ours.close()
    other.close()


def test_a_restored_time_counts(unit: Unit) -> None:
    unit.step()
    stored, at, outputs = kept(unit), unit.time, unit.outputs()
    unit.step()
    restored(unit, stored)
    assert unit.outputs() == outputs
    assert unit.refused(lambda: unit.slave.doStep(unit.time, H)) == messages.MISTIMED % (unit.time, at)
    unit.time = at
    unit.step()


def changed(path: tuple[str, ...], value: Any) -> Callable[[dict[str, Any]], Any]:
    def change(state: dict[str, Any]) -> Any:
        place = state
        for key in path[:-1]:
            place = place[key]
        place[path[-1]] = value
        return state

    return change


@pytest.mark.parametrize(
    "forge",
    [
        changed(("mode",), 7),
        changed(("mode",), True),
        changed(("mode",), "3"),
        changed(("stale",), True),
        changed(("stale",), 0),
        changed(("time",), float("nan")),
        changed(("stop",), "never"),
        changed(("refusal",), 3),
        changed(("further",), 1),
        changed(("damper",), []),
        changed(("damper", "further"), 1),
        changed(("damper", "changed"), 1),
        changed(("damper", "warned"), None),
        changed(("damper", "long_step"), 0),
        changed(("damper", "beyond_law"), 1),
        changed(("damper", "inputs", "temperature"), 0.0),
        changed(("damper", "state", "T"), float("nan")),
        changed(("damper", "agreement", "at_apart"), 0.003),
        changed(("damper", "agreement", "way_led"), -1e-9),
        changed(("damper", "agreement", "velocity"), 1e300),
        changed(("damper", "agreement", "doubt"), float("nan")),
        changed(("damper", "agreement", "step"), None),
        changed(("damper", "state", "V1_oil"), float("nan")),
        changed(("damper", "state", "V1_oil"), -1e-6),
        changed(("damper", "state", "z"), 0.4),
        changed(("damper", "state", "z"), None),
        changed(("damper", "state", "z"), 10**400),
        changed(("damper", "state", "new"), 0.0),
        changed(("damper", "flow", "k_degr"), float("inf")),
        changed(("damper", "inputs", "stroke"), 0.7),
        changed(("damper", "parameters", "oil_level"), 1.7),
        changed(("damper", "parameters", "V_oil"), 4e-3),
        changed(("damper", "parameters", "gas_preload"), -0.5),
        changed(("damper", "parameters", "polytropic"), 0.5),
        changed(("damper", "wanted", "F_re"), [1.0]),
        changed(("damper", "wanted", "F_re"), [float("nan")] * 20),
        changed(("damper", "parameters"), []),
        lambda state: {key: value for key, value in state.items() if key != "damper"},
        lambda state: [state],
        lambda _: {},
    ],
)
def test_a_forged_state_of_the_python_kind_is_refused(python_unit: Unit, forge: Callable[[dict[str, Any]], Any]) -> None:
    """The forged states of the native kind are in `tests/native/forged.h`."""
    python_unit.step()
    stored = json.dumps(forge(json.loads(kept(python_unit)))).encode()
    said = python_unit.refused(lambda: restored(python_unit, stored))
    assert said in [text % "fmi2SetFMUstate" for text in (messages.DAMAGED_STATE, messages.NO_STATE)]
    python_unit.step()


@pytest.mark.parametrize("stored", [b"", b"\xff\x00", b"[" * 10_000, b"1", b'{"identity": 1'])
def test_bytes_that_are_no_state_are_refused(python_unit: Unit, stored: bytes) -> None:
    assert "not an FMU state" in python_unit.refused(lambda: restored(python_unit, stored))
    python_unit.step()


@pytest.fixture(scope="module")
def python_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_fmu(load("SA8"), tmp_path_factory.mktemp("python"), "python")


@pytest.fixture
def python_unit(python_fmu: Path) -> Iterator[Unit]:
    unit = Unit(python_fmu).initialised()
    yield unit
    unit.close()
