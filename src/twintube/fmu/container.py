"""Four dampers in a single container FMU, put together by the FMU Manipulation Toolbox."""

import logging
import shutil
import tempfile
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from xml.etree import ElementTree as ET

from twintube.dampers import Damper
from twintube.fmu import archive
from twintube.fmu.assemble import XML, BuildError, build_fmu, in_order, target_file, written
from twintube.fmu.binaries import complete
from twintube.fmu.description import damper_model, define_units, serialized
from twintube.fmu.platforms import known
from twintube.fmu.standards import STANDARDS
from twintube.fmu.table import Variable
from twintube.native.units import UNITS
from twintube.vehicle.full.car import WHEELS

NAME = "twintube_dampers"
STEP, SHORTEST, LONGEST = 1e-3, 1e-6, 0.1  # [s]
STATE = ("oil_level", "gas_preload")  # the parameters that the container shows
PLATFORMS = ("linux64", "win64", "darwin64")  # of the toolbox; Linux and Windows on x86-64 only


def build_container(
    dampers: Sequence[Damper],
    output: Path | str | None = None,
    step: float = STEP,
    platforms: Sequence[str] | None = None,
) -> Path:
    """Build the FMU of four dampers in the order of WHEELS; communication steps must be multiples of `step` [s].

    Its variables are those of the dampers under the names of the wheels, "front_left.stroke"; of the parameters only STATE.
    Raises BuildError, and OSError where the output cannot be written.
    """
    from fmu_manipulation_toolbox.container import FMUContainer

    target = target_file(output, NAME)
    if not SHORTEST <= step <= LONGEST:
        raise BuildError(f"communication step = {step:g} s: must be from {SHORTEST:g} to {LONGEST:g} s")
    if platforms is None:
        platforms = [name for name in complete(UNITS["damper", 2], STANDARDS[2]) if name in PLATFORMS]
    platforms = known(platforms)
    for platform in platforms:
        if platform not in PLATFORMS:
            raise BuildError(f"platform = {platform}: a container must be for one of {', '.join(PLATFORMS)}")
    logging.getLogger("fmu_manipulation_toolbox").setLevel(logging.ERROR)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        container = FMUContainer(NAME, folder)
        shown: dict[str, Variable] = {}
        for wheel, damper in zip(WHEELS, dampers, strict=True):
            build_fmu(damper, folder / f"{wheel}.fmu", platforms=platforms)
            for variable in damper_model(damper).variables:
                if variable.causality == "parameter" and variable.name not in STATE:
                    continue
                shown[f"{wheel}.{variable.name}"] = variable
                if variable.causality == "output":
                    container.add_output(f"{wheel}.fmu", variable.name, f"{wheel}.{variable.name}")
                else:
                    container.add_input(f"{wheel}.{variable.name}", f"{wheel}.fmu", variable.name)
        whole = folder / f"{NAME}_whole.fmu"
        container.make_fmu(whole, step_size=step)
        with zipfile.ZipFile(whole) as made:
            content = {entry: made.read(entry) for entry in made.namelist() if not entry.endswith("/")}
        content[XML] = completed(content[XML], shown)
        shutil.rmtree(folder / whole.stem, ignore_errors=True)
    written(target, in_order(content), 2)
    return target


def completed(text: bytes, shown: Mapping[str, Variable]) -> bytes:
    """The container's model description with what the toolbox leaves out: units, bounds, date, no direct feedthrough."""
    root = ET.fromstring(text)
    root.attrib |= {
        "author": "twintube", "license": "MIT", "generationDateAndTime": archive.build_date(),
        "description": "Four twin-tube shock absorbers after oil and gas loss: strokes and velocities in, forces out",
    }  # fmt: skip
    del root.attrib["copyright"]
    used = set()
    for element in root.findall("ModelVariables/ScalarVariable"):
        variable = shown.get(element.get("name", ""))
        kind = element.find("Real")
        if variable is None or kind is None:
            continue
        unit = variable.item.metadata["unit"]
        if unit != "1":
            kind.set("unit", unit)
            used.add(unit)
        for name, value in zip(("min", "max"), variable.bounds, strict=True):
            if value is not None:
                kind.set(name, repr(float(value)))
    for element in root.findall("ModelStructure/*/Unknown"):
        element.set("dependencies", "")
    place = [child.tag for child in root].index("CoSimulation") + 1
    root[place:place] = [ET.Element("UnitDefinitions"), ET.Element("TypeDefinitions")]
    define_units(root, used)
    return serialized(root)
