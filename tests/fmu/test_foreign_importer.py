"""The FMU in an importer that is neither fmpy nor Python: DNV's libcosim."""

from pathlib import Path

from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

from twintube.kernel import fill, prepare, step
from twintube.parameters import load
from twintube.variables import Derived, Flow, State, blank

DT = 1e-3
STROKE, VELOCITY, FORCE = 0, 1, 2  # value references, in the order of the variables


def test_libcosim_gets_the_kernels_forces(sa8_fmu: Path) -> None:
    execution = CosimExecution.from_step_size(step_size=1_000_000)
    slave = execution.add_local_slave(CosimLocalSlave(fmu_path=str(sa8_fmu), instance_name="damper"))
    manipulator, observer = CosimManipulator.create_override(), CosimObserver.create_last_value()
    execution.add_manipulator(manipulator)
    execution.add_observer(observer)
    p, d, s, f = load("SA8").parameters, blank(Derived), blank(State), blank(Flow)
    prepare(p, d)
    fill(p, d, s, 0.0)
    step(p, d, s, f, 0.0, 0.0, 0.0)
    for i in range(200):
        v = 0.4 if i < 100 else -0.3
        z = 0.4 * DT * min(i, 100) - 0.3 * DT * max(i - 100, 0)
        assert manipulator.slave_real_values(slave_index=slave, variable_references=[STROKE, VELOCITY], values=[z, v])
        assert execution.step()
        step(p, d, s, f, z + v * DT, v, v)
        found = observer.last_real_values(slave_index=slave, variable_references=[FORCE])[0]
        assert found == s.F_fluid + s.F_friction + s.F_gas
