"""What `twintube simulate` does: a damper in a state, its motion, and the result as a table."""

import warnings
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from twintube.cli.states import gas_preload, in_kelvins, in_state
from twintube.errors import InputError, InputWarning

if TYPE_CHECKING:
    from collections.abc import Sequence

    from twintube.common.arrays import Array
    from twintube.dampers import Damper
    from twintube.data import Finding, Record
    from twintube.data.records.motion import Motion
    from twintube.engine.simulation import Simulation

ASSUMED = " (assumed, it is unknown there)"
COLUMN = "column"  # in place of a temperature: that of the record


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
    damper: "Damper",
    entry: "tuple[Damper, Record] | None",
    oil_level: float | None,
    gas_lost: bool | None,
    gas: float | None,
) -> "tuple[Damper, str]":
    """The damper in the state that is given, or that the dataset says, else as its parameter set; and the state in words."""
    if entry is not None:
        level, preload = entry[1].oil_level, entry[1].gas_preload
        unknown = [level is None and oil_level is None, preload is None and gas_preload(gas_lost, gas) is None]
        damper = damper.with_(oil_level=1.0 if level is None else level, gas_preload=1.0 if preload is None else preload)
    else:
        unknown = [False, False]
    state = in_state(damper, oil_level, gas_lost, gas)
    parts = zip(state.state.split(", "), unknown, strict=True)
    return state, ", ".join(text + ASSUMED * assumed for text, assumed in parts)


def block_motion(velocity: float, amplitude_mm: float) -> "Motion":
    """A harmonic block with its preconditioning; raises InputError."""
    from twintube.data.records.motion import Motion
    from twintube.rig import signals

    signal = signals.harmonic_block(velocity, amplitude_mm * 1e-3)
    return Motion(signal.time, signal.stroke, signal.velocity)


def driven_by(
    damper: "Damper", entry: "tuple[Damper, Record] | None", record: Path, block: int | None
) -> "tuple[Motion | Record, Sequence[Finding]]":
    """The motion or record in a file, of the damper's fill, and findings on how it was read."""
    from twintube.data.records.motion import read_moved

    fill = damper.parameters.oil_level, damper.parameters.gas_preload
    if entry is None:
        return read_moved(record, fill, block)
    return replace(entry[1], oil_level=fill[0], gas_preload=fill[1]), entry[1].findings


def in_words(temperature: str | None) -> str:
    """What `--temperature` asks for, behind the state of a damper."""
    if temperature is None:
        return ""
    return ", temperatures of the record" if temperature == COLUMN else f", {temperature} degC"


def kelvins(given: str | None, motion: "Motion | Record", record: Path | None) -> "Array | None":
    """The temperatures (n,) [K] that `--temperature` asks for, None where it does not; raises InputError."""
    import numpy as np

    if given is None:
        return None
    if given != COLUMN:
        try:
            degC = float(given)
        except ValueError:
            raise InputError(f"--temperature {given}: must be a number of degC, or {COLUMN}") from None
        return np.full(len(motion.time), in_kelvins(degC))
    if motion.temperature is None:
        where = f"{record} has none" if record is not None else "a block has none, give --record"
        raise InputError(f"--temperature {COLUMN}: is the column of temperatures of a record; {where}")
    return np.array([in_kelvins(x, f"{record}, sample {i}: temperature") for i, x in enumerate(motion.temperature.tolist())])


def run(damper: "Damper", motion: "Motion | Record", temperature: "Array | None") -> "Simulation":
    """The simulation of a motion as it stands, or of a record as it is identified from."""
    from twintube.data import Record
    from twintube.engine.simulate import simulate_quietly

    if isinstance(motion, Record):
        from twintube.fitting import prediction

        return prediction.driven(damper, prediction.calm(motion), temperature)
    return simulate_quietly(damper, motion.stroke, motion.velocity, motion.time, temperature=temperature)


def warn(damper: "Damper", motion: "Motion | Record", result: "Simulation", record: Path | None) -> None:
    """Warn where stroke and velocity of a motion do not agree, and where the law of a damper does not hold."""
    from twintube.engine.simulate import beyond_law, disagreement

    for doubtful in (disagreement(motion.time, motion.stroke, motion.velocity), beyond_law(damper, result)):
        if doubtful:
            warnings.warn(f"{'' if record is None else f'{record}: '}{doubtful}", InputWarning, stacklevel=1)


def as_csv(result: "Simulation", motion: "Motion | Record", temperature: "Array | None", *, for_fmu: bool) -> str:
    """The columns of the result and the measured force as CSV, named as the FMU's variables; `for_fmu` without units."""
    from twintube.core.variables import Outputs, fmi_name
    from twintube.data import Record

    names = {item.name: fmi_name(item) for item in fields(Outputs)}
    head = ["time [s]", "stroke [m]", "velocity [m/s]"]
    columns: list[Any] = [motion.time, result.stroke, result.velocity]
    if temperature is not None:
        head.append("temperature [K]")
        columns.append(temperature)
    for name, values in result.columns.items():
        head.append(f"{names[name]} [{result.units[name]}]")
        columns.append(values)
    if isinstance(motion, Record):
        head.append("measured_force [N]")
        columns.append(motion.force)
    if for_fmu:
        head = [title.partition(" ")[0] for title in head]
    lines = [",".join(head)] + [",".join(f"{x:.9g}" for x in row) for row in zip(*columns, strict=True)]
    return "\n".join(lines) + "\n"


def against_measured(damper: "Damper", record: "Record", result: "Simulation", temperature: "Array | None") -> str:
    """How far the simulated force is from the measured one."""
    from twintube.fitting import prediction
    from twintube.report.simulated_record import deviation

    return deviation(*prediction.compared(damper, record, result, temperature)).sentence


def drawn(name: str, motion: "Motion | Record", result: "Simulation") -> bytes:
    """A picture of the simulation, beside the measurement where there is one."""
    import numpy as np

    from twintube.data import Record
    from twintube.report.common.style import png
    from twintube.report.simulated_record import figure

    whole = np.ones(len(motion.time), dtype=bool)
    measured, usable = (motion.force, motion.usable) if isinstance(motion, Record) else (None, whole)
    inputs = name, motion.time, motion.stroke, result.velocity
    return png(figure(*inputs, simulated=result.force, measured=measured, usable=usable))
