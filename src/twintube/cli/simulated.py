"""What `twintube simulate` does: a damper in a state, its motion, and the result as a table."""

import warnings
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from twintube.errors import InputError, InputWarning

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from twintube.dampers import Damper
    from twintube.data import Record
    from twintube.data.records.motion import Motion
    from twintube.engine.simulation import Simulation

ASSUMED = " (assumed, it is unknown there)"


def listed(record: Path | None, block: int | None) -> "tuple[Damper, Record] | None":
    """Damper and record as the dataset.toml beside a file says, None where none does; raises InputError."""
    from twintube.data import listed_record

    if record is not None and not record.exists():
        raise InputError(f"{record}: the file does not exist")
    return None if record is None else listed_record(record, block)


def named(damper: str | None, record: Path | None, entry: "tuple[Damper, Record] | None") -> "Damper":
    """The damper that is named, or that of the dataset; raises InputError."""
    from twintube import dampers

    if damper is not None:
        return dampers.load(damper)
    if entry is None:
        where = "" if record is None else f"no dataset.toml in the folder of {record} names it; "
        raise InputError(f"{where}name a damper, e.g. twintube simulate SA8")
    return entry[0]


def filled(
    damper: "Damper", entry: "tuple[Damper, Record] | None", oil_level: float | None, gas_lost: bool | None
) -> "tuple[Damper, Record | None, str]":
    """Damper and record in the state that is given, or that the dataset says, and the state in words."""
    level = oil_level if oil_level is not None else entry[1].oil_level if entry else None
    preload = not gas_lost if gas_lost is not None else entry[1].gas_preload if entry else None
    assumed = [ASSUMED if value is None else "" for value in (level, preload)]
    level, preload = 1.0 if level is None else level, preload is not False
    text = f"{100 * level:.4g} % of the oil{assumed[0]}, gas {'present' if preload else 'lost'}{assumed[1]}"
    measured = None if entry is None else replace(entry[1], oil_level=level, gas_preload=preload)
    return damper.with_(oil_level=level, gas_preload=int(preload)), measured, text


def motion_of(measured: "Record") -> "Motion":
    """The motion of a record."""
    from twintube.data.records.motion import Motion

    return Motion(measured.time, measured.stroke, measured.velocity, measured.force)


def block_motion(velocity: float, amplitude_mm: float) -> "Motion":
    """A harmonic block with its preconditioning; raises InputError."""
    from twintube.data.records.motion import Motion
    from twintube.rig import signals

    signal = signals.harmonic_block(velocity, amplitude_mm * 1e-3)
    return Motion(signal.time, signal.stroke, signal.velocity, None)


def run(damper: "Damper", motion: "Motion", measured: "Record | None") -> "Simulation":
    """The simulation of a motion, or of a record as it is identified from."""
    from twintube.engine.simulate import simulate_quietly
    from twintube.fitting import prediction

    if measured is None:
        return simulate_quietly(damper, motion.stroke, motion.velocity, motion.time)
    return prediction.driven(damper, prediction.calm(measured))


def warn(motion: "Motion", record: Path | None) -> None:
    """Warn where stroke and velocity of a motion do not agree."""
    from twintube.engine.simulate import disagreement

    if doubtful := disagreement(motion.time, motion.stroke, motion.velocity):
        warnings.warn(f"{'' if record is None else f'{record}: '}{doubtful}", InputWarning, stacklevel=1)


def as_csv(result: "Simulation", motion: "Motion", *, for_fmu: bool) -> str:
    """The columns of the result and the measured force as CSV, `for_fmu` under the names of the FMU's variables."""
    from twintube.core.variables import Outputs, fmi_name

    head = ["time [s]", "stroke [m]", "velocity [m/s]"]
    columns: list[Any] = [motion.time, result.stroke, result.velocity]
    for name, values in result.columns.items():
        head.append(f"{name} [{result.units[name]}]")
        columns.append(values)
    if motion.force is not None:
        head.append("measured_force [N]")
        columns.append(motion.force)
    if for_fmu:
        fmu_names = {item.name: fmi_name(item) for item in fields(Outputs)}
        head = [fmu_names.get(name, name) for name in (title.partition(" ")[0] for title in head)]
    lines = [",".join(head)] + [",".join(f"{x:.9g}" for x in row) for row in zip(*columns, strict=True)]
    return "\n".join(lines) + "\n"


def usable(motion: "Motion", measured: "Record | None") -> "NDArray[np.bool_]":
    """The samples (n,) that count."""
    import numpy as np

    return np.ones(len(motion.time), dtype=bool) if measured is None else measured.usable


def against_measured(damper: "Damper", motion: "Motion", measured: "Record | None", result: "Simulation") -> str:
    """How far the simulated force is from the measured one."""
    from twintube.fitting import prediction
    from twintube.report.simulated_record import deviation

    if measured is not None:
        return deviation(*prediction.compared(damper, measured, result)).sentence
    assert motion.force is not None
    return deviation(motion.stroke, motion.force, result.force, usable(motion, None)).sentence
