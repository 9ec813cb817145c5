"""The FMU computes what the kernel computes, any number of them, and refuses what it must."""

import math
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave

from twintube.core.effects import State
from twintube.core.model import advance, set_up, start
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import load
from twintube.demo.damper_fmu import DamperFmu
from twintube.engine.simulate import simulate
from twintube.fmu.instance import FmuError

DEGRADED = {"oil_level": 0.56, "gas_preload": 0}


def motion(i: int, dt: float) -> tuple[float, float]:
    t = i * dt
    return 0.04 * math.sin(30 * t) + 0.01 * math.sin(7 * t), 1.2 * math.cos(30 * t) + 0.07 * math.cos(7 * t)


def in_process(name: str, steps: int, dt: float, **changes: Any) -> list[float]:
    """The interpreted equations stepped as the FMU steps it."""
    p = load(name).with_(**changes).parameters
    d, s, f = blank(Derived), blank(State), blank(Flow)
    set_up(p, d)
    start(p, d, s, 0.0)
    advance(p, d, s, f, 0.0, 0.0, 0.0, 0.0)
    forces = []
    for i in range(steps):
        z, v = motion(i, dt)
        advance(p, d, s, f, z + v * dt, v, v, dt)
        forces.append(s.F_fluid + s.F_friction + s.F_gas)
    return forces


def driven(damper: DamperFmu, steps: int, dt: float) -> list[float]:
    return [damper.step(*motion(i, dt), dt) for i in range(steps)]


def test_fmu_and_kernel_agree_to_the_bit(sa8_fmu: Path) -> None:
    with DamperFmu(sa8_fmu, **DEGRADED) as damper:
        assert driven(damper, 3000, 1e-3) == in_process("SA8", 3000, 1e-3, **DEGRADED)
        assert damper.messages == []


def test_instances_of_two_dampers_share_a_process(sa8_fmu: Path, sa7_fmu: Path) -> None:
    with DamperFmu(sa8_fmu, **DEGRADED) as a, DamperFmu(sa7_fmu, **DEGRADED) as b, DamperFmu(sa8_fmu) as c:
        forces = [(a.step(*motion(i, 1e-3), 1e-3), b.step(*motion(i, 1e-3), 1e-3), c.step(*motion(i, 1e-3), 1e-3))
                  for i in range(1000)]  # fmt: skip
    assert [f[0] for f in forces] == in_process("SA8", 1000, 1e-3, **DEGRADED)
    assert [f[1] for f in forces] == in_process("SA7", 1000, 1e-3, **DEGRADED)
    assert [f[2] for f in forces] == in_process("SA8", 1000, 1e-3)


def test_force_converges_to_the_kernel_with_the_communication_step(sa8_fmu: Path) -> None:
    """Inputs held over the step: an error of first order against a finely sampled record."""
    seconds, fine = 0.6, 2e-5
    reference_motion = np.array([motion(i, fine) for i in range(round(seconds / fine) + 1)])
    times = fine * np.arange(len(reference_motion))
    exact = simulate(load("SA8").with_(oil_level=0.8, gas_preload=0), *reference_motion.T, times)
    errors = []
    for dt in (4e-3, 2e-3, 1e-3, 5e-4):
        with DamperFmu(sa8_fmu, oil_level=0.8, gas_preload=0) as damper:
            forces = np.array(driven(damper, round(seconds / dt), dt))
        at = np.rint((np.arange(len(forces)) + 1) * dt / fine).astype(int)
        errors.append(np.abs(forces - exact.force[at]).mean())
    order = np.polyfit(np.log([4e-3, 2e-3, 1e-3, 5e-4]), np.log(errors), 1)[0]
    assert order > 0.8
    assert errors[-1] < 0.02 * np.abs(exact.force).max()


def test_fmpy_simulates_it(sa8_fmu: Path) -> None:
    t = np.arange(0, 1, 1e-3)
    signal = np.array([(x, *motion(i, 1e-3)) for i, x in enumerate(t)],
                      dtype=[("time", float), ("stroke", float), ("velocity", float)])  # fmt: skip
    result = simulate_fmu(str(sa8_fmu), stop_time=0.9, output_interval=1e-3, input=signal, start_values=DEGRADED,
                          output=["force", "V1.oil", "V2.gas", "work"])  # fmt: skip
    assert np.isfinite(result["force"]).all()
    assert result["work"][-1] > 10


def test_full_and_tiny_steps_are_accepted(sa8_fmu: Path) -> None:
    with DamperFmu(sa8_fmu, **DEGRADED) as damper:
        before = damper.step(0.0, 0.3, 1e-3)
        assert damper.step(3e-4, 0.3, 0.0) == pytest.approx(before)
        assert math.isfinite(damper.step(3e-4, 0.3, 1e-16))


@pytest.mark.parametrize(
    ("stroke", "velocity", "dt", "message"),
    [
        (math.nan, 0.0, 1e-3, r"stroke = nan m: must be a number from -0\."),
        (0.3, 0.0, 1e-3, r"stroke = 0\.3 m: must be a number from -0\.1"),
        (0.1, 15.0, 1e-2, r"stroke at the end of the step = 0\.25 m: must be"),
        (0.0, math.inf, 1e-3, r"velocity = inf m/s: must be a number from -20 to 20 m/s"),
        (0.0, 0.0, -1e-3, r"communication step = -0\.001 s: must be"),
    ],
)
def test_bad_input_is_refused_and_the_state_kept(
    sa8_fmu: Path, stroke: float, velocity: float, dt: float, message: str
) -> None:
    with DamperFmu(sa8_fmu, **DEGRADED) as damper:
        expected = driven(damper, 50, 1e-3)
        assert expected == in_process("SA8", 50, 1e-3, **DEGRADED)
        held = damper.outputs()
        with pytest.raises(FmuError, match=r"(Discard|Error): Error: .*" + message):
            damper.step(stroke, velocity, dt)
        assert damper.outputs() == held
        going_on = [damper.step(*motion(i, 1e-3), 1e-3) for i in range(50, 100)]
    assert expected + going_on == in_process("SA8", 100, 1e-3, **DEGRADED)


@pytest.mark.parametrize(
    ("parameter", "value", "message"),
    [
        ("oil_level", 1.7, r"oil_level = 1\.7: must be a number from 0 to 1$"),
        ("geometry.D_PR", 0.05, r"geometry\.D_PR = 0\.05 m: must be below geometry\.D_li"),
        ("fv.F_re[3]", 10.0, r"fv\.rebound: not monotone, force 3 = 10 N must be at least"),
        ("friction.sigma_0", math.nan, r"friction\.sigma_0 = nan N/m: must be a number"),
    ],
)
def test_bad_parameters_are_refused_before_the_first_step(sa8_fmu: Path, parameter: str, value: float, message: str) -> None:
    with pytest.raises(FmuError, match=message), DamperFmu(sa8_fmu, **{parameter: value}) as damper:
        damper.step(0.0, 0.1, 1e-3)


def instance(fmu: Path) -> tuple[FMU2Slave, dict[str, int]]:
    description = fmpy.read_model_description(str(fmu))
    slave = FMU2Slave(guid=description.guid, unzipDirectory=fmpy.extract(str(fmu)),
                      modelIdentifier=description.coSimulation.modelIdentifier, instanceName="x")  # fmt: skip
    slave.instantiate()
    slave.setupExperiment(startTime=0.0)
    slave.enterInitializationMode()
    return slave, {v.name: v.valueReference for v in description.modelVariables}


def test_tunable_parameters_change_and_fixed_ones_do_not(sa8_fmu: Path) -> None:
    slave, refs = instance(sa8_fmu)
    slave.exitInitializationMode()
    slave.setReal([refs["velocity"]], [0.5])
    slave.doStep(0.0, 1e-3)
    slave.setReal([refs["friction.F_FrS"], refs["stroke"]], [0.0, 5e-4])
    slave.doStep(1e-3, 1e-3)
    assert slave.getReal([refs["force_friction"]]) == [0.0]
    with pytest.raises(FMICallException):  # the native kind refuses the value, the Python kind the step
        slave.setReal([refs["friction.F_FrS"], refs["stroke"]], [-1.0, 1e-3])
        slave.doStep(2e-3, 1e-3)
    assert slave.getReal([refs["friction.F_FrS"]]) == [0.0]
    with pytest.raises(FMICallException):
        slave.setReal([refs["oil_level"]], [0.5])
        slave.doStep(2e-3, 1e-3)
    slave.doStep(2e-3, 1e-3)
    slave.terminate()
    slave.freeInstance()


def test_state_can_be_kept_restored_and_serialised(sa8_fmu: Path) -> None:
    slave, refs = instance(sa8_fmu)
    slave.setReal([refs["oil_level"]], [0.56])
    slave.setReal([refs["gas_preload"]], [0.0])
    slave.exitInitializationMode()

    def go(start: int, end: int) -> list[float]:
        forces = []
        for i in range(start, end):
            slave.setReal([refs["stroke"], refs["velocity"]], list(motion(i, 1e-3)))
            slave.doStep(i * 1e-3, 1e-3)
            forces += slave.getReal([refs["force"]])
        return forces

    go(0, 300)
    kept = slave.getFMUState()
    first = go(300, 600)
    slave.setFMUState(kept)
    assert go(300, 600) == first
    stored = slave.serializeFMUstate(kept)
    go(600, 700)
    slave.setFMUState(slave.deSerializeFMUstate(stored))
    assert go(300, 600) == first
    slave.freeFMUState(kept)
    slave.terminate()
    slave.freeInstance()


def test_reset_starts_again(sa8_fmu: Path) -> None:
    slave, refs = instance(sa8_fmu)
    slave.exitInitializationMode()
    slave.setReal([refs["velocity"]], [0.5])
    slave.doStep(0.0, 1e-3)
    slave.reset()
    slave.setupExperiment(startTime=0.0)
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    assert slave.getReal([refs["work"], refs["velocity"]]) == [0.0, 0.0]
    slave.terminate()
    slave.freeInstance()


def test_a_wrong_sign_of_the_velocity_is_noticed(sa8_fmu: Path) -> None:
    with DamperFmu(sa8_fmu, **DEGRADED) as damper:
        for i in range(200):
            z, v = motion(i, 1e-2)
            damper.step(z, -v, 1e-2)
        assert any("check sign, unit and connection" in message for message in damper.messages)
        assert len(damper.messages) == 2 and "communication step = 0.01 s" in damper.messages[0]
