"""Parameter sets as System Structure Parameter Values (SSP 1.0, file ending .ssv), for importers of the FMU."""

from xml.etree import ElementTree as ET

from twintube import __version__
from twintube.core.units import UNITS
from twintube.dampers import Damper, elements
from twintube.words import printable

STANDARD = "http://ssp-standard.org/SSP1/SystemStructure"


def to_ssv(damper: Damper) -> str:
    """The SSV text of a damper: all parameters, in SI units, under their names in the FMU."""
    # Prefixes are written out: importers that read XML without namespaces know the elements by these names only.
    root = ET.Element(
        "ssv:ParameterSet",
        {"xmlns:ssv": f"{STANDARD}ParameterValues", "xmlns:ssc": f"{STANDARD}Common"},
        version="1.0", name=printable(damper.name), description=printable(damper.title),
        generationTool=f"twintube {__version__}",
    )  # fmt: skip
    parameters, units = ET.SubElement(root, "ssv:Parameters"), ET.SubElement(root, "ssv:Units")
    used = set()
    for name, item, _, value in elements(damper):
        meta = item.metadata
        kind, text = ("Integer", str(int(value))) if meta["integer"] else ("Real", repr(float(value)))
        parameter = ET.SubElement(parameters, "ssv:Parameter", name=name, description=meta["description"])
        number = ET.SubElement(parameter, f"ssv:{kind}", value=text)
        if meta["unit"] in UNITS and not meta["integer"]:
            number.set("unit", meta["unit"])
            used.add(meta["unit"])
    for symbol, (_, exponents) in UNITS.items():
        if symbol in used:
            ET.SubElement(ET.SubElement(units, "ssc:Unit", name=symbol), "ssc:BaseUnit", exponents)
    ET.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ET.tostring(root, encoding="unicode") + "\n"
