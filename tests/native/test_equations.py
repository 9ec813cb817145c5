"""The native FMU computes the kernel's numbers: to the last bit beside the interpreter and numba."""

from pathlib import Path
from typing import Any

import fmpy
import numba
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave

from twintube.common.arrays import Array
from twintube.core import model
from twintube.core.effects import State
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import Damper, load, names
from twintube.engine import compiled
from twintube.engine.simulate import rows
from twintube.fmu import build_fmu, equations, translate
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


@numba.njit
def loop(  # noqa: PLR0917 - compiled by numba
    advance: Any, p: Any, d: Any, s: Any, f: Any, z: Array, steps: Array, out: Array
) -> None:  # pragma: no cover
    for i in range(len(z) - 1):
        v = (z[i + 1] - z[i]) / steps[i]
        advance(p, d, s, f, z[i] + v * steps[i], v, v, steps[i])
        row = out[i]
        row[0] = s.F_fluid + s.F_friction + s.F_gas
        row[1] = s.k_degr
        row[2], row[3], row[4] = s.V1_oil, s.V1_gas, s.V1_foam
        row[5], row[6], row[7] = s.V2_oil, s.V2_gas, s.V2_foam
        row[8], row[9] = s.V3_oil, s.V3_foam


def by_numba(damper: Damper, stroke: Array, steps: Array) -> Array:
    out = np.empty((len(stroke) - 1, len(OUTPUTS)))
    loop(compiled.module().advance, *rows(at_rest(damper)), stroke, steps, out)
    return out


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
    assert found.tobytes() == by_numba(damper, stroke, steps).tobytes()


@pytest.mark.parametrize("name", names())
def test_same_bits_as_interpreter_and_numba(name: str, tmp_path: Path) -> None:
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


def test_translated_equations_are_current() -> None:
    text = equations.checked(translate.TARGET.read_text(encoding="utf-8"))
    for number in (22, 25, 28, 29, 36, 40, 41):
        assert f"Eq. {number}" in text  # a reader finds the paper's equations in the C too


def test_translated_equations_of_the_car_are_current() -> None:
    for target, source in translate.TARGETS.items():
        equations.checked(target.read_text(encoding="utf-8"), source)


def test_translation_repeats() -> None:
    pytest.importorskip("pyccel", reason="pyccel is absent: the digest alone tells that the translation is current")
    for target, source in translate.TARGETS.items():
        assert translate.translated(source) == target.read_text(encoding="utf-8")


def test_functions_stand_below_those_that_they_call() -> None:
    found = {"a": "def a(x):\n    return b(x)", "b": "def b(x):\n    return x"}
    assert equations.ordered(found | {"c": "def c(x):\n    return x"}, ["a"]) == ["b", "a"]
    with pytest.raises(ValueError, match="b calls itself"):
        equations.ordered(found | {"b": "def b(x):\n    return b(x)"}, ["a"])
