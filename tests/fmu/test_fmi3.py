"""The FMU of FMI 3.0: the same variables and numbers as that of FMI 2.0, arrays, refusals, sources."""

import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import fmpy
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi3 import FMU3Slave
from fmpy.util import read_csv
from fmpy.validation import validate_fmu
from lxml import etree

from twintube.core import messages
from twintube.core.checks import tube_limit
from twintube.dampers import load
from twintube.fmu import build_fmu
from twintube.fmu.related import FOLDER

HERE = (fmpy.platform_tuple,)
H = 1e-3
LIMIT = tube_limit(load("SA8").parameters)
WORN = {"oil_level": 0.6, "gas_preload": 0}
SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3BuildDescription.xsd"


def elements(variable: Any) -> dict[str, float | None]:
    """Start values of a variable by the names that it has in FMI 2.0."""
    if variable.start is None:
        return {variable.name: None}
    values = [float(value) for value in variable.start.split()]
    return {variable.name: values[0]} if len(values) == 1 else {f"{variable.name}[{i}]": x for i, x in enumerate(values, 1)}


def test_it_describes_what_the_fmu_of_fmi_2_does(sa8_fmi3: Path, sa8_native: Path) -> None:
    assert sa8_fmi3.name == "twintube_SA8_fmi3.fmu" and validate_fmu(str(sa8_fmi3)) == []
    old, new = (fmpy.read_model_description(str(fmu)) for fmu in (sa8_native, sa8_fmi3))
    assert old.modelName == new.modelName
    listed = {v.name: v for v in old.modelVariables}
    for variable in new.modelVariables:
        if variable.causality == "independent":
            assert (variable.name, variable.unit) == ("time", "s")
            continue
        parts = elements(variable)
        for name, start in parts.items():
            other = listed.pop(name)
            assert start == (None if other.start is None else float(other.start))
            for key in ("description", "causality", "variability", "unit", "displayUnit", "min", "max", "nominal"):
                assert getattr(variable, key) == getattr(other, key), (name, key)
            assert variable.type == {"Real": "Float64", "Integer": "Int32"}[other.type]
            if name in (variable.name, f"{variable.name}[1]"):
                assert variable.valueReference == other.valueReference
    assert listed == {}
    assert [u.name for u in new.unitDefinitions] == [u.name for u in old.unitDefinitions]


def test_its_files_lie_where_fmi_3_wants_them(sa8_fmi3: Path) -> None:
    with zipfile.ZipFile(sa8_fmi3) as archive:
        names = archive.namelist()
        etree.XMLSchema(etree.parse(str(SCHEMA))).assertValid(etree.fromstring(archive.read("sources/buildDescription.xml")))
        page = archive.read("documentation/index.html").decode()
        terminals = ET.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml"))
        licence = archive.read("documentation/licenses/fmi_headers.txt").decode()
    assert f"binaries/{HERE[0]}/twintube_SA8{fmpy.sharedLibraryExtension}" in names
    assert {"sources/fmi3.c", "terminalsAndIcons/icon.png", f"{FOLDER}/reference.csv"} <= set(names)
    assert not {"model.png", "sources/fmi2.c"} & set(names)
    assert "fmi3Error" in page and "fmi2" not in page
    assert [t.get("name") for t in terminals.iter("Terminal")] == ["flange"] and "2-Clause BSD" in licence


# Values and refusals


class Unit:
    """An instance between steps, with its log."""

    def __init__(self, fmu: Path, *, logging_on: bool = False) -> None:
        description = fmpy.read_model_description(str(fmu))
        self.said: list[str] = []
        self.slave = FMU3Slave(guid=description.guid, unzipDirectory=fmpy.extract(str(fmu)),
                               modelIdentifier=description.coSimulation.modelIdentifier, instanceName="x")  # fmt: skip
        self.slave.instantiate(loggingOn=logging_on, logMessage=lambda *said: self.said.append(said[3].decode()))
        self.refs = {v.name: v.valueReference for v in description.modelVariables}
        self.time = 0.0

    def begun(self, stop: float | None = None) -> "Unit":
        self.slave.enterInitializationMode(startTime=0.0, stopTime=stop)
        self.slave.exitInitializationMode()
        return self

    def step(self, velocity: float = 0.2) -> None:
        (stroke,) = self.slave.getFloat64([self.refs["stroke"]])
        self.slave.setFloat64([self.refs["velocity"]], [velocity])
        self.slave.doStep(self.time, H)
        self.time += H
        self.slave.setFloat64([self.refs["stroke"]], [stroke + velocity * H])

    def outputs(self) -> list[float]:
        names = ("force", "work", "k_degr", "V1.oil", "time")
        found: list[float] = self.slave.getFloat64([self.refs[name] for name in names])
        return found

    def refused(self, call: Callable[[], object]) -> str:
        """The message of a refused call, after which the unit is as before and goes on."""
        before, count = self.outputs(), len(self.said)
        with pytest.raises(FMICallException):
            call()
        assert self.outputs() == before and len(self.said) == count + 1
        return self.said[-1]


@pytest.fixture
def unit(sa8_fmi3: Path) -> Iterator[Unit]:
    unit = Unit(sa8_fmi3).begun(stop=1.0)
    yield unit
    unit.slave.terminate()
    unit.slave.freeInstance()


def test_values_are_refused_in_the_words_of_fmi_2(unit: Unit) -> None:
    unit.step()
    cases: list[tuple[str, float, str]] = [
        ("oil_level", 0.5, messages.FIXED % "oil_level"),
        ("force", 1.0, messages.NOT_SETTABLE % "force"),
        ("time", 1.0, "time: cannot be set"),
        ("friction.F_FrS", -1.0, "friction.F_FrS = -1 N: must be a number from 0 to 2000 N"),
        ("velocity", float("nan"), "velocity = nan m/s: must be a number from -20 to 20 m/s"),
        (
            "reading.venting",
            1.0,
            messages.NO_VARIABLE % ("fmi3SetFloat64", "Float64", unit.refs["reading.venting"]),
        ),
        ("fv.v_re", 1.0, "fmi3SetFloat64: 1 values, the variables have 20"),
    ]
    for name, value, said in cases:
        assert unit.refused(lambda name=name, value=value: unit.slave.setFloat64([unit.refs[name]], [value])) == said
    inner = unit.refs["fv.v_re"] + 1
    said = unit.refused(lambda: unit.slave.getFloat64([inner]))
    assert said == messages.NO_VARIABLE % ("fmi3GetFloat64", "Float64", inner)
    unit.step()


def test_steps_and_modes_are_refused_in_the_words_of_fmi_2(unit: Unit, sa8_fmi3: Path) -> None:
    unit.step()
    assert unit.refused(lambda: unit.slave.doStep(0.5, H)) == messages.MISTIMED % (0.5, H)
    assert unit.refused(lambda: unit.slave.doStep(H, 2.0)) == messages.BEYOND_STOP % (2.0, H, 1.0)
    assert unit.refused(lambda: unit.slave.doStep(H, -1.0)).startswith("communication step = -1 s: must be a number")
    assert unit.refused(unit.slave.enterEventMode) == "fmi3EnterEventMode: this FMU has no event mode"
    unit.slave.setFloat64([unit.refs["stroke"]], [0.4])
    refusal = unit.refused(lambda: unit.slave.doStep(H, H))
    assert refusal == messages.outside("stroke", 0.4, -LIMIT, LIMIT, "m")
    unit.slave.setFloat64([unit.refs["stroke"]], [0.0])
    unit.step()
    fresh = Unit(sa8_fmi3)
    with pytest.raises(FMICallException):
        fresh.slave.doStep(0.0, H)
    assert fresh.said == [messages.NOT_NOW % ("fmi3DoStep", messages.MODES[0])]
    fresh.slave.freeInstance()


def test_what_the_unit_has_not_is_not_instantiated(sa8_fmi3: Path) -> None:
    for asked, said in (
        ({"eventModeUsed": True}, "no event mode"),
        ({"requiredIntermediateVariables": [2]}, "1 intermediate variables, this FMU has none"),
    ):
        told: list[str] = []
        slave = Unit(sa8_fmi3).slave
        with pytest.raises(Exception, match="Failed to instantiate"):
            slave.instantiate(logMessage=lambda *words, told=told: told.append(words[3].decode()), **asked)
        assert len(told) == 1 and said in told[0]


@pytest.mark.parametrize("logging_on", [False, True])
def test_a_warning_is_said_where_logging_is_on(sa8_fmi3: Path, logging_on: bool) -> None:
    """Errors are always said, as FMI 3.0.3 asks."""
    unit = Unit(sa8_fmi3, logging_on=logging_on).begun()
    unit.slave.doStep(0.0, 0.05)
    assert [text.startswith("time 0 s: communication step = 0.05 s") for text in unit.said] == [True] * logging_on
    with pytest.raises(FMICallException):
        unit.slave.doStep(9.0, H)
    assert unit.said[-1] == messages.MISTIMED % (9.0, 0.05)
    unit.slave.freeInstance()


def test_the_curve_is_set_as_an_array_and_fmpy_takes_it(sa8_fmi3: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(sa8_fmi3) as archive:
        given = read_csv(archive.extract(f"{FOLDER}/input.csv", tmp_path))[:200]
    softer = [0.5 * force for force in load("SA8").parameters.F_re]
    common = {"input": given, "output": ["force", "fv.F_re"], "output_interval": H, "stop_time": given["time"][-1]}
    plain = fmpy.simulate_fmu(str(sa8_fmi3), **common)
    soft = fmpy.simulate_fmu(str(sa8_fmi3), start_values={"fv.F_re": softer}, **common)
    assert soft["fv.F_re"][-1].tolist() == softer
    own = build_fmu(load("SA8").with_(F_re=tuple(softer)), tmp_path, platforms=HERE, fmi=3)
    assert soft["force"].tolist() == fmpy.simulate_fmu(str(own), **common)["force"].tolist()
    assert soft["force"].max() < 0.8 * plain["force"].max()
