"""What pythonfmu leaves out of modelDescription.xml: units, bounds, output dependencies, initial unknowns."""

from dataclasses import fields
from xml.etree import ElementTree as ET

from twintube.effects import Parameters
from twintube.variables import Inputs, Outputs, fmi_name

# Exponents of the SI base units, for importers that refuse to connect units they do not know.
UNITS = {
    "m": {"m": "1"},
    "m3": {"m": "3"},
    "m/s": {"m": "1", "s": "-1"},
    "kg": {"kg": "1"},
    "N": {"kg": "1", "m": "1", "s": "-2"},
    "N/m": {"kg": "1", "s": "-2"},
    "s": {"s": "1"},
    "1/s": {"s": "-1"},
    "m2": {"m": "2"},
    "m/N": {"kg": "-1", "s": "2"},
    "1/J": {"kg": "-1", "m": "-2", "s": "2"},
    "J": {"kg": "1", "m": "2", "s": "-2"},
}


def table() -> dict[str, tuple[str, float | None, float | None]]:
    """Unit, lower and upper bound by FMI name, arrays without their index."""
    found = {}
    for record in (Inputs, Outputs, Parameters):
        for item in fields(record):
            meta = item.metadata
            found[fmi_name(item)] = (meta["unit"], meta["lower"], meta["upper"])
    return found


def complete(xml: bytes, guid: str, date: str) -> bytes:
    """The model description with everything that the FMI contract of this project asks for."""
    root = ET.fromstring(xml)
    root.set("guid", guid)
    root.set("generationDateAndTime", date)
    described = table()
    used = set()
    variables = root.find("ModelVariables")
    structure = root.find("ModelStructure")
    assert variables is not None and structure is not None
    for variable in variables:
        unit, lower, upper = described[variable.attrib["name"].split("[")[0]]
        kind = variable[0]
        whole = kind.tag == "Integer"
        if unit in UNITS and not whole:
            kind.set("unit", unit)
            used.add(unit)
        # The range of the stroke depends on the tube; the slave checks it.
        for name, bound in (("min", lower), ("max", upper)):
            if bound is not None:
                kind.set(name, str(int(bound)) if whole else repr(float(bound)))
    definitions = ET.Element("UnitDefinitions")
    for name, exponents in UNITS.items():
        if name in used:
            ET.SubElement(ET.SubElement(definitions, "Unit", name=name), "BaseUnit", exponents)
    root.insert([child.tag for child in root].index("CoSimulation") + 1, definitions)

    outputs = structure.find("Outputs")
    assert outputs is not None
    initial = ET.SubElement(structure, "InitialUnknowns")
    for unknown in outputs:
        # Outputs change in doStep only: no direct feedthrough, so that importers need not iterate.
        unknown.set("dependencies", "")
        ET.SubElement(initial, "Unknown", index=unknown.attrib["index"])
    ET.indent(root)
    body: bytes = ET.tostring(root, encoding="utf-8")
    return b'<?xml version="1.0" encoding="UTF-8"?>\n' + body
