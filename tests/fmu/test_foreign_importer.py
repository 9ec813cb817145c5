"""The FMU in importers that are neither fmpy nor Python: DNV's libcosim and NTNU's ecos."""

from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

from twintube.core.kernel import fill, prepare, step
from twintube.core.variables import Derived, Flow, State, blank
from twintube.dampers import load
from twintube.fmu.table import variables

DT = 1e-3
REFERENCE = {variable.name: i for i, variable in enumerate(variables(load("SA8")))}
STROKE, VELOCITY, FORCE, OIL_LEVEL = (REFERENCE[name] for name in ("stroke", "velocity", "force", "oil_level"))


def motion(i: int) -> tuple[float, float]:
    """Stroke and velocity at the start of step `i`."""
    return 0.4 * DT * min(i, 100) - 0.3 * DT * max(i - 100, 0), 0.4 if i < 100 else -0.3


def kernel_forces(steps: int, **changes: Any) -> Iterator[float]:
    """The interpreted kernel stepped as the FMU steps it."""
    p, d, s, f = load("SA8").with_(**changes).parameters, blank(Derived), blank(State), blank(Flow)
    prepare(p, d)
    fill(p, d, s, 0.0)
    step(p, d, s, f, 0.0, 0.0, 0.0)
    for i in range(steps):
        z, v = motion(i)
        step(p, d, s, f, z + v * DT, v, v)
        yield s.F_fluid + s.F_friction + s.F_gas


class Libcosim:
    """One damper in libcosim, with start values by value reference."""

    def __init__(self, fmu: Path, start: dict[int, float] | None = None) -> None:
        self.execution = CosimExecution.from_step_size(step_size=1_000_000)
        self.slave = self.execution.add_local_slave(CosimLocalSlave(fmu_path=str(fmu), instance_name="damper"))
        for reference, value in (start or {}).items():
            assert self.execution.real_initial_value(self.slave, reference, value)
        self.manipulator, self.observer = CosimManipulator.create_override(), CosimObserver.create_last_value()
        self.execution.add_manipulator(self.manipulator)
        self.execution.add_observer(self.observer)

    def step(self, stroke: float, velocity: float) -> bool:
        """Whether the step was accepted."""
        assert self.manipulator.slave_real_values(
            slave_index=self.slave, variable_references=[STROKE, VELOCITY], values=[stroke, velocity]
        )
        return bool(self.execution.step())

    @property
    def force(self) -> float:
        return float(self.observer.last_real_values(slave_index=self.slave, variable_references=[FORCE])[0])


def test_libcosim_gets_the_kernels_forces(sa8_fmu: Path) -> None:
    damper = Libcosim(sa8_fmu)
    for i, force in enumerate(kernel_forces(200)):
        assert damper.step(*motion(i))
        assert damper.force == force


def test_libcosim_sets_start_values(sa8_native: Path) -> None:
    damper = Libcosim(sa8_native, {OIL_LEVEL: 0.56})
    for i, force in enumerate(kernel_forces(200, oil_level=0.56)):
        assert damper.step(*motion(i))
        # libcosim's step is a difference of times, which rounding makes a little longer or shorter.
        assert damper.force == pytest.approx(force, rel=1e-9)


def test_a_refused_step_ends_libcosims_run_but_not_the_process(sa8_native: Path) -> None:
    damper = Libcosim(sa8_native)
    assert damper.step(0.0, 0.4)
    held = damper.force
    assert not damper.step(0.3, 0.4)
    assert damper.force == held
    del damper
    assert Libcosim(sa8_native).step(0.0, 0.4)


def test_ecos_gets_the_kernels_forces(sa8_fmu: Path, ecos: ModuleType) -> None:
    with ecos.EcosSimulationStructure() as structure:
        structure.add_model("damper", str(sa8_fmu))
        structure.add_parameter_set("worn", {"damper::oil_level": 0.56, "damper::gas_preload": 0})
        with ecos.EcosSimulation(DT, structure=structure) as run:
            assert run.init(parameter_set="worn")
            for i, force in enumerate(kernel_forces(200, oil_level=0.56, gas_preload=0)):
                z, v = motion(i)
                run.set_real("damper::stroke", z)
                run.set_real("damper::velocity", v)
                run.step()
                assert run.get_real("damper::force") == force
            run.terminate()
