"""Parameter sets in TOML: read and checked. A named set is a file in this folder."""

from __future__ import annotations

import re
import warnings
from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

from twintube.common.reading import ReadError, read_toml
from twintube.common.words import listed, short, shown
from twintube.core.checks import outside, problems
from twintube.core.effects import Parameters
from twintube.core.variables import fmi_name
from twintube.dampers import freed_gas
from twintube.dampers.curve import BRANCHES, as_listed, read_curve
from twintube.dampers.damper import Damper, ParameterError, explained, refuse, suggestion
from twintube.dampers.dead_length import beyond_parts
from twintube.dampers.doubts import doubts
from twintube.dampers.quantity import quantity
from twintube.errors import InputWarning

FOLDER = Path(__file__).parent
FEW_UNKNOWN = 5  # keys that are named
FEW_MISSING = 5  # parameters; whoever lacks more began without a complete file
LONGEST_TEXT = 200  # characters of a name or title
MOST_LEVELS = 20  # measured oil levels
SMALLEST_AMPLITUDE = 1e-4  # [m] of a measurement
PRESSURES = (1.0, 10e6)  # [Pa] gauge, of the gas of a damper; a ratio of pressures needs one above 0


def names() -> list[str]:
    """The named dampers."""
    return sorted(path.stem for path in FOLDER.glob("*.toml"))


def load(damper: str | Path | Damper, *, as_published: bool = False) -> Damper:
    """A named damper (`"SA8"`) or a parameter file; a damper is returned as it is. Raises ParameterError.

    Gas that cavitation frees dissolves again (`freed_gas.DEFAULT`) where the parameter set says nothing else.
    `as_published` leaves that out: the paper's equations alone, in which it stays gas.

    Values that are possible but hardly meant, such as forces in kN that are said to be in N, are an InputWarning.
    """
    if isinstance(damper, Damper):
        return freed_gas.as_published(damper) if as_published else damper
    if not isinstance(damper, (str, Path)):
        raise ParameterError(
            f"damper is a {type(damper).__name__}: must be a Damper, a name, or the path of a parameter file"
        )
    content, text, file = read_named(damper, FOLDER, "damper")
    loaded = from_content(content, text, file)
    for doubt in doubts(loaded.parameters):
        warnings.warn(f"{file}: {located(text, doubt)}", InputWarning, stacklevel=2)
    return freed_gas.as_published(loaded) if as_published else loaded


def read_named(name: str | Path, folder: Path, what: str) -> tuple[dict[str, Any], str, str]:
    """Content, text and file name of a TOML file: one in `folder` by its name, or any by its path; raises ParameterError."""
    known = sorted(item.stem for item in folder.glob("*.toml"))
    path = folder / f"{name}.toml" if str(name) in known else Path(name)
    try:
        return *read_toml(path), path.name
    except (FileNotFoundError, NotADirectoryError) as error:
        hint = suggestion(str(name), known)
        raise ParameterError(
            f"unknown {what} {short(str(name))}: neither a file nor one of {', '.join(known)}{hint}"
        ) from error
    except (ReadError, OSError) as error:
        raise ParameterError(f"{short(path.name)}: {getattr(error, 'strerror', None) or error}") from error


def from_content(content: dict[str, Any], text: str, file: str) -> Damper:
    """A damper from parsed TOML; `text` and `file` serve the messages only."""
    messages: list[str] = []
    values: dict[str, Any] = {}
    known: dict[str, set[str]] = {
        "": {"name", "title", "sources", "assumed", "measured_oil", "measured_amplitude", "gas_pressure", "freed_gas"},
        "fv": {"velocity_unit", "force_unit"},
    }
    missing: list[str] = []
    for item in fields(Parameters):
        group, name = item.metadata["group"], item.name
        if item.metadata["size"] > 1:
            continue
        known.setdefault(group, set()).add(name)
        table = as_table(content.get(group, {})) if group else content
        if name in table:
            try:
                values[name] = read_value(table[name], item.metadata)
            except ValueError as error:
                messages.append(f"{line_of(text, group, name)}{fmi_name(item)}: {error}")
        elif item.metadata["default"] is not None:
            values[name] = item.metadata["default"]
        else:
            missing.append(fmi_name(item))
    known["fv"] |= set(BRANCHES)
    messages += wrong_tables(content, text, {*known, "sources", "assumed"} - {""})
    messages += unknown_keys(content, text, known)
    messages += absent(missing)
    curve = as_table(content.get("fv", {}))
    messages += [located(text, message) for message in read_curve(curve, values)]
    messages += read_freed_gas(content, text, values)
    name, title = (read_text(content, key, text, messages) for key in ("name", "title"))
    sources, assumed = (read_texts(content, key, text, messages) for key in ("sources", "assumed"))
    refuse(file, messages)
    p = Parameters(**values)
    refuse(file, [located(text, as_listed(message, curve)) for message in explained(problems(p), p)])
    levels, amplitude = read_measured(content, text, p, messages)
    pressure = read_pressure(content, text, messages)
    refuse(file, messages)
    damper = Damper(
        name=name or Path(file).stem,
        title=title,
        parameters=p,
        sources=sources,
        assumed=assumed,
        measured_levels=levels,
        measured_amplitude=amplitude,
        gas_pressure=pressure,
    )
    length = beyond_parts(damper)
    refuse(file, [located(text, length)] if length else [])
    return damper


def read_freed_gas(content: dict[str, Any], text: str, values: dict[str, Any]) -> list[str]:
    """Put what freed gas does into `values`, where the file does not give its parameters; messages about what is wrong."""
    given = [item for item in fields(Parameters) if item.name in freed_gas.OWN
             and item.name in as_table(content.get(item.metadata["group"], {}))]  # fmt: skip
    if "freed_gas" in content:
        line = line_of(text, "", "freed_gas")
        if given:
            return [f"{line}freed_gas = {shown(content['freed_gas'])} and {fmi_name(given[0])}: give one of them"]
        try:
            values |= freed_gas.values_of(content["freed_gas"])
        except ParameterError as error:
            return [f"{line}{error}"]
    elif not given:
        values |= freed_gas.values_of(freed_gas.DEFAULT)
    return []


def as_table(value: Any) -> dict[str, Any]:
    """A TOML table; empty where another value stands instead, which `wrong_tables` reports."""
    return value if isinstance(value, dict) else {}


def read_value(raw: Any, meta: Mapping[str, Any]) -> float | int:
    """A parameter [SI] from a number or a quantity; raises ValueError."""
    value = quantity(raw, meta["unit"])
    if not meta["integer"]:
        return value
    if not value.is_integer():  # also infinity and NaN
        raise ValueError(f"{shown(raw)} must be an integer")
    return int(value)


def absent(missing: list[str]) -> list[str]:
    """A message about the parameters that the file lacks."""
    if len(missing) <= FEW_MISSING:
        return [f"{name} is missing" for name in missing]
    return [
        f"{len(missing)} parameters are missing ({listed(missing, 3)}): start from a complete file, "
        "`twintube dampers SA8 > mine.toml`"
    ]


def read_text(content: dict[str, Any], key: str, text: str, messages: list[str]) -> str:
    """A text of one line, empty where it is not given; what is wrong with it goes to `messages`."""
    value = content.get(key, "")
    if not isinstance(value, str) or len(value) > LONGEST_TEXT or "\n" in value:
        limit = f"a text of one line and at most {LONGEST_TEXT} characters"
        messages.append(f"{line_of(text, '', key)}{key} = {shown(value)}: must be {limit}")
        return ""
    return value


def read_texts(content: dict[str, Any], key: str, text: str, messages: list[str]) -> dict[str, str]:
    """A table of texts; what is wrong with it goes to `messages`."""
    table = as_table(content.get(key, {}))
    for name, value in table.items():
        if not isinstance(value, str):
            messages.append(f"{line_of(text, key, name)}{key}.{name} = {shown(value)}: must be a text")
    return table


def read_measured(
    content: dict[str, Any], text: str, p: Parameters, messages: list[str]
) -> tuple[tuple[float, ...], float | None]:
    """The measured oil levels and the amplitude [m] of the measurement; what is wrong with them goes to `messages`."""
    volumes: list[float] = []
    amplitude = None
    try:
        raw = content.get("measured_oil", [])
        if not isinstance(raw, list) or len(raw) > MOST_LEVELS:
            raise ValueError(f"{shown(raw)} must be a list of at most {MOST_LEVELS} volumes like ['153 mL', '83 mL']")
        volumes = [quantity(volume, "m3") for volume in raw]
        messages += [
            line_of(text, "", "measured_oil") + message
            for volume in volumes
            if (message := outside("measured_oil", volume, 0.0, p.V_oil, "m3"))
        ]
    except ValueError as error:
        messages.append(f"{line_of(text, '', 'measured_oil')}measured_oil: {error}")
    try:
        if "measured_amplitude" in content:
            amplitude = quantity(content["measured_amplitude"], "m")
            message = outside("measured_amplitude", amplitude, SMALLEST_AMPLITUDE, p.stroke_max, "m")
            messages += [line_of(text, "", "measured_amplitude") + message] if message else []
    except ValueError as error:
        messages.append(f"{line_of(text, '', 'measured_amplitude')}measured_amplitude: {error}")
    return tuple(volume / p.V_oil for volume in volumes), amplitude


def read_pressure(content: dict[str, Any], text: str, messages: list[str]) -> float | None:
    """The gauge pressure [Pa] at which the gas spring holds; what is wrong with it goes to `messages`."""
    if "gas_pressure" not in content:
        return None
    place = line_of(text, "", "gas_pressure")
    try:
        pressure = quantity(content["gas_pressure"], "Pa")
    except ValueError as error:
        messages.append(f"{place}gas_pressure: {error}")
        return None
    message = outside("gas_pressure", pressure, *PRESSURES, "Pa")
    messages += [place + message] if message else []
    return pressure


def wrong_tables(content: dict[str, Any], text: str, tables: set[str]) -> list[str]:
    """Messages about groups that are given as a single value."""
    return [
        f"{line_of(text, '', key)}{key} = {shown(value)}: must be a table [{key}]"
        for key, value in content.items()
        if key in tables and not isinstance(value, dict)
    ]


def unknown_keys(content: dict[str, Any], text: str, known: dict[str, set[str]]) -> list[str]:
    """Messages about tables and keys that no parameter has; the first FEW_UNKNOWN of them and the number of the others."""
    unknown = [
        (key, name, known[key])
        for key, value in content.items()
        if isinstance(value, dict) and key in known
        for name in value
        if name not in known[key]
    ]
    unknown += [("", key, known[""] | set(known)) for key in content if key not in known and key not in known[""]]
    messages = [
        f"{line_of(text, group, name)}unknown {group + '.' if group else ''}{name}{suggestion(name, candidates)}"
        for group, name, candidates in unknown[:FEW_UNKNOWN]
    ]
    rest = len(unknown) - len(messages)
    return messages + ([f"{rest} more unknown keys"] if rest else [])


def line_of(text: str, group: str, name: str) -> str:
    """`line 12: ` where the key stands in a TOML text, or an empty string."""
    current = ""
    for number, line in enumerate(text.splitlines(), start=1):
        header = re.match(r"\s*\[([^\[\]]+)\]", line)
        if header:
            current = header.group(1).strip()
        elif current == group and re.match(rf"\s*\"?{re.escape(name)}\"?\s*=", line):
            return f"line {number}: "
    return ""


def line_of_table(text: str, group: str) -> str:
    """`line 12: ` where the table begins in a TOML text, or an empty string."""
    for number, line in enumerate(text.splitlines(), start=1):
        if re.match(rf"\s*\[{re.escape(group)}\]", line):
            return f"line {number}: "
    return ""


def located(text: str, message: str) -> str:
    """The message with the line of the parameter it starts with."""
    group, _, name = message.split(" ", 1)[0].rstrip(":").rpartition(".")
    return line_of(text, group, name) + message
