"""terminalsAndIcons.xml: which variables belong to the mechanical connection, and where the icon is drawn.

FMI 2.0.4 takes over folder and format of FMI 3.0, section 2.4.9, with the version of FMI 3.0 in the file. Importers that do
not know it ignore it.
"""

from xml.etree import ElementTree as ET

from twintube.fmu.description import serialized

FILE = "terminalsAndIcons/terminalsAndIcons.xml"
ICON = "terminalsAndIcons/icon.png"
# The force is positive where it pulls the ends together: at the rod's end it then flows into the damper.
MEMBERS = {"stroke": "signal", "velocity": "signal", "force": "inflow"}


def terminals() -> bytes:
    """The text of the file; its names are those of the model description."""
    root = ET.Element("fmiTerminalsAndIcons", fmiVersion="3.0")
    picture = ET.SubElement(root, "GraphicalRepresentation")
    square = {"x1": "-100", "y1": "-100", "x2": "100", "y2": "100"}
    ET.SubElement(picture, "CoordinateSystem", square, suggestedScalingFactorTo_mm="0.1")
    ET.SubElement(picture, "Icon", square)
    terminal = ET.SubElement(
        ET.SubElement(root, "Terminals"), "Terminal", name="flange", matchingRule="plug",
        description="Rod's end relative to the tube's end: stroke and velocity in, force out",
    )  # fmt: skip
    for name, kind in MEMBERS.items():
        ET.SubElement(terminal, "TerminalMemberVariable", variableName=name, memberName=name, variableKind=kind)
    return serialized(root)
