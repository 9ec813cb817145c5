"""The module computes the numbers of the native FMU, and its quarter car those of the package."""

import ctypes
from collections.abc import Sequence
from dataclasses import astuple
from pathlib import Path
from typing import Any

import fmpy
import numba
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave

from tests.explorer.wasm import Module
from twintube.common.arrays import Array
from twintube.dampers import Damper, load, names
from twintube.fmu.table import variables
from twintube.rig.plan import amplitude, at_oil_level, oil_levels, velocities
from twintube.rig.signals import harmonic_block
from twintube.vehicle.cars import load_car
from twintube.vehicle.drive import CONDITIONING_STEP, conditioning, drive
from twintube.vehicle.ride import track

REFERENCE = {variable.name: i for i, variable in enumerate(variables(load("SA8")))}
VOLUMES = [f"V{chamber}.{phase}" for chamber in (1, 2, 3) for phase in ("oil", "gas", "foam")]
OUTPUTS = [REFERENCE[name] for name in ("force", "k_degr", *VOLUMES)]
DT = 8e-3  # [s]; coarse, as rounding and not the sampling is tested
ROUNDING = 1e-12  # of each quantity's scale: C libraries differ in the last bit of exp and pow


def parameters(damper: Damper) -> tuple[dict[int, float], dict[int, int]]:
    """The parameters of a damper by value reference: those of Real and of Integer variables."""
    reals, integers = {}, {}
    for i, variable in enumerate(variables(damper)):
        if variable.causality == "parameter" and variable.integer:
            integers[i] = int(variable.start or 0)
        elif variable.causality == "parameter":
            reals[i] = float(variable.start or 0.0)
    return reals, integers


class Native:
    """The library of an FMU, stepped by a compiled loop."""

    def __init__(self, fmu: Path) -> None:
        description = fmpy.read_model_description(str(fmu))
        assert description.coSimulation is not None
        self.slave = FMU2Slave(guid=description.guid, unzipDirectory=fmpy.extract(str(fmu)),
                               modelIdentifier=description.coSimulation.modelIdentifier, instanceName="x")  # fmt: skip
        self.slave.instantiate()
        unit = ctypes.c_void_p
        for name, kinds in {
            "fmi2SetReal": [unit, unit, ctypes.c_size_t, unit],
            "fmi2GetReal": [unit, unit, ctypes.c_size_t, unit],
            "fmi2SetRealInputDerivatives": [unit, unit, ctypes.c_size_t, unit, unit],
            "fmi2DoStep": [unit, ctypes.c_double, ctypes.c_double, ctypes.c_int],
        }.items():
            function = getattr(ctypes.CDLL(self.slave.dll._name), name)
            function.argtypes, function.restype = kinds, ctypes.c_int
            setattr(self, name, function)
        self.loop = self.compiled()

    def compiled(self) -> Any:
        set_real, get_real, do_step = self.fmi2SetReal, self.fmi2GetReal, self.fmi2DoStep  # type: ignore[attr-defined]
        set_rate = self.fmi2SetRealInputDerivatives  # type: ignore[attr-defined]

        @numba.njit
        def loop(  # noqa: PLR0917 - compiled by numba
            unit: int, t: Array, z: Array, v: Array, wanted: Array, out: Array
        ) -> int:  # pragma: no cover
            inputs, order = np.array([0, 1], np.uint32), np.array([1], np.int32)
            values, rate, row = np.zeros(2), np.zeros(1), np.zeros(len(wanted))
            worst = get_real(unit, wanted.ctypes.data, len(wanted), row.ctypes.data)
            out[:, 0] = row
            for i in range(len(t) - 1):
                h = t[i + 1] - t[i]
                values[0], values[1] = z[i], v[i]
                rate[0] = (v[i + 1] - v[i]) / h if h > 0.0 else 0.0
                worst = max(worst, set_real(unit, inputs.ctypes.data, 2, values.ctypes.data))
                if rate[0] != 0.0:
                    worst = max(worst, set_rate(unit, inputs[1:].ctypes.data, 1, order.ctypes.data, rate.ctypes.data))
                worst = max(worst, do_step(unit, t[i], h, 1))
                worst = max(worst, get_real(unit, wanted.ctypes.data, len(wanted), row.ctypes.data))
                out[:, i + 1] = row
            return worst

        return loop

    def record(
        self, damper: Damper | None, time: Array, stroke: Array, velocity: Array, wanted: Sequence[int] = OUTPUTS
    ) -> Array:
        """The wanted outputs; without a damper, of the one that was built in."""
        self.slave.reset()
        reals, integers = parameters(damper) if damper is not None else ({}, {})
        self.slave.setReal([*reals, 0], [*reals.values(), float(stroke[0])])
        self.slave.setInteger(list(integers), list(integers.values()))
        self.slave.setupExperiment(startTime=float(time[0]))
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
        out = np.zeros((len(wanted), len(time)))
        signal = [np.array(values) for values in (time, stroke, velocity)]
        assert self.loop(self.slave.component, *signal, np.array(wanted, np.uint32), out) <= 1
        return out


def test_the_module_equals_the_native_unit_over_the_harmonic_plan(sa8_native: Path) -> None:
    module, native = Module(), Native(sa8_native)
    largest = np.zeros(3)
    for damper in map(load, names()):
        for level in oil_levels(damper):
            state = at_oil_level(damper, level)
            for v in velocities(damper):
                block = harmonic_block(v, amplitude(damper), DT)
                expected = native.record(state, block.time, block.stroke, block.velocity)
                found = module.record(module.unit(*parameters(state)), block.time, block.stroke, block.velocity, OUTPUTS)
                apart = np.abs(found - expected).max(axis=1)
                scales = (np.abs(expected[0]).max(), 1.0, damper.parameters.V_oil)
                shares = [apart[0] / scales[0], apart[1] / scales[1], apart[2:].max() / scales[2]]
                largest = np.maximum(largest, shares)
                assert max(shares) <= ROUNDING, (damper.name, level, v, shares)
    print(f"largest differences of force, k_degr, volumes: {largest}")


@pytest.mark.parametrize("name", ["SA8", "SA7"])
def test_the_quarter_car_of_the_module_is_that_of_the_package(name: str) -> None:
    damper = load(name).with_(oil_level=0.5, gas_preload=0)
    corner, route = load_car().corner(damper), track(50.0, 6.0)
    expected = drive(damper, corner, route.heights, route.dt, rates=route.rates, preconditioned=True)
    module, n = Module(), len(route.heights)
    unit = module.unit(*parameters(damper))
    slow = conditioning()
    times = (np.arange(len(slow)) - len(slow) + 1) * CONDITIONING_STEP
    assert module.call("start_unit", unit, float(times[0]), 0.0) == 1
    assert module.call("run_record", unit, len(slow), module.place(times), module.place(slow), 0, 0, 0, 0) == len(slow)
    car, out = module.place(astuple(corner)), module.place(np.zeros(5 * n))
    inputs = [module.place(route.heights), module.place(route.rates)]
    wanted = module.place([REFERENCE["force"], REFERENCE["work"]], np.uint32)
    assert module.call("run_drive", unit, car, n, 0.0, route.dt, *inputs, wanted, 2, out) == n
    force, work, stroke, velocity, load_ = module.view(out, 5 * n).reshape(5, n)
    pairs = {"force": force, "work": work - work[0], "stroke": stroke, "velocity": velocity, "wheel_load": load_}
    for quantity, found in pairs.items():
        wanted_values = getattr(expected, quantity)
        # The loop feeds rounding back, over 6000 steps.
        assert np.abs(found - wanted_values).max() <= 1e-9 * np.abs(wanted_values).max(), quantity
