"""The whole car as an SSP 1.0 or 2.0 file: the car's FMU, four damper FMUs, their connections and parameters."""

import tempfile
import zipfile
from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree as ET

from twintube.common.files import replacing
from twintube.fmu import archive
from twintube.fmu.assemble import BuildError, build_fmu
from twintube.fmu.car import build_car_fmu, car_model
from twintube.fmu.description import damper_model, serialized
from twintube.fmu.model import Model
from twintube.fmu.platforms import Ssp
from twintube.fmu.ssv import STANDARD, define_units, parameter_set, to_ssv
from twintube.fmu.standards import INSIDE, STANDARDS
from twintube.vehicle.full.car import WHEELS
from twintube.vehicle.full.run import FullCar
from twintube.version import __version__

OMS = "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd"
STEP = "0.001"  # [s]
CAR = "car"
# From the car to a damper, and back.
TO_DAMPER, TO_CAR = ("stroke", "velocity"), ("force",)
EXCHANGED = (*TO_DAMPER, *TO_CAR)


def add_component(
    elements: ET.Element, name: str, model: Model, *, wanted: Sequence[str] | None, used: set[str], ssp: Ssp
) -> None:
    """Add an FMU with its parameters and the connectors that are `wanted`, by default all inputs and outputs."""
    number, _ = STANDARDS[INSIDE[ssp]].types
    component = ET.SubElement(
        elements, "ssd:Component", name=name, type="application/x-fmu-sharedlibrary", source=f"resources/{name}.fmu"
    )
    connectors = ET.SubElement(component, "ssd:Connectors")
    for variable in model.variables:
        if variable.causality == "parameter" or (wanted is not None and variable.name not in wanted):
            continue
        unit = variable.item.metadata["unit"]
        connector = ET.SubElement(connectors, "ssd:Connector", name=variable.name, kind=variable.causality)
        ET.SubElement(connector, f"ssc:{number}", {} if unit == "1" else {"unit": unit})
        used.add(unit)
    bindings = ET.SubElement(component, "ssd:ParameterBindings")
    ET.SubElement(bindings, "ssd:ParameterBinding", type="application/x-ssp-parameter-set", source=f"resources/{name}.ssv")


def connect(connections: ET.Element, wheel: str) -> None:
    """Connect the damper of a wheel."""
    for name in TO_DAMPER:
        ET.SubElement(
            connections, "ssd:Connection",
            startElement=CAR, startConnector=f"{wheel}.{name}", endElement=wheel, endConnector=name,
        )  # fmt: skip
    for name in TO_CAR:
        ET.SubElement(
            connections, "ssd:Connection",
            startElement=wheel, startConnector=name, endElement=CAR, endConnector=f"{wheel}.{name}",
        )  # fmt: skip


def annotate(system: ET.Element) -> None:
    """Add what OMSimulator wants to know: its master and the communication step. Others ignore it."""
    annotation = ET.SubElement(ET.SubElement(system, "ssd:Annotations"), "ssc:Annotation", type="org.openmodelica")
    information = ET.SubElement(ET.SubElement(annotation, "oms:Annotations"), "oms:SimulationInformation")
    tolerances = {"absoluteTolerance": "0.0001", "relativeTolerance": "0.0001"}
    ET.SubElement(information, "oms:FixedStepMaster", tolerances, description="oms-ma", stepSize=STEP)


def structure(car: FullCar, speed: float, ssp: Ssp) -> bytes:
    """The text of `SystemStructure.ssd`; inputs of driver and road stay open."""
    spaces = {"ssd": f"{STANDARD}Description", "ssc": f"{STANDARD}Common", "oms": OMS}
    root = ET.Element(
        "ssd:SystemStructureDescription", {f"xmlns:{prefix}": space for prefix, space in spaces.items()},
        name=car_model(car, speed).name, version=f"{ssp}.0", generationTool=f"twintube {__version__}",
    )  # fmt: skip
    system = ET.SubElement(root, "ssd:System", name="root")
    elements, connections = ET.SubElement(system, "ssd:Elements"), ET.SubElement(system, "ssd:Connections")
    used: set[str] = set()
    # Inputs of driver and road stay open: ecos refuses connections to the outside of the system.
    add_component(elements, CAR, car_model(car, speed), wanted=None, used=used, ssp=ssp)
    for wheel, damper in zip(WHEELS, car.dampers, strict=True):
        add_component(elements, wheel, damper_model(damper), wanted=EXCHANGED, used=used, ssp=ssp)
        connect(connections, wheel)
    annotate(system)
    define_units(ET.SubElement(root, "ssd:Units"), used)
    ET.SubElement(root, "ssd:DefaultExperiment", startTime="0.0", stopTime="10.0")
    return serialized(root)


def parameters(car: FullCar, speed: float, ssp: Ssp) -> dict[str, bytes]:
    """The parameter sets by their path; all have the car's name, by which ecos takes them together."""
    model = car_model(car, speed)
    texts = {CAR: parameter_set(car.name, model.title, model.variables, ssp)}
    texts |= {wheel: to_ssv(damper, car.name, ssp) for wheel, damper in zip(WHEELS, car.dampers, strict=True)}
    return {f"resources/{name}.ssv": text.encode() for name, text in texts.items()}


def described(car: FullCar, speed: float, ssp: Ssp = 1) -> dict[str, bytes]:
    """The files by their path that say what is in the SSP: system and parameters."""
    return {"SystemStructure.ssd": structure(car, speed, ssp), **parameters(car, speed, ssp)}


def members(path: Path) -> dict[str, bytes]:
    """The files of an SSP that `described` gives; empty where it is none."""
    try:
        with zipfile.ZipFile(path) as packed:
            return {name: packed.read(name) for name in packed.namelist() if name.endswith((".ssd", ".ssv"))}
    except (OSError, zipfile.BadZipFile):
        return {}


def build_ssp(
    car: FullCar,
    speed: float,
    output: Path | str,
    platforms: Sequence[str] | None = None,
    *,
    ssp: Ssp = 1,
) -> Path:
    """Build the SSP of a car that starts at a `speed` [m/s], with libraries for `platforms`, by default all that there are.

    SSP 1.0 holds FMUs of FMI 2.0, SSP 2.0 those of FMI 3.0, whose platforms have other names.

    Raises BuildError, and OSError where the output cannot be written.
    """
    target = Path(output)
    if target.is_dir() or target.suffix.lower() != ".ssp":
        raise BuildError(f"output = {target}: must be a file that ends with .ssp")
    content, fmi = described(car, speed, ssp), INSIDE[ssp]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        units = {CAR: build_car_fmu(car, speed, folder / f"{CAR}.fmu", platforms, fmi=fmi)}
        for wheel, damper in zip(WHEELS, car.dampers, strict=True):
            units[wheel] = build_fmu(damper, folder / f"{wheel}.fmu", platforms=platforms, fmi=fmi)
        content |= {f"resources/{key}.fmu": file.read_bytes() for key, file in units.items()}
        archive.write(folder / target.name, content)
        with replacing(target) as part:
            part.write_bytes((folder / target.name).read_bytes())
    return target
