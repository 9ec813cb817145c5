"""Parameter sets as System Structure Parameter Values (SSP 1.0, file ending .ssv), for importers of the FMU."""

from collections.abc import Iterator
from dataclasses import fields
from xml.etree import ElementTree as ET

from twintube import __version__
from twintube.effects import Parameters
from twintube.parameters import Damper
from twintube.units import UNITS
from twintube.variables import fmi_name

STANDARD = "http://ssp-standard.org/SSP1/SystemStructure"


def values(damper: Damper) -> Iterator[tuple[str, str, str, str, str]]:
    """Name in the FMU, meaning, kind, value [SI] and unit of every parameter; arrays element by element."""
    for item in fields(Parameters):
        meta, value = item.metadata, getattr(damper.parameters, item.name)
        unit = meta["unit"] if meta["unit"] in UNITS and not meta["integer"] else ""
        many = meta["size"] > 1
        for i, part in enumerate(value if many else [value]):
            name = f"{fmi_name(item)}[{i + 1}]" if many else fmi_name(item)
            kind, text = ("Integer", str(int(part))) if meta["integer"] else ("Real", repr(float(part)))
            yield name, meta["description"], kind, text, unit


def to_ssv(damper: Damper) -> str:
    """The SSV text of a damper: all parameters, in SI units, under their names in the FMU."""
    # Prefixes are written out: importers that read XML without namespaces know the elements by these names only.
    root = ET.Element(
        "ssv:ParameterSet",
        {"xmlns:ssv": f"{STANDARD}ParameterValues", "xmlns:ssc": f"{STANDARD}Common"},
        version="1.0", name=damper.name, description=damper.title, generationTool=f"twintube {__version__}",
    )  # fmt: skip
    parameters, units = ET.SubElement(root, "ssv:Parameters"), ET.SubElement(root, "ssv:Units")
    used = set()
    for name, description, kind, value, unit in values(damper):
        parameter = ET.SubElement(parameters, "ssv:Parameter", name=name, description=description)
        number = ET.SubElement(parameter, f"ssv:{kind}", value=value)
        if unit:
            number.set("unit", unit)
            used.add(unit)
    for symbol, (_, exponents) in UNITS.items():
        if symbol in used:
            ET.SubElement(ET.SubElement(units, "ssc:Unit", name=symbol), "ssc:BaseUnit", exponents)
    ET.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ET.tostring(root, encoding="unicode") + "\n"
