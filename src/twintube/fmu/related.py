"""The reference run inside the FMU as the layered standard FMI-LS-REF 1.0.0-alpha.1 places it.

https://github.com/modelica/fmi-ls-ref. Its format of experiments still changes; the manifest names the two files, and the
default experiment of the model description is the run.
"""

from xml.etree import ElementTree as ET

from twintube.dampers import Damper
from twintube.fmu import reference
from twintube.fmu.description import serialized

FOLDER = "extra/org.fmi-standard.fmi-ls-ref"
MANIFEST = {
    "xmlns:fmi-ls": "http://fmi-standard.org/fmi-ls-manifest",
    "fmi-ls:fmi-ls-name": "org.fmi-standard.fmi-ls-ref",
    "fmi-ls:fmi-ls-version": "1.0.0-alpha.1",
    "fmi-ls:fmi-ls-description": "Layered Standard providing information on related files included in an FMU.",
}
FILES = {
    "input.csv": ("testcase", "Input of the default experiment: a row is set before the step that starts at its time"),
    "reference.csv": ("result", "Output of the default experiment: a row holds at its time, before that step"),
}


def manifest() -> bytes:
    """The text of `fmi-ls-manifest.xml`."""
    root = ET.Element("fmiReferences", MANIFEST)
    for name, (role, description) in FILES.items():
        ET.SubElement(root, "Related", type="text/csv", source=name, role=role, description=description)
    return serialized(root)


def files(damper: Damper) -> dict[str, bytes]:
    """Manifest, input and output by their path inside the FMU."""
    run = {f"{FOLDER}/{name}": text.encode() for name, text in reference.files(damper).items()}
    return {f"{FOLDER}/fmi-ls-manifest.xml": manifest()} | run
