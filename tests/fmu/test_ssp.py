"""The whole car as an SSP: valid, and run by two coordinators that are not ours, ecos and libcosim."""

import zipfile
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import fmpy
import numpy as np
import pytest
from coupled import PLATFORMS, SPEED, Coupled
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from lxml import etree
from masters import drive, wheels_of
from typer.testing import CliRunner

from twintube.cli import app
from twintube.common.arrays import Array
from twintube.fmu import BuildError
from twintube.fmu.ssp import build_ssp
from twintube.vehicle.full.car import WHEELS

SCHEMAS = Path(fmpy.__file__).parent / "ssp" / "schema"
LENGTHS = (4e-3, 2e-3, 1e-3)  # [s]
Step = Callable[[dict[str, float]], dict[str, float]]
READ = ["motion.x", "motion.y", "motion.v_x", *wheels_of("stroke"), *wheels_of("load")]


@pytest.fixture(scope="module")
def coupled(tmp_path_factory: pytest.TempPathFactory) -> Coupled:
    return Coupled(tmp_path_factory.mktemp("car"))


@pytest.fixture(scope="module")
def system(coupled: Coupled, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_ssp(coupled.car, SPEED, tmp_path_factory.mktemp("ssp") / "car.ssp", PLATFORMS)


def driven(coupled: Coupled, length: float, step: Step) -> tuple[Array, Array]:
    """Strokes at the start of each step and loads in it (n, 4); `step` sets inputs of the car, steps and reads READ."""
    rows, way = [], 0.0
    now = dict.fromkeys(READ, 0.0) | {"motion.v_x": SPEED}
    for steer, pressure, speed in coupled.inputs(length).tolist():
        heights, slopes = coupled.ground(way)
        given = {"steer": steer, "brake_pressure": pressure, "speed": speed}
        given |= dict(zip(wheels_of("road"), heights.tolist(), strict=True))
        given |= dict(zip(wheels_of("road_rate"), (slopes * now["motion.v_x"]).tolist(), strict=True))
        after = step(given)
        way += float(np.hypot(after["motion.x"] - now["motion.x"], after["motion.y"] - now["motion.y"]))
        rows.append([*(now[name] for name in wheels_of("stroke")), *(after[name] for name in wheels_of("load"))])
        now = after
    table = np.array(rows)
    return table[:, :4], table[:, 4:]


def by_ecos(ecos: ModuleType, system: Path, coupled: Coupled, length: float) -> tuple[Array, Array]:
    with ecos.EcosSimulation(step_size=length, ssp_path=str(system)) as run:
        assert run.init(parameter_set=coupled.car.name)
        assert run.get_real("front_right::oil_level") == 0.5

        def step(given: dict[str, float]) -> dict[str, float]:
            for name, value in given.items():
                run.set_real(f"car::{name}", value)
            run.step()
            return {name: run.get_real(f"car::{name}") for name in READ}

        rows = driven(coupled, length, step)
        run.terminate()
    return rows


def by_libcosim(system: Path, coupled: Coupled, length: float, folder: Path) -> tuple[Array, Array]:
    with zipfile.ZipFile(system) as archive:
        archive.extractall(folder)
    execution = CosimExecution.from_ssp_file(ssp_path=str(folder), step_size=round(length * 1e9))
    manipulator, observer = CosimManipulator.create_override(), CosimObserver.create_last_value()
    execution.add_manipulator(manipulator)
    execution.add_observer(observer)
    (car,) = (info.index for info in execution.slave_infos() if info.name == b"car")
    references = {v.name: v.valueReference for v in fmpy.read_model_description(str(coupled.car_file)).modelVariables}

    def step(given: dict[str, float]) -> dict[str, float]:
        assert manipulator.slave_real_values(
            slave_index=car, variable_references=[references[name] for name in given], values=list(given.values())
        )
        assert execution.step()
        values = observer.last_real_values(slave_index=car, variable_references=[references[name] for name in READ])
        return dict(zip(READ, values, strict=True))

    return driven(coupled, length, step)


def assert_converges(coupled: Coupled, runs: dict[float, tuple[Array, Array]]) -> None:
    """The coupling error falls with the step, and at 1 ms the run is that of a plain master of the same FMUs."""
    errors = [coupled.errors(loads, strokes, length) for length, (strokes, loads) in runs.items()]
    assert all(fine < 0.8 * coarse for coarse, fine in zip(errors, errors[1:], strict=False))
    assert errors[-1] < 0.02
    plain = drive(coupled.car_file, coupled.damper_files, coupled.inputs(1e-3), coupled.ground, 1e-3, parallel=True)
    strokes, loads = runs[1e-3]
    assert np.abs(strokes - plain["stroke"]).max() < 1e-6
    assert np.abs(loads - plain["load"]).max() < 0.1


def test_ecos_drives_the_car(system: Path, coupled: Coupled, ecos: ModuleType) -> None:
    assert_converges(coupled, {length: by_ecos(ecos, system, coupled, length) for length in LENGTHS})


def test_libcosim_drives_the_car(system: Path, coupled: Coupled, tmp_path: Path) -> None:
    assert_converges(coupled, {length: by_libcosim(system, coupled, length, tmp_path) for length in LENGTHS})


def test_structure_and_parameters_follow_the_schemas_of_ssp(system: Path) -> None:
    with zipfile.ZipFile(system) as archive:
        texts = {name: archive.read(name) for name in archive.namelist() if not name.endswith(".fmu")}
    for name, text in texts.items():
        ending = "Description" if name.endswith(".ssd") else "ParameterValues"
        etree.XMLSchema(etree.parse(str(SCHEMAS / f"SystemStructure{ending}.xsd"))).assertValid(etree.fromstring(text))
    assert set(texts) == {"SystemStructure.ssd", *(f"resources/{name}.ssv" for name in ("car", *WHEELS))}
    root = etree.fromstring(texts["SystemStructure.ssd"])
    spaces = {"ssd": root.nsmap["ssd"], "ssc": root.nsmap["ssc"], "oms": root.nsmap["oms"]}
    path = "//ssc:Annotation[@type='org.openmodelica']/oms:Annotations/oms:SimulationInformation/oms:FixedStepMaster"
    (master,) = root.xpath(path, namespaces=spaces)
    assert (master.get("description"), float(master.get("stepSize"))) == ("oms-ma", 0.001)


def test_connections_join_inputs_to_outputs_of_one_unit(system: Path) -> None:
    with zipfile.ZipFile(system) as archive:
        root = etree.fromstring(archive.read("SystemStructure.ssd"))
    space = {"ssd": root.nsmap["ssd"]}
    kinds = {
        (component.get("name"), connector.get("name")): (connector.get("kind"), connector[0].get("unit"))
        for component in root.iterfind(".//ssd:Component", space)
        for connector in component.iterfind(".//ssd:Connector", space)
    }
    connections: list[Any] = root.findall(".//ssd:Connection", space)
    assert len(connections) == 12
    for connection in connections:
        start = kinds[connection.get("startElement"), connection.get("startConnector")]
        end = kinds[connection.get("endElement"), connection.get("endConnector")]
        assert (start[0], end[0], start[1]) == ("output", "input", end[1])


def test_the_command_says_what_it_wrote_and_refuses_bad_input(tmp_path: Path) -> None:
    file = tmp_path / "car.ssp"
    run = CliRunner().invoke(app, ["ssp", "--output", str(file), "--worn", "rear_left", "--oil-level", "0.5", "--gas-lost",
                                   "--platform", PLATFORMS[0]])  # fmt: skip
    assert run.exit_code == 0, run.output
    assert "passat_b8 with SA7 and SA8, rear_left: 50 % oil, gas lost" in run.output
    for arguments, message in (
        (["--speed", "0"], "speed 0 km/h: must be from 1 to 250 km/h"),
        (["--oil-level", "1.5"], "oil_level = 1.5: must be a number from 0 to 1"),
        (["--worn", "middle"], "worn middle: must be one of all, front"),
        (["--platform", "beos"], "platform = beos: must be one of"),
        (["--output", str(tmp_path / "car.zip")], "must be a file that ends with .ssp"),
    ):
        bad = CliRunner().invoke(app, ["ssp", "--output", str(tmp_path / "bad.ssp"), *arguments])
        assert bad.exit_code == 2, bad.output
        assert message in bad.output.replace("\n", " ")
    assert [path.name for path in tmp_path.iterdir()] == ["car.ssp"]


def test_an_output_of_another_kind_is_refused(coupled: Coupled, tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=r"must be a file that ends with \.ssp"):
        build_ssp(coupled.car, SPEED, tmp_path, PLATFORMS)
