"""Parameter sets as System Structure Parameter Values (SSP 1.0 or 2.0, file ending .ssv), for importers of the FMU."""

from collections.abc import Sequence
from xml.etree import ElementTree as ET

from twintube.common.words import printable
from twintube.core.units import UNITS
from twintube.dampers import Damper
from twintube.fmu.description import damper_model, number
from twintube.fmu.platforms import Ssp
from twintube.fmu.standards import INSIDE, STANDARDS
from twintube.fmu.table import Variable, array_name, lengths
from twintube.version import __version__

STANDARD = "http://ssp-standard.org/SSP1/SystemStructure"


def to_ssv(damper: Damper, name: str | None = None, ssp: Ssp = 1) -> str:
    """The SSV text of a damper: all parameters, in SI units, under their names in the FMU. The set has the damper's name.

    SSP 2.0 is for the FMU of FMI 3.0, in which an array is one parameter.
    """
    return parameter_set(name or damper.name, damper.title, damper_model(damper).variables, ssp)


def parameter_set(name: str, title: str, variables: Sequence[Variable], ssp: Ssp = 1) -> str:
    """The SSV text of the parameters among variables."""
    standard = STANDARDS[INSIDE[ssp]]
    # Prefixes are written out: importers that read XML without namespaces know the elements by these names only.
    root = ET.Element(
        "ssv:ParameterSet",
        {"xmlns:ssv": f"{STANDARD}ParameterValues", "xmlns:ssc": f"{STANDARD}Common"},
        version=f"{ssp}.0", name=printable(name), description=printable(title),
        generationTool=f"twintube {__version__}",
    )  # fmt: skip
    parameters, units = ET.SubElement(root, "ssv:Parameters"), ET.SubElement(root, "ssv:Units")
    used = set()
    for place, length in enumerate(lengths(variables, standard.arrays)):
        first, parts = variables[place], variables[place : place + length]
        if first.causality != "parameter" or not parts:
            continue
        unit, about = first.item.metadata["unit"], first.item.metadata["description"]
        parameter = ET.SubElement(parameters, "ssv:Parameter", name=array_name(parts), description=about)
        text = " ".join(number(part, part.start or 0.0) for part in parts)
        values = ET.SubElement(parameter, f"ssv:{standard.types[first.integer]}", value=text)
        if unit in UNITS and not first.integer:
            values.set("unit", unit)
            used.add(unit)
        if length > 1:
            ET.SubElement(parameter, "ssc:Dimension", size=str(length))
    define_units(units, used)
    ET.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ET.tostring(root, encoding="unicode") + "\n"


def define_units(units: ET.Element, used: set[str]) -> None:
    """Fill the definitions of units."""
    for symbol, (_, exponents) in UNITS.items():
        if symbol in used:
            ET.SubElement(ET.SubElement(units, "ssc:Unit", name=symbol), "ssc:BaseUnit", exponents)
