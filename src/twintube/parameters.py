"""Parameter sets in TOML: read, check, write. A named set is a file in `dampers/`."""

import difflib
import re
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import Field, dataclass, fields, replace
from functools import cache
from pathlib import Path
from typing import Any

import pint
import tomlkit

from twintube import effects
from twintube.checks import problems
from twintube.effects import Parameters
from twintube.variables import FV_POINTS, fmi_name

FOLDER = Path(__file__).parent / "dampers"
BRANCHES = {"rebound": ("v_re", "F_re"), "compression": ("v_co", "F_co")}
PINT_UNITS = {"m2": "m**2", "m3": "m**3", "1": "dimensionless"}


class ParameterError(ValueError):
    """A parameter set that cannot be used; the message names file, line, quantity, value and allowed range."""


@dataclass(frozen=True)
class Damper:
    """A named, sourced and checked parameter set. Do not change its parameters; `with_` makes another one."""

    name: str
    title: str
    parameters: Parameters
    sources: Mapping[str, str]  # where the values come from, by group or by group and name
    assumed: Mapping[str, str]  # the same for stand-ins of unpublished values: the reasoning
    measured_levels: tuple[float, ...] = ()  # oil levels of the degraded states that were measured, highest first
    measured_amplitude: float | None = None  # [m] of the harmonic measurements, where it is not 90 % of the maximum stroke

    def with_(self, **changes: Any) -> "Damper":
        """The same damper with other parameters, e.g. `oil_level=0.4, gas_preload=0`; raises ParameterError."""
        known = {item.name for item in fields(Parameters)}
        for name in changes:
            if name not in known:
                raise ParameterError(f"{self.name}: unknown parameter {name}{suggestion(name, known)}")
        changed = replace(self.parameters, **changes)
        refuse(self.name, problems(changed))
        return replace(self, parameters=changed)


def names() -> list[str]:
    """The named dampers."""
    return sorted(path.stem for path in FOLDER.glob("*.toml"))


def elements(damper: Damper) -> Iterator[tuple[str, Field[Any], int, float]]:
    """Name in the FMU, field of the table, index in an array (-1 where it is none) and value [SI] of every parameter."""
    for item in fields(Parameters):
        value, name = getattr(damper.parameters, item.name), fmi_name(item)
        if item.metadata["size"] == 1:
            yield name, item, -1, value
        else:
            for i, part in enumerate(value):
                yield f"{name}[{i + 1}]", item, i, part


def load(damper: str | Path) -> Damper:
    """A named damper (`"SA8"`) or a parameter file; raises ParameterError."""
    content, text, file = read_named(damper, FOLDER, "damper")
    return from_content(content, text, file)


def read_named(name: str | Path, folder: Path, what: str) -> tuple[dict[str, Any], str, str]:
    """Content, text and file name of a TOML file: one in `folder` by its name, or any by its path; raises ParameterError."""
    path = folder / f"{name}.toml"
    if not path.is_file():
        path = Path(name)
    if not path.is_file():
        known = ", ".join(sorted(item.stem for item in folder.glob("*.toml")))
        raise ParameterError(f"unknown {what} {name}: neither a file nor one of {known}")
    try:
        text = path.read_text(encoding="utf-8")
        return tomllib.loads(text), text, path.name
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ParameterError(f"{path.name}: {error}") from error


def from_content(content: dict[str, Any], text: str, file: str) -> Damper:
    """A damper from parsed TOML; `text` and `file` serve the messages only."""
    found: list[str] = []
    values: dict[str, Any] = {}
    known: dict[str, set[str]] = {
        "": {"name", "title", "sources", "assumed", "measured_oil", "measured_amplitude"},
        "fv": {"velocity_unit", "force_unit"},
    }
    for item in fields(Parameters):
        group, name = item.metadata["group"], item.name
        if item.metadata["size"] > 1:
            continue
        known.setdefault(group, set()).add(name)
        table = content.get(group, {}) if group else content
        if name in table:
            try:
                values[name] = quantity(table[name], item.metadata["unit"])
                if item.metadata["integer"]:
                    values[name] = int(values[name])
            except ValueError as error:
                found.append(f"{line_of(text, group, name)}{fmi_name(item)}: {error}")
        elif item.metadata["default"] is not None:
            values[name] = item.metadata["default"]
        else:
            found.append(f"{fmi_name(item)} is missing")
    known["fv"] |= set(BRANCHES)
    found += unknown_keys(content, text, known)
    measured: list[float] = []
    amplitude = None
    try:
        if "measured_amplitude" in content:
            amplitude = quantity(content["measured_amplitude"], "m")
    except ValueError as error:
        found.append(f"{line_of(text, '', 'measured_amplitude')}measured_amplitude: {error}")
    try:
        measured = [quantity(volume, "m3") for volume in content.get("measured_oil", [])]
    except ValueError as error:
        found.append(f"{line_of(text, '', 'measured_oil')}measured_oil: {error}")
    found += read_curve(content.get("fv", {}), values)
    refuse(file, found)
    p = Parameters(**values)
    refuse(file, [located(text, message) for message in problems(p)])
    return Damper(
        name=str(content.get("name", Path(file).stem)),
        title=str(content.get("title", "")),
        parameters=p,
        sources=content.get("sources", {}),
        assumed=content.get("assumed", {}),
        measured_levels=tuple(volume / p.V_oil for volume in measured),
        measured_amplitude=amplitude,
    )


def quantity(value: Any, unit: str) -> float:
    """SI value of `"29.8 mm"` or of a plain SI number; raises ValueError."""
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        raise ValueError(f"{value!r} is no number and no quantity like '29.8 mm'")
    if isinstance(value, (int, float)):
        return float(value)
    try:
        converted = float(registry().Quantity(value).to(PINT_UNITS.get(unit, unit)).magnitude)
        return float(f"{converted:.15g}")  # 13 mm are 0.013 m, not 0.013000000000000001 m
    except (pint.PintError, TypeError, AttributeError, AssertionError) as error:
        raise ValueError(f"{value!r} is no quantity in {unit} ({error})") from error


@cache
def registry() -> Any:
    """Pint's units, made once because it takes a while."""
    return pint.UnitRegistry()


def read_curve(table: dict[str, Any], values: dict[str, Any]) -> list[str]:
    """Put the F-v curve into `values`; messages about what is wrong with it."""
    found: list[str] = []
    for branch, (v_name, F_name) in BRANCHES.items():
        rows = table.get(branch)
        if rows is None:
            found.append(f"fv.{branch} is missing")
            continue
        if not isinstance(rows, list) or not all(
            isinstance(row, list) and len(row) == 2 and all(type(x) in (int, float) for x in row) for row in rows
        ):
            found.append(f"fv.{branch}: must be a list of [velocity, force] pairs of numbers")
            continue
        if not 2 <= len(rows) <= FV_POINTS:
            found.append(f"fv.{branch}: {len(rows)} points, must be from 2 to {FV_POINTS}")
            continue
        try:
            v_unit = quantity("1 " + table.get("velocity_unit", "m/s"), "m/s")
            F_unit = quantity("1 " + table.get("force_unit", "N"), "N")
        except (ValueError, TypeError) as error:
            found.append(f"fv: {error}")
            continue
        points = continued([(v * v_unit, F * F_unit) for v, F in rows])
        values[v_name] = [v for v, _ in points]
        values[F_name] = [F for _, F in points]
    return found


def continued(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """The points of a branch, filled up to FV_POINTS along its last segment: the same curve."""
    points = list(points)
    step = (points[-1][0] - points[-2][0], points[-1][1] - points[-2][1])
    while len(points) < FV_POINTS:
        points.append((points[-1][0] + step[0], points[-1][1] + step[1]))
    return points


def unknown_keys(content: dict[str, Any], text: str, known: dict[str, set[str]]) -> list[str]:
    """Messages about tables and keys that no parameter has."""
    found = []
    for key, value in content.items():
        if isinstance(value, dict) and key in known:
            for name in value:
                if name not in known[key]:
                    found.append(f"{line_of(text, key, name)}unknown {key}.{name}{suggestion(name, known[key])}")
        elif key not in known[""]:
            found.append(f"{line_of(text, '', key)}unknown {key}{suggestion(key, known[''] | set(known))}")
    return found


def suggestion(name: str, known: Any) -> str:
    """`, did you mean ...?` where a known name is close."""
    close = difflib.get_close_matches(name, known, n=1)
    return f", did you mean {close[0]}?" if close else ""


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


def located(text: str, message: str) -> str:
    """The message with the line of the parameter it starts with."""
    group, _, name = message.split(" ", 1)[0].rstrip(":").rpartition(".")
    return line_of(text, group, name) + message


def refuse(where: str, found: list[str]) -> None:
    """Raise ParameterError with all messages, if there are any."""
    if found:
        raise ParameterError(f"{where}: " + "; ".join(found))


def to_toml(damper: Damper) -> str:
    """The TOML text of a damper, in SI units, with all points of the F-v curve and the effects that act."""
    document = tomlkit.document()
    document["name"] = damper.name
    document["title"] = damper.title
    if damper.measured_levels:
        document["measured_oil"] = [level * damper.parameters.V_oil for level in damper.measured_levels]
    if damper.measured_amplitude is not None:
        document["measured_amplitude"] = damper.measured_amplitude
        document["measured_amplitude"].comment("m")
    p = damper.parameters
    idle = {item.name for effect in effects.EFFECTS.values() if not effect.acts(p) for item in effect.parameters}
    for item in fields(Parameters):
        group = item.metadata["group"]
        if item.metadata["size"] > 1 or item.name in idle:
            continue
        if group and group not in document:
            document[group] = tomlkit.table()
        table: Any = document[group] if group else document
        table[item.name] = getattr(p, item.name)
        if item.metadata["unit"] != "1":
            table[item.name].comment(item.metadata["unit"])
    curve = tomlkit.table()
    for branch, (v_name, F_name) in BRANCHES.items():
        rows = tomlkit.array()
        rows.extend([list(pair) for pair in zip(getattr(p, v_name), getattr(p, F_name), strict=True)])
        curve[branch] = rows.multiline(True)
    document["fv"] = curve
    document["sources"] = dict(damper.sources)
    document["assumed"] = dict(damper.assumed)
    return tomlkit.dumps(document)
