"""modelDescription.xml of FMI 2.0 for both kinds of FMU, generated from the table of variables."""

import hashlib
import re
import unicodedata
from collections.abc import Mapping, Sequence
from xml.etree import ElementTree as ET

from twintube.core.units import DISPLAY, UNITS
from twintube.dampers import Damper
from twintube.dampers.freed_gas import AS_PUBLISHED, DEFAULT, own_values, way_of
from twintube.fmu.model import Model
from twintube.fmu.standards import STANDARDS, Standard
from twintube.fmu.table import Variable, variables
from twintube.version import __version__

TITLE = "Twin-tube shock absorber after oil and gas loss (Schramm, Zwosta, Prokop 2025): stroke and velocity in, force out"
# The unit has no solver: the tolerance is for importers that take theirs from here.
EXPERIMENT = {"startTime": "0.0", "stopTime": "2.0", "tolerance": "1e-06", "stepSize": "0.001"}
CAPABILITIES = {
    "needsExecutionTool": "false",  # nothing but a Python library in the Python kind; PyFMI refuses FMUs that say true
    "canHandleVariableCommunicationStepSize": "true",
    "canBeInstantiatedOnlyOncePerProcess": "false",
    "canGetAndSetFMUstate": "true",
    "canSerializeFMUstate": "true",
}
PREFIX = "twintube_"
LONGEST = 48  # characters of an identifier: Simulink's names end at 63


def model_name(damper: Damper) -> str:
    """The model's name and identifier; also a file name. It tells the states of a damper apart.

    An oil level and a gas preload below 1 and another way of the freed gas than the default follow the damper's name.
    """
    p, way = damper.parameters, way_of(own_values(damper))
    state = [damper.name]
    if p.oil_level < 1.0:
        state.append(f"oil_{100.0 * p.oil_level:g}")
    if p.gas_preload < 1.0:
        state.append(f"gas_{100.0 * p.gas_preload:g}" if p.gas_preload > 0.0 else "no_gas")
    if way not in (None, DEFAULT):
        state.append("as_published" if way == AS_PUBLISHED else f"gas_{way}")
    return identifier(PREFIX, "_".join(state))


def identifier(prefix: str, text: str) -> str:
    """An identifier of the C language, ASCII, from a prefix and a name.

    Accents are dropped. Where letters are lost, or the name is cut, a digest of the name tells two such names apart.
    """
    plain = "".join(c for c in unicodedata.normalize("NFKD", text) if not unicodedata.combining(c))
    name = prefix + re.sub(r"[^A-Za-z0-9_]", "_", plain)
    if len(name) > LONGEST or any(c.isalnum() and not c.isascii() for c in plain):
        digest = hashlib.sha256(text.encode(errors="surrogatepass")).hexdigest()[:8]
        return f"{name[: LONGEST - 9]}_{digest}"
    return name


def scalar(parent: ET.Element, reference: int, variable: Variable) -> str:
    """Add a variable; returns its unit."""
    element = ET.SubElement(parent, "ScalarVariable", place_of(variable, variable.name, reference))
    values = values_of(variable)
    ET.SubElement(element, "Integer" if variable.integer else "Real", values)
    return values.get("unit", "")


def place_of(variable: Variable, name: str, reference: int) -> dict[str, str]:
    """Name and role of a variable as attributes."""
    return {
        "name": name,
        "valueReference": str(reference),
        "description": variable.item.metadata["description"],
        "causality": variable.causality,
        "variability": variable.variability,
    }


def values_of(variable: Variable) -> dict[str, str]:
    """Unit, bounds and start value of a variable as attributes."""
    meta = variable.item.metadata
    found: dict[str, str] = {}
    unit: str = meta["unit"] if meta["unit"] in UNITS and not variable.integer else ""
    if unit:
        found |= {"declaredType": UNITS[unit][0], "unit": unit}
        if unit in DISPLAY:
            found["displayUnit"] = DISPLAY[unit][0]
    numbers = zip(("min", "max", "nominal", "start"), (*variable.bounds, meta["nominal"], variable.start), strict=True)
    for name, value in numbers:
        if value is not None and not (variable.integer and name == "nominal"):
            found[name] = number(variable, value)
    return found


def number(variable: Variable, value: float) -> str:
    """A value of a variable as text."""
    return str(int(value)) if variable.integer else repr(float(value))


def define_units(root: ET.Element, used: set[str], standard: Standard = STANDARDS[2]) -> None:
    """Fill the definitions of units, with what may be shown instead, and of types."""
    definitions, types = root.find("UnitDefinitions"), root.find("TypeDefinitions")
    assert definitions is not None and types is not None
    for symbol, (quantity, exponents) in UNITS.items():
        if symbol not in used:
            continue
        unit = ET.SubElement(definitions, "Unit", name=symbol)
        ET.SubElement(unit, "BaseUnit", exponents)
        if standard.arrays:
            real = ET.SubElement(types, f"{standard.types[0]}Type", name=quantity)
        else:
            real = ET.SubElement(ET.SubElement(types, "SimpleType", name=quantity), standard.types[0])
        real.attrib |= {"quantity": quantity, "unit": symbol}
        if symbol in DISPLAY:
            name, factor = DISPLAY[symbol]
            ET.SubElement(unit, "DisplayUnit", name=name, factor=repr(factor))
            real.set("displayUnit", name)


def serialized(root: ET.Element) -> bytes:
    """An XML file, indented."""
    ET.indent(root)
    body: bytes = ET.tostring(root, encoding="utf-8")
    return b'<?xml version="1.0" encoding="UTF-8"?>\n' + body + b"\n"


def described(
    damper: Damper,
    guid: str,
    date: str,
    capabilities: Mapping[str, str],
    *,
    sources: Sequence[str],
    categories: Sequence[str],
) -> bytes:
    """The model description of a damper, see `described_model`."""
    return described_model(damper_model(damper), guid, date, capabilities, sources=sources, categories=categories)


def damper_model(damper: Damper) -> Model:
    """A damper as a model."""
    return Model(model_name(damper), TITLE, tuple(variables(damper)), EXPERIMENT, "damper", True)


def origin(model: Model, date: str) -> dict[str, str]:
    """What a description says of the model's name and origin, in attributes."""
    return {
        "modelName": model.name, "description": model.title, "author": "twintube", "version": __version__, "license": "MIT",
        "generationTool": f"twintube {__version__}", "generationDateAndTime": date, "variableNamingConvention": "structured",
    }  # fmt: skip


def begin_lists(root: ET.Element, model: Model, categories: Sequence[str]) -> None:
    """Add what stands before the variables; the units follow from these and come last."""
    ET.SubElement(root, "UnitDefinitions")
    ET.SubElement(root, "TypeDefinitions")
    if categories:
        logs = ET.SubElement(root, "LogCategories")
        for category in categories:
            ET.SubElement(logs, "Category", name=category)
    ET.SubElement(root, "DefaultExperiment", dict(model.experiment))


def described_model(
    model: Model, guid: str, date: str, capabilities: Mapping[str, str], *, sources: Sequence[str], categories: Sequence[str]
) -> bytes:
    """The model description; `capabilities` of the kind are added to those of both, `sources` are what is to be compiled."""
    root = ET.Element("fmiModelDescription", {"fmiVersion": "2.0", "guid": guid, **origin(model, date)})
    unit = ET.SubElement(root, "CoSimulation", {"modelIdentifier": model.name, **CAPABILITIES, **capabilities})
    if sources:
        files = ET.SubElement(unit, "SourceFiles")
        for file in sources:
            ET.SubElement(files, "File", name=file)
    begin_lists(root, model, categories)
    listed, structure = ET.SubElement(root, "ModelVariables"), ET.SubElement(root, "ModelStructure")
    outputs, initial = ET.SubElement(structure, "Outputs"), ET.SubElement(structure, "InitialUnknowns")
    used = set()
    for i, variable in enumerate(model.variables):
        used.add(scalar(listed, i, variable))
        if variable.causality == "output":
            # Outputs change in doStep only: no direct feedthrough, so that importers need not iterate.
            ET.SubElement(outputs, "Unknown", index=str(i + 1), dependencies="")
            ET.SubElement(initial, "Unknown", index=str(i + 1))
    define_units(root, used)
    return serialized(root)
