"""A study read from TOML and checked before anything is computed.

```toml
title = "Cavitation of two dampers"
dampers = ["SA8", "mine.toml"]          # names, or parameter files relative to this file
oil_level = [0.4, 0.6]                  # or {from = 0.0, to = 1.0, count = 11}
gas_preload = [0]                       # left out: lost in every state below 100 % oil, as the paper measured
variant = [2, 3, 4]                     # left out: the complete model
velocity = ["50 mm/s", 1.572]           # harmonic blocks; left out: those of the paper
amplitude = ["45 mm"]                   # of the blocks
records = ["drive.csv"]                 # instead of blocks or beside them: measured strokes
oscillations = [1, 19]                  # rows per block; "all" for 1 to 19
time_step = "0.5 ms"
[parameters]
"cavitation.Y_Re_cav" = [0.0, 0.1, 0.2] # any parameter, by its name in the FMU
```

The grid is the product of all lists. Nothing but `dampers` is required.
"""

import hashlib
import itertools
import json
import math
import tomllib
from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np

from twintube import dampers
from twintube.core.checks import outside, problems, tube_limit
from twintube.dampers import Damper, ParameterError
from twintube.dampers.damper import suggestion
from twintube.dampers.quantity import quantity
from twintube.dampers.toml import line_of
from twintube.data.record import read_csv
from twintube.engine.simulate import InputError, checked
from twintube.rig.signals import AMPLITUDE, BLOCKS, OSCILLATIONS, V_PRECONDITIONING
from twintube.studies.definition import FIELDS, Signal, Study, StudyError

MAX_CASES = 1_000_000
MAX_SAMPLES = 4_000_000  # of a block, 0.5 GB of results
TIME_STEP = 5e-4  # [s]
VARIABLE = {name for name, item in FIELDS.items() if item.metadata["group"] and item.metadata["size"] == 1}
# Lists of numbers: unit, lower and upper bound of each.
AXES: dict[str, tuple[str, float, float]] = {
    "oil_level": ("1", 0.0, 1.0),
    "gas_preload": ("1", 0, 1),
    "variant": ("1", 1, 4),
    "velocity": ("m/s", 0.001, 20.0),
    "amplitude": ("m", 1e-4, 0.5),
    "oscillations": ("1", 1, OSCILLATIONS),
    "time_step": ("s", 1e-5, 1e-2),
}
INTEGER = ("gas_preload", "variant", "oscillations")
KEYS = {*AXES, "title", "dampers", "records", "parameters"}


def variants() -> dict[str, Any]:
    """Figure 33: the model variants at the measured 60 % state."""
    levels = [dampers.load("SA8").measured_levels[0]]
    return {"title": "Figure 33: model variants", "dampers": ["SA8"], "oil_level": levels, "variant": [1, 2, 3, 4]}


def oil_levels() -> dict[str, Any]:
    """Figure 34: oil levels from 0 to 100 %."""
    levels = {"from": 0.0, "to": 1.0, "count": 11}
    return {"title": "Figure 34: oil levels", "dampers": ["SA8"], "oil_level": levels}


NAMED: dict[str, Callable[[], dict[str, Any]]] = {"variants": variants, "oil_levels": oil_levels}


def load(study: str | Path) -> Study:
    """A named study (`"variants"`) or a study file; raises StudyError."""
    if str(study) in NAMED:
        return from_content(NAMED[str(study)](), "", str(study), Path())
    path = Path(study)
    if not path.is_file():
        raise StudyError(
            f"unknown study {study}: neither a file nor one of {', '.join(NAMED)}{suggestion(str(study), NAMED)}"
        )
    try:
        text = path.read_text(encoding="utf-8")
        content = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise StudyError(f"{path.name}: {error}") from error
    return from_content(content, text, path.name, path.parent)


def numbers(raw: Any, unit: str) -> list[float]:
    """The SI values of a list, a single value or `{from, to, count}`; raises ValueError."""
    if isinstance(raw, dict):
        if set(raw) != {"from", "to", "count"}:
            raise ValueError(f"a range has the keys from, to and count, not {', '.join(raw) or 'none'}")
        count = raw["count"]
        if type(count) is not int or not 1 <= count <= MAX_CASES:
            raise ValueError(f"count = {count!r}: must be an integer from 1 to {MAX_CASES}")
        low, high = quantity(raw["from"], unit), quantity(raw["to"], unit)
        found = [float(f"{x:.15g}") for x in np.linspace(low, high, count)]  # 0.3, not 0.30000000000000004
    else:
        found = [quantity(value, unit) for value in (raw if isinstance(raw, list) else [raw])]
    if not found:
        raise ValueError("the list is empty, so there would be no case")
    repeated = [x for x in found if found.count(x) > 1] if len(found) <= 1000 else []
    if repeated or len(set(found)) < len(found):
        raise ValueError(f"a value stands in the list twice{f': {repeated[0]:g}' if repeated else ''}")
    return found


def strings(raw: Any) -> list[str]:
    """A list of names without repetition; raises ValueError."""
    found = [raw] if isinstance(raw, str) else raw
    if not isinstance(found, list) or not found or not all(isinstance(name, str) for name in found):
        raise ValueError("must be a list of at least one string")
    for name in found:
        if found.count(name) > 1:
            raise ValueError(f"{name} stands in the list twice")
    return found


def bounded(name: str, raw: Any, unit: str, lower: float | None, upper: float | None, integer: bool) -> list[float]:
    """The values of an axis within their bounds; raises ValueError."""
    try:
        found = numbers(raw, unit)
    except (ValueError, TypeError) as error:
        raise ValueError(f"{name}: {error}") from error
    for value in found:
        message = outside(name, value, lower, upper, unit)
        if message:
            raise ValueError(message)
        if integer and value != int(value):
            raise ValueError(f"{name} = {value:g}: must be an integer")
    return [int(value) for value in found] if integer else found


def flattened(table: dict[str, Any], prefix: str = "") -> dict[str, Any]:
    """`{"foam": {"B": x}}`, which TOML makes of an unquoted `foam.B`, as `{"foam.B": x}`."""
    flat: dict[str, Any] = {}
    for key, value in table.items():
        if isinstance(value, dict) and set(value) != {"from", "to", "count"} and prefix + key not in FIELDS:
            flat |= flattened(value, f"{prefix}{key}.")
        else:
            flat[prefix + key] = value
    return flat


def from_content(content: dict[str, Any], text: str, file: str, folder: Path) -> Study:
    """A study from parsed TOML; `text` and `file` serve the messages only, `folder` is where its files are."""
    found = [f"{line_of(text, '', key)}unknown {key}{suggestion(key, KEYS)}" for key in content if key not in KEYS]
    content = {"variant": [4], "oil_level": [1.0], "amplitude": [AMPLITUDE], "oscillations": [1, 19]} | content
    content = {"title": Path(file).stem, "time_step": TIME_STEP} | content
    if "velocity" not in content and "records" not in content:
        content["velocity"] = list(BLOCKS)
    if content["oscillations"] == "all":
        content["oscillations"] = {"from": 1, "to": OSCILLATIONS, "count": OSCILLATIONS}

    axes: dict[str, list[Any]] = {"gas_preload": [], "velocity": []}
    for key, (unit, lower, upper) in AXES.items():
        if key in content:
            try:
                axes[key] = bounded(key, content[key], unit, lower, upper, key in INTEGER)
            except ValueError as error:
                found.append(line_of(text, "", key) + str(error))
    if len(axes.get("time_step", [0])) != 1:
        found.append(line_of(text, "", "time_step") + "time_step: must be one value")
    dampers = read_dampers(content, text, folder, found)
    records = read_records(content, text, folder, found)
    varied = read_parameters(content, text, found)
    refuse(file, found)

    blocks = [Signal(f"harmonic {v:g} m/s {z * 1e3:g} mm", v, z) for v in axes["velocity"] for z in axes["amplitude"]]
    definition = {
        "title": str(content["title"]),
        "dampers": {damper.name: asdict(damper.parameters) for damper in dampers},
        "records": {record.name: digest(record) for record in records},
        "parameters": varied,
        **axes,
    }
    study = Study(
        title=str(content["title"]),
        dampers=dampers,
        signals=(*blocks, *records),
        parameters=varied,
        oil_levels=tuple(axes["oil_level"]),
        gas_preload=tuple(axes["gas_preload"]),
        variants=tuple(axes["variant"]),
        oscillations=tuple(sorted(axes["oscillations"])),
        time_step=axes["time_step"][0],
        text=json.dumps(definition),
    )
    total = math.prod(study.shape)
    if total > MAX_CASES:
        raise StudyError(f"{file}: the grid has {total} cases, at most {MAX_CASES} are possible; shorten a list or split it")
    refuse(file, misfits(study))
    return study


def digest(record: Signal) -> str:
    """SHA-256 of a record's samples."""
    return hashlib.sha256(record.time.tobytes() + record.stroke.tobytes() + record.speed.tobytes()).hexdigest()


def refuse(file: str, found: list[str]) -> None:
    """Raise StudyError with all messages, if there are any."""
    if found:
        raise StudyError(f"{file}: " + "; ".join(found))


def read_dampers(content: dict[str, Any], text: str, folder: Path, found: list[str]) -> tuple[Damper, ...]:
    """The dampers without their sources, which no worker needs; messages go to `found`."""
    line = line_of(text, "", "dampers")
    if "dampers" not in content:
        found.append("dampers is missing")
        return ()
    read: list[Damper] = []
    try:
        for name in strings(content["dampers"]):
            one = dampers.load(name if name in dampers.names() else folder / name)
            read.append(replace(one, sources={}, assumed={}))
    except ParameterError as error:
        found.append(f"{line}dampers: {error}")
    except (ValueError, OSError) as error:
        found.append(f"{line}dampers: {error}")
    names = [damper.name for damper in read]
    if len(set(names)) < len(names):
        found.append(f"{line}dampers: two of them have one name among {', '.join(names)}")
    return tuple(read)


def read_records(content: dict[str, Any], text: str, folder: Path, found: list[str]) -> tuple[Signal, ...]:
    """The measured strokes; messages go to `found`."""
    line = line_of(text, "", "records")
    read: list[Signal] = []
    try:
        for name in strings(content["records"]) if "records" in content else []:
            time, stroke, speed = read_csv(folder / name)
            read.append(Signal(name, time=time, stroke=stroke, speed=speed))
    except (ValueError, OSError) as error:
        found.append(f"{line}records: {error}")
    return tuple(read)


def read_parameters(content: dict[str, Any], text: str, found: list[str]) -> dict[str, tuple[float, ...]]:
    """The lists of the table `parameters`; messages go to `found`."""
    table = content.get("parameters", {})
    if not isinstance(table, dict):
        found.append(f"{line_of(text, '', 'parameters')}parameters: must be a table")
        return {}
    varied: dict[str, tuple[float, ...]] = {}
    for name, raw in flattened(table).items():
        line = line_of(text, "parameters", name)
        if name in ("oil_level", "gas_preload"):
            found.append(f"{line}parameters.{name}: belongs to the top of the file, not to parameters")
        elif name not in VARIABLE:
            curve = name in FIELDS
            hint = ", a curve and not one number" if curve else suggestion(name, VARIABLE)
            found.append(f"{line}{'' if curve else 'unknown '}parameters.{name}{hint}")
        else:
            meta = FIELDS[name].metadata
            try:
                varied[name] = tuple(bounded(name, raw, meta["unit"], meta["lower"], meta["upper"], meta["integer"]))
            except ValueError as error:
                found.append(f"{line}parameters.{error}")
    return varied


def misfits(study: Study) -> list[str]:
    """Messages where values that are each within bounds do not fit together, or a signal leaves the tube.

    Only the geometry's parameters depend on each other, so only their product is tried.
    """
    names = [name for name in study.parameters if FIELDS[name].metadata["group"] == "geometry"]
    amplitudes = [signal.amplitude for signal in study.signals if not signal.stroke.size]
    for damper, values in itertools.product(study.dampers, itertools.product(*(study.parameters[n] for n in names))):
        changes: dict[str, Any] = {FIELDS[n].name: x for n, x in zip(names, values, strict=True)}
        p = replace(damper.parameters, **changes)
        where = damper.name + "".join(f", {n} = {x:g}" for n, x in zip(names, values, strict=True))
        found = problems(p)
        if found:
            return [f"{where}: {found[0]}"]
        limit = tube_limit(p)
        for amplitude in amplitudes:
            message = outside("amplitude", amplitude, 0.0, limit, "m")
            if message:
                return [f"{where}: {message}"]
        for signal in study.signals:
            samples = signal.samples(study.time_step)
            if samples > MAX_SAMPLES:
                return [f"{signal.name}: {samples:.0f} samples, at most {MAX_SAMPLES} are possible; raise time_step"]
            if signal.stroke.size:
                try:
                    checked(signal.stroke, signal.speed, limit)
                    checked([AMPLITUDE], [V_PRECONDITIONING], limit)
                except InputError as error:
                    return [f"{where}: {signal.name}: {error}"]
    return []
