"""What the model says about a record: the one way from a parameter set to a force that is compared with a measured one.

`identify` validates by it and `simulate --record` reports by it, so that both have the same error for the same record.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array
from twintube.dampers import Damper
from twintube.dampers.gas_spring import at_pressure
from twintube.data import Record
from twintube.engine.simulate import InputError, simulate_quietly
from twintube.engine.simulation import Simulation
from twintube.fitting.averaging import averaged
from twintube.fitting.harmonic import Harmonic
from twintube.fitting.oscillations import harmonic, smooth_velocity
from twintube.fitting.simulation import tolerant
from twintube.fitting.strokes import quiet


def state(damper: Damper, level: float, preload: float, pressure: float | None = None) -> Damper:
    """The damper in the condition of a record, for a measured velocity; `pressure` [Pa] is that of present gas, gauge."""
    filled = damper.with_(oil_level=level, gas_preload=preload)
    return tolerant(at_pressure(filled, pressure) if preload else filled)


def calm(record: Record) -> Record:
    """The record with a stroke free of noise."""
    return replace(record, stroke=quiet(record.time, record.stroke))


def driven(damper: Damper, record: Record, temperature: Array | None = None) -> Simulation:
    """The model over a record's stroke from end to end, at temperatures (n,) [K]."""
    condition = state(damper, *record.fill, record.gas_pressure)
    return simulate_quietly(condition, record.stroke, smooth_velocity(record), record.time, temperature=temperature)


def predicted(damper: Damper, record: Harmonic, offset: float, temperature: Array | None = None) -> Array:
    """What the force channel would show of the model (n,) [N]: with its zero and through its moving mean."""
    condition = state(damper, record.oil_level, record.gas_preload, record.gas_pressure)
    force = simulate_quietly(condition, record.stroke, record.velocity, record.time, temperature=temperature).force
    return averaged(record.time, force + offset, record.averaged)


def compared(
    damper: Damper, record: Record, simulation: Simulation, temperature: Array | None = None
) -> tuple[Array, Array, Array, NDArray[np.bool_]]:
    """Stroke [m], measured and simulated force [N] and which samples count, all (m,), as `identify` compares them.

    Of a harmonic record these are the measured oscillations, without what leads to them; of others, and where there is no
    full oscillation, the whole `simulation` of the record made `calm`. `temperature` (n,) [K] is that of the simulation.
    """
    if record.measurement == "harmonic":
        try:
            block = harmonic(record)
        except InputError:
            return record.stroke, record.force, simulation.force, record.usable
        span = slice(int(block.marks[0]), int(block.marks[-1]) + 1)
        along = None if temperature is None else np.interp(block.time, record.time, temperature)
        return block.stroke[span], block.force[span], predicted(damper, block, 0.0, along)[span], block.counts(span)
    return record.stroke, record.force, simulation.force, record.usable
