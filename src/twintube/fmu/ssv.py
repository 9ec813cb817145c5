"""Parameter sets as System Structure Parameter Values (SSP 1.0, file ending .ssv), for importers of the FMU."""

from collections.abc import Sequence
from dataclasses import Field, dataclass
from typing import Any
from xml.etree import ElementTree as ET

from twintube import __version__
from twintube.core.units import UNITS
from twintube.dampers import Damper, elements
from twintube.words import printable

STANDARD = "http://ssp-standard.org/SSP1/SystemStructure"


@dataclass(frozen=True)
class Given:
    """A parameter: its name in the FMU, its field in the table of variables, its value [SI]."""

    name: str
    item: Field[Any]
    value: float


def to_ssv(damper: Damper, name: str | None = None) -> str:
    """The SSV text of a damper: all parameters, in SI units, under their names in the FMU. The set has the damper's name."""
    entries = [Given(key, item, value) for key, item, _, value in elements(damper)]
    return parameter_set(name or damper.name, damper.title, entries)


def parameter_set(name: str, title: str, entries: Sequence[Given]) -> str:
    """The SSV text of parameters."""
    # Prefixes are written out: importers that read XML without namespaces know the elements by these names only.
    root = ET.Element(
        "ssv:ParameterSet",
        {"xmlns:ssv": f"{STANDARD}ParameterValues", "xmlns:ssc": f"{STANDARD}Common"},
        version="1.0", name=printable(name), description=printable(title),
        generationTool=f"twintube {__version__}",
    )  # fmt: skip
    parameters, units = ET.SubElement(root, "ssv:Parameters"), ET.SubElement(root, "ssv:Units")
    used = set()
    for entry in entries:
        meta = entry.item.metadata
        kind, text = ("Integer", str(int(entry.value))) if meta["integer"] else ("Real", repr(float(entry.value)))
        parameter = ET.SubElement(parameters, "ssv:Parameter", name=entry.name, description=meta["description"])
        number = ET.SubElement(parameter, f"ssv:{kind}", value=text)
        if meta["unit"] in UNITS and not meta["integer"]:
            number.set("unit", meta["unit"])
            used.add(meta["unit"])
    define_units(units, used)
    ET.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ET.tostring(root, encoding="unicode") + "\n"


def define_units(units: ET.Element, used: set[str]) -> None:
    """Fill the definitions of units."""
    for symbol, (_, exponents) in UNITS.items():
        if symbol in used:
            ET.SubElement(ET.SubElement(units, "ssc:Unit", name=symbol), "ssc:BaseUnit", exponents)
