"""Parameter sets in TOML: read, check, write. A named set is a file in this folder."""

import re
import tomllib
from dataclasses import fields
from pathlib import Path
from typing import Any

import tomlkit

from twintube.core import effects
from twintube.core.checks import problems
from twintube.core.effects import Parameters
from twintube.core.variables import FV_POINTS, fmi_name
from twintube.dampers.damper import Damper, ParameterError, refuse, suggestion
from twintube.dampers.quantity import quantity

FOLDER = Path(__file__).parent
BRANCHES = {"rebound": ("v_re", "F_re"), "compression": ("v_co", "F_co")}


def names() -> list[str]:
    """The named dampers."""
    return sorted(path.stem for path in FOLDER.glob("*.toml"))


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
