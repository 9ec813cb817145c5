"""modelDescription.xml of both kinds of FMU, made from the table of variables."""

import re
from collections.abc import Mapping, Sequence
from xml.etree import ElementTree as ET

from twintube import __version__
from twintube.core.units import UNITS
from twintube.dampers import Damper
from twintube.fmu.table import Variable, variables

TITLE = "Twin-tube shock absorber after oil and gas loss (Schramm, Zwosta, Prokop 2025): stroke and velocity in, force out"
EXPERIMENT = {"startTime": "0.0", "stopTime": "2.0", "stepSize": "0.001"}
CAPABILITIES = {
    "needsExecutionTool": "false",  # nothing but a Python library in the Python kind; PyFMI refuses FMUs that say true
    "canHandleVariableCommunicationStepSize": "true",
    "canBeInstantiatedOnlyOncePerProcess": "false",
    "canGetAndSetFMUstate": "true",
    "canSerializeFMUstate": "true",
}


def model_name(damper: Damper) -> str:
    """The model's name and identifier: an identifier of the C language."""
    return "twintube_" + re.sub(r"\W", "_", damper.name)


def scalar(parent: ET.Element, reference: int, variable: Variable) -> str:
    """Add one variable; returns its unit."""
    meta = variable.item.metadata
    attributes = {
        "name": variable.name,
        "valueReference": str(reference),
        "description": meta["description"],
        "causality": variable.causality,
        "variability": variable.variability,
    }
    element = ET.SubElement(parent, "ScalarVariable", attributes)
    kind = ET.SubElement(element, "Integer" if variable.integer else "Real")
    unit: str = meta["unit"] if meta["unit"] in UNITS and not variable.integer else ""
    if unit:
        kind.set("declaredType", UNITS[unit][0])
        kind.set("unit", unit)
    # The range of the stroke depends on the tube too; the unit checks it.
    for name, limit in (("min", meta["lower"]), ("max", meta["upper"])):
        if limit is not None:
            kind.set(name, str(int(limit)) if variable.integer else repr(float(limit)))
    if variable.start is not None:
        kind.set("start", str(int(variable.start)) if variable.integer else repr(float(variable.start)))
    return unit


def described(
    damper: Damper, guid: str, date: str, capabilities: Mapping[str, str], sources: Sequence[str], categories: Sequence[str]
) -> bytes:
    """The model description; `capabilities` of the kind come beside those of both, `sources` are what is to be compiled."""
    name = model_name(damper)
    root = ET.Element(
        "fmiModelDescription", fmiVersion="2.0", modelName=name, guid=guid, description=TITLE, author="twintube",
        version=__version__, license="MIT", generationTool=f"twintube {__version__}", generationDateAndTime=date,
        variableNamingConvention="structured",
    )  # fmt: skip
    unit = ET.SubElement(root, "CoSimulation", {"modelIdentifier": name, **CAPABILITIES, **capabilities})
    if sources:
        files = ET.SubElement(unit, "SourceFiles")
        for file in sources:
            ET.SubElement(files, "File", name=file)
    definitions, types = ET.SubElement(root, "UnitDefinitions"), ET.SubElement(root, "TypeDefinitions")
    if categories:
        logs = ET.SubElement(root, "LogCategories")
        for category in categories:
            ET.SubElement(logs, "Category", name=category)
    ET.SubElement(root, "DefaultExperiment", EXPERIMENT)
    listed, structure = ET.SubElement(root, "ModelVariables"), ET.SubElement(root, "ModelStructure")
    outputs, initial = ET.SubElement(structure, "Outputs"), ET.SubElement(structure, "InitialUnknowns")
    used = set()
    for i, variable in enumerate(variables(damper)):
        used.add(scalar(listed, i, variable))
        if variable.causality == "output":
            # Outputs change in doStep only: no direct feedthrough, so that importers need not iterate.
            ET.SubElement(outputs, "Unknown", index=str(i + 1), dependencies="")
            ET.SubElement(initial, "Unknown", index=str(i + 1))
    for symbol, (quantity, exponents) in UNITS.items():
        if symbol in used:
            ET.SubElement(ET.SubElement(definitions, "Unit", name=symbol), "BaseUnit", exponents)
            simple = ET.SubElement(types, "SimpleType", name=quantity)
            ET.SubElement(simple, "Real", quantity=quantity, unit=symbol)
    ET.indent(root)
    body: bytes = ET.tostring(root, encoding="utf-8")
    return b'<?xml version="1.0" encoding="UTF-8"?>\n' + body
