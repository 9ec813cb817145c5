"""The native FMU computes the kernel's numbers: to the last bit beside the interpreter and the library."""

from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave

from tests.eight import EIGHT
from twintube.common.arrays import Array
from twintube.core import model
from twintube.core.effects import State
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import Damper, load, names
from twintube.engine import compiled
from twintube.engine.simulate import rows
from twintube.fmu import build_fmu
from twintube.native.headers import HEADERS, header, vouched
from twintube.rig.signals import BLOCKS, harmonic_block

VOLUMES = ("V1_oil", "V1_gas", "V1_foam", "V2_oil", "V2_gas", "V2_foam", "V3_oil", "V3_foam")
OUTPUTS = ("force", "k_degr", *(name.replace("_", ".") for name in VOLUMES))


def moves(velocity: float) -> tuple[Array, Array]:
    """Strokes and intervals of a block; the velocity of a step is the mean one."""
    block = harmonic_block(velocity)
    return block.stroke, np.diff(block.time)


def at_rest(damper: Damper) -> list[Any]:
    p, d, s, f = damper.parameters, blank(Derived), blank(State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    model.advance(p, d, s, f, 0.0, 0.0, 0.0, 0.0)
    return [p, d, s, f]


def interpreted(damper: Damper, stroke: Array, steps: Array) -> Array:
    p, d, s, f = at_rest(damper)
    found = []
    z = stroke.tolist()
    for a, b, dt in zip(z[:-1], z[1:], steps.tolist(), strict=True):
        v = (b - a) / dt
        model.advance(p, d, s, f, a + v * dt, v, v, dt)
        found.append((s.F_fluid + s.F_friction + s.F_gas, s.k_degr, *(getattr(s, name) for name in VOLUMES)))
    return np.array(found)


def by_library(damper: Damper, stroke: Array, steps: Array) -> Array:
    p, d, s, f = rows(at_rest(damper))
    advance, found, z = compiled.module().advance, [], stroke.tolist()
    for a, b, dt in zip(z[:-1], z[1:], steps.tolist(), strict=True):
        v = (b - a) / dt
        advance(p, d, s, f, a + v * dt, v, v, dt)
        found.append((s["F_fluid"] + s["F_friction"] + s["F_gas"], s["k_degr"], *(s[name] for name in VOLUMES)))
    return np.array(found)


def slave_of(fmu: Path) -> tuple[FMU2Slave, dict[str, int]]:
    description = fmpy.read_model_description(str(fmu))
    slave = FMU2Slave(guid=description.guid, unzipDirectory=fmpy.extract(str(fmu)),
                      modelIdentifier=description.coSimulation.modelIdentifier, instanceName="x")  # fmt: skip
    refs = {v.name: v.valueReference for v in description.modelVariables}
    slave.instantiate()
    slave.setupExperiment(startTime=0.0)
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    return slave, refs


def native(damper: Damper, stroke: Array, steps: Array, folder: Path) -> Array:
    fmu = build_fmu(damper, folder / f"{damper.name}.fmu", platforms=(fmpy.platform,))
    slave, refs = slave_of(fmu)
    given, wanted = [refs["stroke"], refs["velocity"]], [refs[name] for name in OUTPUTS]
    found, z, time = [], stroke.tolist(), 0.0
    for a, b, dt in zip(z[:-1], z[1:], steps.tolist(), strict=True):
        slave.setReal(given, [a, (b - a) / dt])
        slave.doStep(time, dt)
        time += dt
        found.append(slave.getReal(wanted))
    slave.terminate()
    slave.freeInstance()
    return np.array(found)


def assert_same(damper: Damper, velocity: float, folder: Path) -> None:
    stroke, steps = moves(velocity)
    found = native(damper, stroke, steps, folder)
    assert np.isfinite(found).all()
    assert found.tobytes() == interpreted(damper, stroke, steps).tobytes()
    assert found.tobytes() == by_library(damper, stroke, steps).tobytes()


@pytest.mark.parametrize("name", EIGHT)
def test_same_bits_as_interpreter_and_library(name: str, tmp_path: Path) -> None:
    damper = load(name)
    assert_same(damper.with_(oil_level=damper.measured_levels[-1], gas_preload=0), BLOCKS[-1], tmp_path)


def test_same_bits_with_another_reading_and_a_polytropic_gas(tmp_path: Path) -> None:
    damper = load("SA3").with_(oil_level=0.61, gas_preload=0, venting=1, polytropic=1)
    assert_same(damper, BLOCKS[-1], tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("velocity", BLOCKS)
@pytest.mark.parametrize("name", names())
def test_same_bits_over_the_whole_harmonic_plan(name: str, velocity: float, tmp_path: Path) -> None:
    damper = load(name)
    for level in damper.measured_levels:
        assert_same(damper.with_(oil_level=level, gas_preload=0), velocity, tmp_path)


def test_input_derivative_lets_the_velocity_go_evenly(tmp_path: Path) -> None:
    damper = load("SA8").with_(oil_level=0.6, gas_preload=0)
    slave, refs = slave_of(build_fmu(damper, tmp_path, platforms=(fmpy.platform,)))
    p, d, s, f = at_rest(damper)
    z, v, h = 0.0, 0.0, 1e-3
    for i in range(500):
        rate = 25.0 * np.cos(0.05 * i)
        slave.setReal([refs["stroke"], refs["velocity"]], [z, v])
        slave.setRealInputDerivatives([refs["velocity"]], [1], [rate])
        slave.doStep(i * h, h)
        end, after = z + (v + 0.5 * rate * h) * h, v + rate * h
        model.advance(p, d, s, f, end, v, after, h)
        assert slave.getReal([refs["force"]]) == [s.F_fluid + s.F_friction + s.F_gas]
        z, v = end, after
    # It holds for one step: the next goes with the velocity alone.
    slave.setReal([refs["stroke"], refs["velocity"]], [z, v])
    slave.doStep(500 * h, h)
    model.advance(p, d, s, f, z + v * h, v, v, h)
    assert slave.getReal([refs["force"]]) == [s.F_fluid + s.F_friction + s.F_gas]
    slave.terminate()
    slave.freeInstance()


def test_a_reader_finds_the_papers_equations_in_the_c() -> None:
    text = header("kernel.h")
    for number in (22, 25, 28, 29, 36, 40, 41):
        assert f"Eq. {number}" in text


@pytest.mark.parametrize("name", HEADERS)
def test_a_kept_header_is_of_its_text_and_files(name: str) -> None:
    text, files = header(name), HEADERS[name][1]
    assert vouched(text, files) != vouched(text + " ", files)
    assert vouched(text, files) != vouched(text, (*files, "engine/simulate.py"))
