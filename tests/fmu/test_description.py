"""What the FMU says about itself."""

import re
import zipfile
from dataclasses import fields
from pathlib import Path
from xml.etree import ElementTree as ET

import fmpy
import pytest

from twintube.core.effects import Parameters
from twintube.core.units import UNITS
from twintube.core.variables import Inputs, Outputs, fmi_name
from twintube.dampers import load
from twintube.fmu.description import model_name

CONTRACT = (
    "stroke velocity force k_degr force_fluid force_friction force_gas work V1.oil V1.gas V1.foam V2.oil V2.gas V2.foam "
    "V3.oil V3.gas V3.foam V_cav oil_level gas_preload geometry.D_li degradation.X_Re"
).split()


def test_variables_have_units_bounds_and_descriptions(sa8_fmu: Path) -> None:
    description = fmpy.read_model_description(str(sa8_fmu))
    described = {v.name: v for v in description.modelVariables}
    assert set(CONTRACT) <= set(described)
    defined = {u.name for u in description.unitDefinitions}
    assert defined == {v.unit for v in description.modelVariables if v.unit} <= set(UNITS)
    for record in (Inputs, Outputs, Parameters):
        for item in fields(record):
            name = fmi_name(item) + ("[1]" if item.metadata["size"] > 1 else "")
            variable, meta = described[name], item.metadata
            assert variable.description == meta["description"]
            assert variable.unit == (None if meta["unit"] == "1" else meta["unit"])
            assert len(name) <= 55  # Simulink
            if meta["lower"] is not None and name != "stroke":  # its bounds are those of the tube
                assert float(variable.min) == meta["lower"]
            if record is Parameters:
                assert variable.causality == "parameter"
                assert variable.variability == ("tunable" if meta["tunable"] else "fixed")
    assert float(described["oil_level"].start) == 1.0
    assert float(described["geometry.D_li"].start) == pytest.approx(0.0298)


def test_outputs_do_not_feed_through(sa8_fmu: Path) -> None:
    with zipfile.ZipFile(sa8_fmu) as archive:
        root = ET.fromstring(archive.read("modelDescription.xml"))
    outputs = root.findall("ModelStructure/Outputs/Unknown")
    assert len(outputs) == len(fields(Outputs))
    assert all(unknown.get("dependencies") == "" for unknown in outputs)
    assert len(root.findall("ModelStructure/InitialUnknowns/Unknown")) == len(outputs)
    simulation = root.find("CoSimulation")
    assert simulation is not None
    assert simulation.get("canGetAndSetFMUstate") == "true"
    assert simulation.get("canBeInstantiatedOnlyOncePerProcess") == "false"


def test_page_icon_and_licence_travel_along(sa8_fmu: Path) -> None:
    with zipfile.ZipFile(sa8_fmu) as archive:
        listed = archive.namelist()
        page = archive.read("documentation/index.html").decode()
        assert archive.read("model.png").startswith(b"\x89PNG")
    assert "documentation/licenses/license.txt" in listed
    assert "assumed:" in page
    assert "fv.v_re" in page.replace("<wbr>", "")
    # Standard library only on the target: nothing of numpy, no path of the machine that built it.
    with zipfile.ZipFile(sa8_fmu) as archive:
        for name in listed:
            if name.startswith("resources/") and "/pythonfmu/" not in name and name.endswith(".py"):
                text = archive.read(name).decode()
                assert "numpy" not in text


def test_the_modelica_text_uses_names_of_the_fmu(sa8_fmu: Path) -> None:
    text = (Path(__file__).parents[2] / "docs" / "TwinTube.mo").read_text(encoding="utf-8")
    (model, modifiers), used = re.findall(r"(\w+)_fmu fmu\((.*?)\)", text, re.DOTALL)[0], re.findall(r"\bfmu\.(\w+)", text)
    used += re.findall(r"(\w+) =", modifiers)
    used.remove("fmi_CommunicationStepSize")  # of the importing tool
    description = fmpy.read_model_description(str(sa8_fmu))
    assert description.coSimulation.modelIdentifier == model
    assert set(used) == {"stroke", "velocity", "temperature", "force", "oil_level", "gas_preload"}
    assert set(used) <= {v.name for v in description.modelVariables}


def test_the_modelica_text_of_a_car_uses_names_of_the_fmus() -> None:
    text = (Path(__file__).parents[2] / "docs" / "TwinTubeCar.mo").read_text(encoding="utf-8")
    assert re.findall(r"(\w+)_fmu (\w+)\[2\]", text) == [("twintube_SA7", "front"), ("twintube_SA8", "rear")]
    assert {model_name(load(name)) for name in ("SA7", "SA8")} == {"twintube_SA7", "twintube_SA8"}
    for axle in ("front", "rear"):
        assert set(re.findall(rf"\b{axle}\[i\]\.(\w+)", text)) == {"stroke", "velocity", "temperature", "force"}
