"""Temperature in the FMU: an input that nobody has to connect, the heat as an output, and the loop that a body closes."""

import math
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy import simulate_fmu

from tests.fmu.test_alike import Unit
from twintube.common.arrays import Array
from twintube.core.effects import State
from twintube.core.model import advance, set_up, start
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import load
from twintube.engine.simulate import simulate
from twintube.fmu import build_fmu
from twintube.fmu.instance import Instance

SA8 = load("SA8").with_(oil_level=0.7, gas_preload=0.5)
T_CURVE = SA8.parameters.T_curve
STATE = {"oil_level": 0.7, "gas_preload": 0.5}
INPUTS = ("stroke", "velocity", "temperature")
OUTPUTS = ("force", "k_degr", "force_friction", "force_gas", "work", "heat_flow", "temperature_oil")
H = 1e-3


def swing(step: int) -> tuple[float, float]:
    """Stroke [m] and velocity [m/s]."""
    return 0.04 * math.sin(12.0 * step * H), 0.48 * math.cos(12.0 * step * H)


class Driven:
    """An FMU that swings, at a temperature of one's choice, and gives back some outputs."""

    def __init__(self, fmu: Path, outputs: tuple[str, ...] = OUTPUTS, **start_values: float) -> None:
        self.unit = Instance(fmu, start_values, (*INPUTS, *outputs))
        self.given, self.wanted = self.unit.buffer(*INPUTS), self.unit.buffer(*outputs)
        self.steps = 0

    def step(self, temperature: float) -> list[float]:
        self.given[2][:] = (*swing(self.steps), temperature)
        self.unit.advance(self.given, H)
        self.steps += 1
        return list(self.unit.read(self.wanted))


@pytest.fixture(params=["FMI 2.0", "FMI 3.0", "Python"])
def fmu(request: pytest.FixtureRequest, sa8_fmi3: Path, sa8_native: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    if request.param == "Python":
        return build_fmu(load("SA8"), tmp_path_factory.mktemp("python"), kind="python")
    return sa8_native if request.param == "FMI 2.0" else sa8_fmi3


@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_a_ramp_of_temperature_in_fmpy_is_that_of_simulate(fmu: Path, direction: float) -> None:
    time = np.arange(1001) * H
    stroke, velocity = direction * (0.05 * time - 0.025), np.full(len(time), direction * 0.05)
    temperature = np.linspace(250.0, 350.0, len(time))
    kinds = [(name, np.float64) for name in ("time", *INPUTS)]
    motion = np.array(list(zip(time, stroke, velocity, temperature, strict=True)), dtype=kinds)
    run = simulate_fmu(str(fmu), start_values=STATE, input=motion, output=OUTPUTS, output_interval=H, stop_time=time[-1])
    expected = simulate(SA8, stroke, velocity, time, temperature=temperature)
    found = {"force_friction": "F_friction", "force_gas": "F_gas", "temperature_oil": "T_oil"}
    for name in OUTPUTS:
        values = getattr(expected, found.get(name, name))
        assert run[name][1:] == pytest.approx(values[1:], rel=1e-7, abs=1e-7 * np.abs(values).max()), name
    assert np.ptp(run["temperature_oil"]) > 99.0


def test_a_varied_temperature_gives_the_interpreters_forces_to_the_bit(fmu: Path) -> None:
    p = SA8.parameters
    d, s, f = blank(Derived), blank(State), blank(Flow)
    set_up(p, d)
    start(p, d, s, 0.0)
    advance(p, d, s, f, 0.0, 0.0, 0.0, 0.0)
    driven = Driven(fmu, ("force", "work"), **STATE)
    with driven.unit:
        for i in range(800):
            s.temperature = 290.0 + 30.0 * math.sin(0.01 * i)
            z, v = swing(i)
            advance(p, d, s, f, z + v * H, v, v, H)
            assert driven.step(s.temperature) == [s.F_fluid + s.F_friction + s.F_gas, s.work]
        assert driven.unit.messages == []


def test_the_input_begins_at_the_temperature_of_the_parameters(fmu: Path) -> None:
    variables = {v.name: v for v in fmpy.read_model_description(str(fmu)).modelVariables}
    temperature = variables["temperature"]
    assert (temperature.causality, float(temperature.start), temperature.unit) == ("input", T_CURVE, "K")
    assert (float(temperature.min), float(temperature.max)) == (150.0, 500.0)
    assert (variables["heat_flow"].causality, variables["heat_flow"].unit) == ("output", "W")


def test_a_damper_that_was_measured_warm_begins_warm(tmp_path: Path) -> None:
    fmu = build_fmu(load("SA8").with_(T_curve=303.15), tmp_path, platforms=(fmpy.platform,))
    description = fmpy.read_model_description(str(fmu))
    assert next(float(v.start) for v in description.modelVariables if v.name == "temperature") == 303.15


class Body:
    """A thermal unit: a heat capacity [J/K] that loses heat to the air through a resistance [K/W]."""

    def __init__(self, capacity: float, resistance: float, air: float) -> None:
        self.capacity, self.resistance, self.air = capacity, resistance, air
        self.temperature, self.lost = air, 0.0

    def step(self, heat_flow: float, h: float) -> None:
        out = (self.temperature - self.air) / self.resistance
        self.temperature += (heat_flow - out) * h / self.capacity
        self.lost += out * h


def test_a_body_closes_the_thermal_loop(fmu: Path) -> None:
    """No energy is lost between the two, and the loop is that of the damper's own heat store."""
    air, capacity, resistance, steps = 263.15, 100.0, 0.06, 6000
    body = Body(capacity, resistance, air)
    driven = Driven(fmu, ("heat_flow", "work", "temperature_oil"), **STATE)
    temperatures, work = [], 0.0
    with driven.unit:
        for _ in range(steps):
            flow, work, oil = driven.step(body.temperature)
            assert oil == body.temperature
            body.step(flow, H)
            temperatures.append(body.temperature)
    stored = capacity * (body.temperature - air)
    assert stored + body.lost == pytest.approx(work, rel=1e-3)
    assert stored > 0.2 * work and body.lost > 0.2 * work
    assert np.array(temperatures) == pytest.approx(own_heat(fmu, air, capacity, resistance, steps), abs=0.02)


def own_heat(fmu: Path, air: float, capacity: float, resistance: float, steps: int) -> Array:
    """The temperatures after each step of a damper that keeps its own heat, in air."""
    store = {"oil_temperature.warm_heat": 1.0 / capacity, "oil_temperature.cooling_time": resistance * capacity}
    driven = Driven(fmu, ("temperature_oil",), **STATE, **store)
    with driven.unit:
        found = [driven.step(air)[0] for _ in range(steps + 1)]
    return np.array(found[1:])  # the heat of a step acts in the next


@pytest.mark.parametrize("value", [float("nan"), 0.0, -1.0, 25.0])
def test_what_is_no_temperature_is_refused(sa8_fmu: Path, value: float) -> None:
    unit = Unit(sa8_fmu).initialised()
    unit.step()
    said = unit.refused(lambda: unit.set("temperature", value))
    assert said == f"temperature = {value:g} K: must be a number from 150 to 500 K"
    unit.step()
    unit.close()


def test_beyond_the_law_is_one_warning_with_its_range(fmu: Path) -> None:
    driven = Driven(fmu, **STATE)
    with driven.unit:
        for temperature in (290.0, 243.15, 240.0, 230.0, 400.0):
            driven.step(temperature)
        (said,) = driven.unit.messages
    law = "the law of this damper holds from 243.15 to 353.15 K; beyond it fluid force and friction are those of its end"
    assert said == f"Warning: time 0.002 s: temperature = 240 K: {law}"


def test_the_temperature_belongs_to_the_state(sa8_fmu: Path) -> None:
    unit = Unit(sa8_fmu).initialised()
    outputs = [unit.refs[name] for name in ("force", "k_degr", "heat_flow", "temperature_oil")]
    for i in range(300):
        unit.set("temperature", 290.0 - 0.1 * i)
        unit.step(velocity=0.2 * math.cos(0.05 * i))
    kept, time = unit.slave.getFMUState(), unit.time
    before = unit.slave.getReal(outputs)
    stored = unit.slave.serializeFMUstate(kept)

    def on() -> list[list[float]]:
        found = []
        for i in range(100):
            unit.step(velocity=0.2 * math.sin(0.05 * i))
            found.append(unit.slave.getReal(outputs))
        return found

    stroke = unit.slave.getReal([unit.refs["stroke"]])
    first = on()
    for state in (kept, unit.slave.deSerializeFMUstate(stored)):
        unit.slave.setFMUState(state)
        unit.time = time
        assert unit.slave.getReal(outputs) == before
        assert unit.slave.getReal([unit.refs["stroke"]]) == stroke
        assert on() == first
    unit.close()
