"""The FMUs of all dampers, both kinds: rules of FMI 2.0 that importers check, and bounds that the unit keeps."""

import re
import zipfile
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree as ET

import fmpy
import pytest
from fmpy.validation import validate_fmu

from twintube.core.units import DISPLAY
from twintube.dampers import load, names
from twintube.demo.damper_fmu import DamperFmu
from twintube.fmu import build_fmu
from twintube.fmu.instance import FmuError
from twintube.fmu.platforms import Kind

# FMI 2.0, section 2.2.7: causality and variability, what `initial` may be, the default first; empty: it must be absent.
INITIAL: dict[tuple[str, str], tuple[str, ...]] = {
    ("parameter", "fixed"): ("exact",),
    ("parameter", "tunable"): ("exact",),
    ("input", "discrete"): ("",),
    ("input", "continuous"): ("",),
    ("output", "constant"): ("exact",),
    ("output", "discrete"): ("calculated", "exact", "approx"),
    ("output", "continuous"): ("calculated", "exact", "approx"),
    ("local", "continuous"): ("calculated", "exact", "approx"),
    ("local", "discrete"): ("calculated", "exact", "approx"),
}
STRUCTURED = re.compile(r"[A-Za-z_]\w*(\[\d+\])?(\.[A-Za-z_]\w*(\[\d+\])?)*", re.ASCII)
C_NAME = re.compile(r"[A-Za-z_]\w{0,62}", re.ASCII)


def description_of(fmu: Path) -> ET.Element:
    with zipfile.ZipFile(fmu) as archive:
        return ET.fromstring(archive.read("modelDescription.xml"))


def number_rules(name: str, real: ET.Element) -> Iterator[str]:
    value = {key: float(real.get(key, "nan")) for key in ("min", "max", "start", "nominal")}
    if value["min"] > value["max"]:
        yield f"{name}: min above max"
    if value["start"] < value["min"] or value["start"] > value["max"]:
        yield f"{name}: start outside min and max"
    if real.tag == "Real" and not value["nominal"] > 0:
        yield f"{name}: nominal"


def variable_rules(variable: ET.Element, units: dict[str, set[str]], types: dict[str, ET.Element]) -> Iterator[str]:
    name, (value,) = variable.get("name", ""), variable
    causality, variability = variable.get("causality", "local"), variable.get("variability", "continuous")
    allowed = INITIAL.get((causality, variability))
    if allowed is None:
        yield f"{name}: {causality} cannot be {variability}"
        return
    if variable.get("initial", allowed[0]) not in allowed:
        yield f"{name}: initial"
    initial = variable.get("initial", allowed[0])
    if (causality == "input" or initial in ("exact", "approx")) != ("start" in value.attrib):
        yield f"{name}: start is missing or too much"
    if value.tag != "Real" and variability == "continuous":
        yield f"{name}: only Real can be continuous"
    if not STRUCTURED.fullmatch(name) or not variable.get("description"):
        yield f"{name}: name or description"
    unit, shown, declared = value.get("unit"), value.get("displayUnit"), value.get("declaredType")
    if unit is not None and unit not in units:
        yield f"{name}: unit {unit} is not defined"
    if shown is not None and shown not in units.get(unit or "", set()):
        yield f"{name}: display unit {shown} is not defined"
    if declared is not None and (declared not in types or types[declared].get("unit") != unit):
        yield f"{name}: type {declared}"
    yield from number_rules(name, value)


def violations(root: ET.Element) -> list[str]:
    """What a strict checker of model descriptions says, beyond the schema."""
    units = {
        unit.get("name", ""): {shown.get("name", "") for shown in unit.findall("DisplayUnit")}
        for unit in root.findall("UnitDefinitions/Unit")
    }
    types = {item.get("name", ""): item[0] for item in root.findall("TypeDefinitions/SimpleType")}
    variables = root.findall("ModelVariables/ScalarVariable")
    remarks = [remark for variable in variables for remark in variable_rules(variable, units, types)]
    for key in ("name", "valueReference"):
        if len({variable.get(key) for variable in variables}) != len(variables):
            remarks.append(f"{key} is not unique")
    outputs = [str(i + 1) for i, variable in enumerate(variables) if variable.get("causality") == "output"]
    # All outputs are calculated; there are no states and no calculated parameters.
    for part in ("Outputs", "InitialUnknowns"):
        if [unknown.get("index") for unknown in root.findall(f"ModelStructure/{part}/Unknown")] != outputs:
            remarks.append(f"{part} are not the outputs in their order")
    simulation, experiment = root.find("CoSimulation"), root.find("DefaultExperiment")
    assert simulation is not None and experiment is not None
    if not C_NAME.fullmatch(simulation.get("modelIdentifier", "")):
        remarks.append("modelIdentifier")
    if not re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", root.get("generationDateAndTime", "")):
        remarks.append("generationDateAndTime")
    timing = [float(experiment.get(key, "nan")) for key in ("startTime", "stopTime", "stepSize", "tolerance")]
    if not (timing[0] < timing[1] and timing[2] > 0 and timing[3] > 0):
        remarks.append("DefaultExperiment")
    return remarks


@pytest.fixture(scope="module", params=names())
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def built(name: str, kind: Kind, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The FMU of a damper, alone in its folder."""
    return build_fmu(load(name), tmp_path_factory.mktemp("built") / "a.fmu", kind, (fmpy.platform,))


def test_every_damper_builds_and_breaks_no_rule(built: Path) -> None:
    """The build itself raises what fmpy's validation says."""
    assert violations(description_of(built)) == []
    assert [path.name for path in built.parent.iterdir()] == ["a.fmu"]


def test_the_unit_takes_the_declared_strokes_and_none_beyond(built: Path) -> None:
    stroke = description_of(built).find("ModelVariables/ScalarVariable[@name='stroke']/Real")
    assert stroke is not None
    lowest, highest = float(stroke.get("min", "nan")), float(stroke.get("max", "nan"))
    for end, beyond in ((highest, 1e-5), (lowest, -1e-5)):
        with DamperFmu(built, stroke=end) as damper:
            assert damper.step(end, 0.0, 1e-3) == damper.outputs()["force"]
            damper.step(end - beyond, beyond / 1e-3, 1e-3)
            with pytest.raises(FmuError, match=f"stroke = .* m: must be a number from {lowest:g} to {highest:g} m"):
                damper.step(end + beyond, 0.0, 1e-3)


@pytest.fixture(scope="module")
def sa8(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_fmu(load("SA8"), tmp_path_factory.mktemp("sa8") / "a.fmu", platforms=(fmpy.platform,))


def test_fmpy_finds_a_wrong_unit(sa8: Path, tmp_path: Path) -> None:
    """The schema does not know units: fmpy's validation stands in the tests for such errors."""
    assert validate_fmu(str(sa8)) == []
    with zipfile.ZipFile(sa8) as archive, zipfile.ZipFile(tmp_path / "bad.fmu", "w") as bad:
        text = archive.read("modelDescription.xml").replace(b'Force" unit="N"', b'Force" unit="kN"')
        bad.writestr("modelDescription.xml", text)
    assert any("kN" in remark for remark in validate_fmu(str(tmp_path / "bad.fmu")))


@pytest.mark.parametrize(
    ("path", "change", "remark"),
    [
        ("ModelVariables/ScalarVariable[@name='oil_level']/Real", {"start": "1.5"}, "oil_level: start outside"),
        ("ModelVariables/ScalarVariable[@name='oil_level']/Real", {"nominal": "0"}, "oil_level: nominal"),
        ("ModelVariables/ScalarVariable[@name='force']/Real", {"start": "0"}, "force: start"),
        ("ModelVariables/ScalarVariable[@name='force']/Real", {"unit": "kN"}, "force: unit kN"),
        ("ModelVariables/ScalarVariable[@name='stroke']/Real", {"displayUnit": "inch"}, "stroke: display unit inch"),
        ("ModelVariables/ScalarVariable[@name='stroke']", {"initial": "exact"}, "stroke: initial"),
        ("ModelVariables/ScalarVariable[@name='gas_preload']", {"variability": "continuous"}, "gas_preload: parameter"),
        ("ModelVariables/ScalarVariable[@name='work']", {"name": "force"}, "name is not unique"),
        ("ModelVariables/ScalarVariable[@name='work']", {"name": "Größe"}, "Größe: name"),
        ("ModelStructure/InitialUnknowns/Unknown", {"index": "1"}, "InitialUnknowns"),
        ("CoSimulation", {"modelIdentifier": "twintube_SÄ8"}, "modelIdentifier"),
    ],
)
def test_the_rules_see_what_breaks_them(sa8: Path, path: str, change: dict[str, str], remark: str) -> None:
    root = description_of(sa8)
    element = root.find(path)
    assert element is not None
    element.attrib.update(change)
    assert [text for text in violations(root) if text.startswith(remark)]


def test_lengths_and_volumes_are_shown_in_mm_and_ml(sa8: Path) -> None:
    description = fmpy.read_model_description(str(sa8))
    for variable in description.modelVariables:
        assert variable.displayUnit == (DISPLAY[variable.unit][0] if variable.unit in DISPLAY else None)
    factors = {shown.name: shown.factor for unit in description.unitDefinitions for shown in unit.displayUnits}
    assert factors == {"mm": 1e3, "mL": 1e6}
    nominal = {variable.name: float(variable.nominal) for variable in description.modelVariables if variable.type == "Real"}
    assert nominal["stroke"] == 0.05
    assert {nominal[f"V{i}.{phase}"] for i in (1, 2, 3) for phase in ("oil", "gas", "foam")} == {1e-4}
    assert nominal["force"] == 1000.0
    assert description.defaultExperiment.tolerance is not None
