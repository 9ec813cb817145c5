"""Parameters as SSV: importers of SSP that are not ours run the FMU with them."""

import re
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from xml.etree import ElementTree as ET

import fmpy
import pytest
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from lxml import etree
from typer.testing import CliRunner

from twintube.cli import app
from twintube.dampers import Damper, elements, load, names
from twintube.dampers.freed_gas import as_published
from twintube.demo.damper_fmu import DamperFmu
from twintube.fmu.ssv import to_ssv

NS = {
    "ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues",
    "ssc": "http://ssp-standard.org/SSP1/SystemStructureCommon",
}
SCHEMAS = Path(fmpy.__file__).parent / "ssp" / "schema"
SCHEMA = SCHEMAS / "SystemStructureParameterValues.xsd"
GUIDE = Path(__file__).parents[2] / "docs" / "import_ssp.md"
# Another damper than the FMU's, in another condition: hardly a parameter is that of SA8.
WORN = load("SA7").with_(oil_level=0.56, gas_preload=0)
STROKE, VELOCITY, FORCE = 0, 1, 3  # value references, in the order of the variables
VELOCITIES = [0.4] * 100 + [-0.3] * 200 + [0.05] * 100
STROKES = [sum(VELOCITIES[:i]) * 1e-3 for i in range(len(VELOCITIES))]


def structure() -> str:
    """The system that the guide prints."""
    (text,) = re.findall(r"```xml\n(<\?xml.*?)```", GUIDE.read_text(encoding="utf-8"), re.DOTALL)
    return str(text)


def former(text: str) -> str:
    """An SSV text of before the gas preload became a share: a whole number."""
    share, whole = (f'<ssv:{kind} value="{value}"' for kind, value in (("Real", "0.0"), ("Integer", "0")))
    head, name, rest = text.partition('name="gas_preload"')
    assert share in rest
    return head + name + rest.replace(share, whole, 1)


@pytest.fixture
def system(sa8_native: Path, tmp_path: Path) -> Path:
    """The folder of an SSP of the SA8 with the parameters of WORN."""
    folder = tmp_path / "ssp"
    (folder / "resources").mkdir(parents=True)
    (folder / "SystemStructure.ssd").write_text(structure())
    (folder / "resources" / "worn.ssv").write_text(to_ssv(WORN))
    (folder / "resources" / "twintube_SA8.fmu").write_bytes(sa8_native.read_bytes())
    return folder


def set_directly(fmu: Path, damper: Damper, steps: list[float]) -> list[float]:
    """Forces of the FMU in fmpy, all parameters set by their names."""
    start = {name: float(value) for name, _, _, value in elements(damper)}
    with DamperFmu(fmu, **start) as unit:
        forces = [unit.step(*at) for at in zip(STROKES, VELOCITIES, steps, strict=True)]
        assert unit.messages == []
    return forces


@pytest.mark.parametrize("written", [str, former])
def test_ecos_runs_the_fmu_with_the_parameters(
    system: Path, ecos: ModuleType, sa8_native: Path, tmp_path: Path, written: Callable[[str], str]
) -> None:
    (system / "resources" / "worn.ssv").write_text(written(to_ssv(WORN)))
    with zipfile.ZipFile(tmp_path / "rig.ssp", "w") as archive:
        for file in system.rglob("*.*"):
            archive.write(file, file.relative_to(system))
    forces = []
    with ecos.EcosSimulation(step_size=1e-3, ssp_path=str(tmp_path / "rig.ssp")) as run:
        assert run.init(parameter_set=WORN.name)
        assert run.get_real("damper::fv.F_re[3]") == WORN.parameters.F_re[2]
        assert run.get_real("damper::gas_preload") == 0.0
        for z, v in zip(STROKES, VELOCITIES, strict=True):
            run.set_real("damper::stroke", z)
            run.set_real("damper::velocity", v)
            run.step()
            forces.append(run.get_real("damper::force"))
        run.terminate()
    assert forces == set_directly(sa8_native, WORN, [1e-3] * len(STROKES))
    assert forces != set_directly(sa8_native, load("SA8"), [1e-3] * len(STROKES))


def test_libcosim_runs_the_fmu_with_the_parameters(system: Path, sa8_native: Path) -> None:
    execution = CosimExecution.from_ssp_file(ssp_path=str(system), step_size=1_000_000)
    manipulator, observer = CosimManipulator.create_override(), CosimObserver.create_last_value()
    execution.add_manipulator(manipulator)
    execution.add_observer(observer)
    forces = []
    for z, v in zip(STROKES, VELOCITIES, strict=True):
        assert manipulator.slave_real_values(slave_index=0, variable_references=[STROKE, VELOCITY], values=[z, v])
        assert execution.step()
        forces += observer.last_real_values(slave_index=0, variable_references=[FORCE])
    # libcosim counts nanoseconds: its steps are differences of rounded times.
    steps = [(i + 1) * 1_000_000 / 1e9 - i * 1_000_000 / 1e9 for i in range(len(STROKES))]
    assert forces == set_directly(sa8_native, WORN, steps)


def test_names_kinds_and_units_are_those_of_the_fmu(sa8_native: Path) -> None:
    description = fmpy.read_model_description(str(sa8_native))
    root = ET.fromstring(to_ssv(load("SA8")))
    written = {}
    for parameter in root.findall("ssv:Parameters/ssv:Parameter", NS):
        (number,) = parameter
        written[parameter.get("name")] = (
            number.tag.partition("}")[2],
            number.get("unit"),
            float(number.get("value", "nan")),
        )
    assert written == {
        v.name: (v.type, v.unit, float(v.start)) for v in description.modelVariables if v.causality == "parameter"
    }
    exponents = {unit.get("name"): dict(unit[0].attrib) for unit in root.findall("ssv:Units/ssc:Unit", NS)}
    assert set(exponents) == {unit for _, unit, _ in written.values() if unit}
    for unit in description.unitDefinitions:
        if unit.name in exponents:
            powers = {base: int(power) for base, power in exponents[unit.name].items()}
            assert powers == {base: getattr(unit.baseUnit, base) for base in powers}


def test_the_printed_system_is_valid_and_says_its_step_to_omsimulator() -> None:
    root = etree.fromstring(structure().encode())
    etree.XMLSchema(etree.parse(str(SCHEMAS / "SystemStructureDescription.xsd"))).assertValid(root)
    spaces = {"ssc": NS["ssc"], "oms": root.nsmap["oms"]}
    path = "//ssc:Annotation[@type='org.openmodelica']/oms:Annotations/oms:SimulationInformation/oms:FixedStepMaster"
    (master,) = root.xpath(path, namespaces=spaces)
    assert (master.get("description"), float(master.get("stepSize"))) == ("oms-ma", 0.001)


@pytest.mark.parametrize("name", names())
def test_ssv_is_valid(name: str) -> None:
    schema = etree.XMLSchema(etree.parse(str(SCHEMA)))
    schema.assertValid(etree.fromstring(to_ssv(load(name)).encode()))


def test_control_characters_in_a_name_keep_the_text_well_formed() -> None:
    odd = replace(load("SA8"), name='a\x00\x1b"<&>\ufffe', title="\ud800\n")
    schema = etree.XMLSchema(etree.parse(str(SCHEMA)))
    schema.assertValid(etree.fromstring(to_ssv(odd).encode()))


def test_command_writes_the_parameters(tmp_path: Path) -> None:
    file = tmp_path / "new" / "worn.ssv"
    run = CliRunner().invoke(app, ["fmu", "--ssv", "SA7", "--oil-level", "0.56", "--gas-lost", "--output", str(file)])
    assert run.exit_code == 0, run.output
    assert "SA7" in run.output
    assert file.read_text(encoding="utf-8") == to_ssv(WORN)
    arguments = ["fmu", "--ssv", "SA7", "--oil-level", "0.56", "--gas-lost", "--as-published", "--output", str(file)]
    assert CliRunner().invoke(app, arguments).exit_code == 0
    assert file.read_text(encoding="utf-8") == to_ssv(as_published(WORN))


def test_command_keeps_the_condition_of_a_file_and_refuses_bad_values(tmp_path: Path) -> None:
    shown = CliRunner().invoke(app, ["dampers", "SA7"]).output.replace("oil_level = 1.0", "oil_level = 0.7")
    (tmp_path / "mine.toml").write_text(shown)
    run = CliRunner().invoke(app, ["fmu", "--ssv", str(tmp_path / "mine.toml"), "--output", str(tmp_path / "mine.ssv")])
    assert run.exit_code == 0, run.output
    root = ET.parse(tmp_path / "mine.ssv")
    oil = root.find("ssv:Parameters/ssv:Parameter[@name='oil_level']/ssv:Real", NS)
    assert oil is not None
    assert oil.get("value") == "0.7"
    bad = CliRunner().invoke(app, ["fmu", "--ssv", "SA7", "--oil-level", "1.7", "--output", str(tmp_path / "bad.ssv")])
    assert bad.exit_code == 2
    assert "oil_level = 1.7: must be a number from 0 to 1" in bad.output
    assert not (tmp_path / "bad.ssv").exists()
