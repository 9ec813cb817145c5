"""modelDescription.xml and buildDescription.xml of FMI 3.0, from the same table of variables as FMI 2.0."""

from collections.abc import Sequence
from xml.etree import ElementTree as ET

from twintube.fmu.description import begin_lists, define_units, number, origin, place_of, serialized, values_of
from twintube.fmu.model import Model
from twintube.fmu.standards import STANDARDS
from twintube.fmu.table import TIME, Variable, array_name, lengths

STANDARD = STANDARDS[3]
CAPABILITIES = {
    "needsExecutionTool": "false",
    "canBeInstantiatedOnlyOncePerProcess": "false",
    "canGetAndSetFMUState": "true",
    "canSerializeFMUState": "true",
    "canHandleVariableCommunicationStepSize": "true",
    "hasEventMode": "false",
    "maxOutputDerivativeOrder": "0",  # forces jump where a phase runs out: no derivative would be exact
    "providesDirectionalDerivatives": "false",  # outputs do not depend on the inputs of the moment
    "providesIntermediateUpdate": "false",
    "mightReturnEarlyFromDoStep": "false",
}
BUILD = "sources/buildDescription.xml"


def variable(parent: ET.Element, reference: int, parts: Sequence[Variable]) -> str:
    """Add a variable or an array of `parts`; returns its unit."""
    first, values = parts[0], values_of(parts[0])
    if len(parts) > 1:
        values["start"] = " ".join(number(part, part.start or 0.0) for part in parts)
    if first is TIME:
        values.pop("nominal")
    element = ET.SubElement(parent, STANDARD.types[first.integer], place_of(first, array_name(parts), reference) | values)
    if len(parts) > 1:
        ET.SubElement(element, "Dimension", start=str(len(parts)))
    return values.get("unit", "")


def described_model(model: Model, token: str, date: str, categories: Sequence[str]) -> bytes:
    """The model description; an array is one variable, with the value reference of its first element in FMI 2.0."""
    root = ET.Element(
        "fmiModelDescription", {"fmiVersion": STANDARD.version, "instantiationToken": token, **origin(model, date)}
    )
    ET.SubElement(root, "CoSimulation", {"modelIdentifier": model.name, **CAPABILITIES})
    begin_lists(root, model, categories)
    listed, structure = ET.SubElement(root, "ModelVariables"), ET.SubElement(root, "ModelStructure")
    every = (*model.variables, TIME)
    used = {
        variable(listed, i, every[i : i + length]) for i, length in enumerate(lengths(every, STANDARD.arrays)) if length > 0
    }
    outputs = [str(i) for i, each in enumerate(every) if each.causality == "output"]
    for reference in outputs:
        # Outputs change in doStep only: no direct feedthrough, so that importers need not iterate.
        ET.SubElement(structure, "Output", valueReference=reference, dependencies="")
    for reference in outputs:
        ET.SubElement(structure, "InitialUnknown", valueReference=reference)
    define_units(root, used, STANDARD)
    return serialized(root)


def build_description(model: Model) -> bytes:
    """How the sources are compiled to a shared library, whose functions have no prefix."""
    root = ET.Element("fmiBuildDescription", fmiVersion=STANDARD.version)
    configuration = ET.SubElement(root, "BuildConfiguration", modelIdentifier=model.name)
    files = ET.SubElement(configuration, "SourceFileSet", language="C99")
    ET.SubElement(files, "SourceFile", name=STANDARD.compiled)
    ET.SubElement(files, "PreprocessorDefinition", name="FMI3_OVERRIDE_FUNCTION_PREFIX", value="1")
    return serialized(root)
