"""A study read from TOML and checked before anything is computed.

```toml
title = "Cavitation of two dampers"
dampers = ["SA8", "mine.toml"]          # names, or parameter files relative to this file
oil_level = [0.4, 0.6]                  # or {from = 0.0, to = 1.0, count = 11}
gas_preload = [0]                       # left out: lost in every state below 100 % oil, as the paper measured
variant = [2, 3, 4]                     # left out: the complete model
velocity = ["50 mm/s", 1.572]           # harmonic blocks; left out: those of the paper
amplitude = ["45 mm"]                   # of the blocks
records = ["drive.csv"]                 # instead of blocks, or with a velocity in addition
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
from collections import Counter
from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from twintube import dampers
from twintube.common.reading import ReadError, read_toml
from twintube.common.words import short, shown
from twintube.core.checks import VELOCITY, outside, problems, tube_limit
from twintube.dampers import Damper
from twintube.dampers.damper import joined, suggestion
from twintube.dampers.toml import FEW_UNKNOWN, line_of
from twintube.data.records.motion import read_motion
from twintube.engine.simulate import InputError, checked
from twintube.rig.signals import AMPLITUDE, BLOCKS, OSCILLATIONS, V_PRECONDITIONING
from twintube.studies.definition import FIELDS, Signal, Study, StudyError
from twintube.studies.values import bounded, flattened, strings

MAX_CASES = 1_000_000
LONGEST_TITLE = 200  # characters
MAX_GEOMETRIES = 10_000  # products of dampers and geometries, each of which is checked
MAX_SAMPLES = 4_000_000  # of a block, 0.5 GB of results
TIME_STEP = 5e-4  # [s]
VARIABLE = {name for name, item in FIELDS.items() if item.metadata["group"] and item.metadata["size"] == 1}
# Lists of numbers: unit, lower and upper bound of each.
AXES: dict[str, tuple[str, float, float]] = {
    "oil_level": ("1", 0.0, 1.0),
    "gas_preload": ("1", 0.0, 1.0),
    "variant": ("1", 1, 4),
    "velocity": ("m/s", 0.001, VELOCITY["upper"]),
    "amplitude": ("m", 1e-4, 0.5),
    "oscillations": ("1", 1, OSCILLATIONS),
    "time_step": ("s", 1e-5, 1e-2),
}
INTEGER = ("variant", "oscillations")
KEYS = {*AXES, "title", "dampers", "records", "parameters", "as_published"}


def variants() -> dict[str, Any]:
    """Figure 33: the model variants at the measured 60 % state."""
    levels = [dampers.load("SA8").measured_levels[0]]
    return {"title": "Figure 33: model variants", "dampers": ["SA8"], "oil_level": levels, "variant": [1, 2, 3, 4],
            "as_published": True}  # fmt: skip


def oil_levels() -> dict[str, Any]:
    """Figure 34: oil levels from 0 to 100 %."""
    levels = {"from": 0.0, "to": 1.0, "count": 11}
    return {"title": "Figure 34: oil levels", "dampers": ["SA8"], "oil_level": levels, "as_published": True}


NAMED: dict[str, Callable[[], dict[str, Any]]] = {"variants": variants, "oil_levels": oil_levels}


def load(study: str | Path) -> Study:
    """A named study (`"variants"`) or a study file; raises StudyError."""
    if str(study) in NAMED:
        return from_content(NAMED[str(study)](), "", str(study), Path())
    path = Path(study)
    try:
        content, text = read_toml(path)
    except (FileNotFoundError, NotADirectoryError) as error:
        known = f"{', '.join(NAMED)}{suggestion(str(study), NAMED)}"
        raise StudyError(f"unknown study {short(str(study))}: neither a file nor one of {known}") from error
    except (ReadError, OSError) as error:
        raise StudyError(f"{short(path.name)}: {getattr(error, 'strerror', None) or error}") from error
    return from_content(content, text, path.name, path.parent)


def from_content(content: dict[str, Any], text: str, file: str, folder: Path) -> Study:
    """A study from parsed TOML; `text` and `file` serve the messages only, `folder` is where its files are."""
    unknown = [key for key in content if key not in KEYS]
    messages = [f"{line_of(text, '', key)}unknown {key}{suggestion(key, KEYS)}" for key in unknown[:FEW_UNKNOWN]]
    messages += [f"{len(unknown) - FEW_UNKNOWN} more unknown keys"] * (len(unknown) > FEW_UNKNOWN)
    content = {"variant": [4], "oil_level": [1.0], "amplitude": [AMPLITUDE], "oscillations": [1, 19]} | content
    content = {"title": Path(file).stem, "time_step": TIME_STEP} | content
    if "velocity" not in content and "records" not in content:
        content["velocity"] = list(BLOCKS)
    if content["oscillations"] == "all":
        content["oscillations"] = {"from": 1, "to": OSCILLATIONS, "count": OSCILLATIONS}
    title: Any = content["title"]
    if not isinstance(title, str) or len(title) > LONGEST_TITLE or "\n" in title:
        limit = f"a text of one line and at most {LONGEST_TITLE} characters"
        messages.append(f"{line_of(text, '', 'title')}title = {shown(title)}: must be {limit}")

    axes: dict[str, list[Any]] = {"gas_preload": [], "velocity": []}
    for key, (unit, lower, upper) in AXES.items():
        if key in content:
            try:
                axes[key] = bounded(key, content[key], unit, lower=lower, upper=upper, integer=key in INTEGER)
            except ValueError as error:
                messages.append(line_of(text, "", key) + str(error))
    if len(axes.get("time_step", [0])) != 1:
        messages.append(line_of(text, "", "time_step") + "time_step: must be a single value")
    dampers = read_dampers(content, text, folder, messages)
    records = read_records(content, text, folder, messages)
    varied = read_parameters(content, text, messages)
    refuse(file, messages)

    lengths = [len(axes[key] or [0]) for key in ("oil_level", "gas_preload", "variant")] + [len(v) for v in varied.values()]
    signals = len(axes["velocity"]) * len(axes["amplitude"]) + len(records)
    total = len(dampers) * signals * math.prod(lengths)
    if total > MAX_CASES:
        raise StudyError(f"{file}: the grid has {total} cases, at most {MAX_CASES} are possible; shorten a list or split it")
    blocks = [Signal(f"harmonic {v:g} m/s {z * 1e3:g} mm", v, z) for v in axes["velocity"] for z in axes["amplitude"]]
    definition = {
        "title": title,
        "dampers": {damper.name: asdict(damper.parameters) for damper in dampers},
        "records": {record.name: digest(record) for record in records},
        "parameters": varied,
        **axes,
    }
    study = Study(
        title=title,
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
    refuse(file, misfits(study))
    return study


def digest(record: Signal) -> str:
    """SHA-256 of a record's samples."""
    return hashlib.sha256(record.time.tobytes() + record.stroke.tobytes() + record.speed.tobytes()).hexdigest()


def refuse(file: str, messages: list[str]) -> None:
    """Raise StudyError with the messages, if there are any."""
    if messages:
        raise StudyError(f"{file}: {joined(messages)}")


def read_dampers(content: dict[str, Any], text: str, folder: Path, messages: list[str]) -> tuple[Damper, ...]:
    """The dampers without their sources, which no worker needs; messages go to `messages`."""
    line = line_of(text, "", "dampers")
    if "dampers" not in content:
        messages.append("dampers is missing")
        return ()
    published = content.get("as_published", False)
    if not isinstance(published, bool):
        messages.append(f"{line_of(text, '', 'as_published')}as_published = {shown(published)}: must be true or false")
        return ()
    read: list[Damper] = []
    try:
        for name in strings(content["dampers"]):
            damper = dampers.load(name if name in dampers.names() else folder / name, as_published=published)
            read.append(replace(damper, sources={}, assumed={}))
    except (ValueError, OSError) as error:
        messages.append(f"{line}dampers: {error}")
    for name, count in Counter(damper.name for damper in read).items():
        if count > 1:
            hint = "give each file its own `name`, which the rows of the result carry"
            messages.append(f"{line}dampers: {count} of them are named {name}: {hint}")
    return tuple(read)


def read_records(content: dict[str, Any], text: str, folder: Path, messages: list[str]) -> tuple[Signal, ...]:
    """The measured strokes; messages go to `messages`."""
    line = line_of(text, "", "records")
    read: list[Signal] = []
    try:
        for name in strings(content["records"]) if "records" in content else []:
            time, stroke, speed = read_motion(folder / name)
            read.append(Signal(name, time=time, stroke=stroke, speed=speed))
    except (ValueError, OSError) as error:
        messages.append(f"{line}records: {error}")
    return tuple(read)


def read_parameters(content: dict[str, Any], text: str, messages: list[str]) -> dict[str, tuple[float, ...]]:
    """The lists of the table `parameters`; messages go to `messages`."""
    table = content.get("parameters", {})
    if not isinstance(table, dict):
        messages.append(f"{line_of(text, '', 'parameters')}parameters: must be a table")
        return {}
    varied: dict[str, tuple[float, ...]] = {}
    for number, (name, raw) in enumerate(flattened(table).items()):
        if number > len(FIELDS):
            messages.append("parameters: more entries than there are parameters")
            break
        line = line_of(text, "parameters", name)
        if name in ("oil_level", "gas_preload"):
            messages.append(f"{line}parameters.{name}: belongs to the top of the file, not to parameters")
        elif name not in VARIABLE:
            curve = name in FIELDS
            hint = ", a curve and not a number" if curve else suggestion(name, VARIABLE)
            messages.append(f"{line}{'' if curve else 'unknown '}parameters.{name}{hint}")
        else:
            meta = FIELDS[name].metadata
            try:
                varied[name] = tuple(
                    bounded(name, raw, meta["unit"], lower=meta["lower"], upper=meta["upper"], integer=meta["integer"])
                )
            except ValueError as error:
                messages.append(f"{line}parameters.{error}")
    return varied


def misfits(study: Study) -> list[str]:
    """Messages where values that are each within bounds do not fit together, or a signal leaves the tube.

    Only the geometry's parameters depend on each other, so only their product is tried.
    """
    for signal in study.signals:
        samples = signal.samples(study.time_step)
        if samples > MAX_SAMPLES:
            return [f"{signal.name}: {samples:.0f} samples, at most {MAX_SAMPLES} are possible; raise time_step"]
    names = [name for name in study.parameters if FIELDS[name].metadata["group"] == "geometry"]
    count = len(study.dampers) * math.prod(len(study.parameters[name]) for name in names)
    if count > MAX_GEOMETRIES:
        return [f"{count} geometries, at most {MAX_GEOMETRIES} are possible; shorten the list of a geometry's parameter"]
    limit, where = math.inf, ""
    for damper, values in itertools.product(study.dampers, itertools.product(*(study.parameters[n] for n in names))):
        changes: dict[str, Any] = {FIELDS[n].name: x for n, x in zip(names, values, strict=True)}
        p = replace(damper.parameters, **changes)
        here = damper.name + "".join(f", {n} = {x:g}" for n, x in zip(names, values, strict=True))
        messages = problems(p)
        if messages:
            return [f"{here}: {messages[0]}"]
        if tube_limit(p) < limit:
            limit, where = tube_limit(p), here
    for signal in study.signals:
        try:
            if signal.stroke.size:
                checked(signal.stroke, signal.speed, limit)
                checked([AMPLITUDE], [V_PRECONDITIONING], limit)
        except InputError as error:
            return [f"{where}: {signal.name}: {error}"]
        message = "" if signal.stroke.size else outside("amplitude", signal.amplitude, 0.0, limit, "m")
        if message:
            return [f"{where}: {message}"]
    return []
