"""The FMUs in every importer that this computer has: its version, and the largest difference to the FMU's own reference.

Tools are found on the search path, VDMCheck by `VDMCHECK2` and `VDMCHECK3`: the paths of vdmcheck2.jar and vdmcheck3.jar.
"""

import csv
import os
import re
import shutil
import subprocess
import tempfile
import zipfile
from collections.abc import Callable, Sequence
from importlib.metadata import version
from pathlib import Path

import fmpy
import numpy as np

from benchmarks.fmu import VERSIONS
from twintube.arrays import Array
from twintube.dampers import load
from twintube.fmu import binaries, build_fmu
from twintube.fmu.car import build_car_fmu
from twintube.fmu.instance import Instance
from twintube.fmu.platforms import PLATFORMS
from twintube.fmu.related import FOLDER
from twintube.vehicle.cars import load_car
from twintube.vehicle.full.run import full_car

H, STEPS = 1e-3, 2000
CAR_INPUTS = ("steer", "speed", "front_left.force")
CAR_OUTPUTS = ("motion.x", "motion.yaw", "motion.roll", "front_left.load", "rear_right.stroke")
HOST = Path(__file__).parent.parent / "tests" / "fmu" / "foreign_host.c"
Runner = Callable[["Job", Path], Array]


class Job:
    """An FMU, its inputs as a file, and what it must give: (n, outputs) at the end of each step."""

    def __init__(self, fmu: Path, inputs: Path, outputs: Sequence[str]) -> None:
        self.fmu, self.inputs, self.outputs = fmu, inputs, outputs
        with inputs.open(encoding="utf-8", newline="") as file:
            self.names, *rows = csv.reader(file)
        self.given = np.array(rows, dtype=float)[:STEPS, 1:]
        self.expected = by_fmpy(self, fmu.parent)

    def difference(self, found: Array) -> float:
        """The largest difference of an output over its largest magnitude."""
        return float((np.abs(found - self.expected).max(axis=0) / np.abs(self.expected).max(axis=0)).max())


def by_fmpy(job: Job, _: Path) -> Array:
    """By fmpy's handle of the library."""
    rows = []
    with Instance(job.fmu, {}, (*job.names[1:], *job.outputs)) as unit:
        write, read = unit.buffer(*job.names[1:]), unit.buffer(*job.outputs)
        for row in job.given.tolist():
            write[2][:] = row
            unit.advance(write, H)
            rows.append(list(unit.read(read)))
    return np.array(rows)


def table(file: Path, outputs: Sequence[str]) -> Array:
    """The columns of these outputs in a tool's result, from the end of the first step on."""
    with file.open(encoding="utf-8", newline="") as lines:
        names, *rows = csv.reader(lines)
    columns = [names.index(name) for name in outputs]
    return np.array([[float(row[i]) for i in columns] for row in rows if row])[1 : STEPS + 1]


def by_program(*command: str) -> Runner:
    """By a program that reads and writes CSV; `{fmu}`, `{input}`, `{result}` and `{stop}` are put in."""

    def run(job: Job, folder: Path) -> Array:
        values = {"fmu": job.fmu, "input": job.inputs, "result": folder / "result.csv", "stop": STEPS * H}
        call([word.format(**values) for word in command], folder)
        return table(folder / "result.csv", job.outputs)

    return run


def call(command: Sequence[str], folder: Path, given: str | None = None) -> str:
    """What a program prints; raises RuntimeError with its last line where it fails."""
    done = subprocess.run(command, cwd=folder, input=given, capture_output=True, text=True, check=False, timeout=600)
    if done.returncode:
        raise RuntimeError("".join((done.stdout + done.stderr).strip().splitlines()[-1:]))
    return done.stdout


def by_ecos(job: Job, _: Path) -> Array:
    """By ecos."""
    import ecospy

    rows = []
    with ecospy.EcosSimulationStructure() as structure:
        structure.add_model("unit", str(job.fmu))
        with ecospy.EcosSimulation(H, structure=structure) as run:
            run.init()
            for row in job.given.tolist():
                for name, value in zip(job.names[1:], row, strict=True):
                    run.set_real(f"unit::{name}", value)
                run.step()
                rows.append([run.get_real(f"unit::{name}") for name in job.outputs])
            run.terminate()
    return np.array(rows)


def by_libcosim(job: Job, _: Path) -> Array:
    """By libcosim."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimManipulator import CosimManipulator
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    description = fmpy.read_model_description(str(job.fmu))
    if description.fmiVersion != "2.0":
        raise RuntimeError("not read")  # libcosimpy 0.0.6 ends the process
    references = {v.name: v.valueReference for v in description.modelVariables}
    execution = CosimExecution.from_step_size(step_size=round(H * 1e9))
    slave = execution.add_local_slave(CosimLocalSlave(fmu_path=str(job.fmu), instance_name="unit"))
    manipulator, observer = CosimManipulator.create_override(), CosimObserver.create_last_value()
    execution.add_manipulator(manipulator)
    execution.add_observer(observer)
    inputs, outputs = ([references[name] for name in names] for names in (job.names[1:], job.outputs))
    rows = []
    for row in job.given.tolist():
        if not (manipulator.slave_real_values(slave, inputs, row) and execution.step()):
            raise RuntimeError("libcosim ended the run")
        rows.append(observer.last_real_values(slave, outputs))
    return np.array(rows)


def by_host(platform: str, start: Sequence[str], *flags: str, compiler: str = "") -> Runner:
    """By a small program of another platform, which runs the damper's library of FMI 2.0."""

    def run(job: Job, folder: Path) -> Array:
        description = fmpy.read_model_description(str(job.fmu))
        if description.fmiVersion != "2.0" or "stroke" not in job.names:
            raise RuntimeError("-")
        fmu, host = build_fmu(load("SA8"), folder / "other.fmu", platforms=(platform,)), folder / "host.exe"
        if compiler:
            call([compiler, "-O1", f"-I{binaries.headers()}", str(HOST), "-o", str(host)], folder)
        else:
            binaries.compiled(HOST, PLATFORMS[platform][1][0], host, ("-O1", *flags))
        with zipfile.ZipFile(fmu) as archive:
            library = archive.extract(f"binaries/{platform}/twintube_SA8.{PLATFORMS[platform][0]}", folder)
        guid = fmpy.read_model_description(str(fmu)).guid
        references = {v.name: v.valueReference for v in description.modelVariables}
        values = (str(references["oil_level"]), "1", str(references["gas_preload"]), "1")
        lines = "".join(f"{z!r} {v!r} {H!r}\n" for z, v in job.given.tolist())
        found = call([*start, str(host), library, guid, *values], folder, lines)
        return np.column_stack([np.array(found.split(), dtype=float), job.expected[:, 1]])

    return run


def checked(number: int) -> Runner:
    """By VDMCheck, which reads the model description; no difference where it finds no error."""

    def run(job: Job, folder: Path) -> Array:
        if not fmpy.read_model_description(str(job.fmu)).fmiVersion.startswith(str(number)):
            raise RuntimeError("-")
        call(["java", "-cp", os.environ[f"VDMCHECK{number}"], "VDMCheckPlus", str(job.fmu)], folder)
        return job.expected

    return run


def tools() -> dict[str, tuple[str, Runner]]:
    """Version and way of each importer that is here."""
    found: dict[str, tuple[str, Runner]] = {"fmpy": (version("fmpy"), by_fmpy)}
    for module, name, runner in (("ecospy", "ecos", by_ecos), ("libcosimpy", "libcosim", by_libcosim)):
        found[name] = (version(module), runner)
    programs = {
        "fmusim": ("--input-file", "{input}", "--output-file", "{result}", "--stop-time", "{stop}",
                   "--output-interval", "1e-3", "{fmu}"),
        "fmuCheck.linux64": ("-k", "cs", "-h", "1e-3", "-s", "{stop}", "-n", str(STEPS), "-i", "{input}", "-o", "{result}",
                             "{fmu}"),
        "fmi4ctest": ("-m", "cs", "-h", "1e-3", "-s", "{stop}", "-i", "{input}", "-o", "{result}", "{fmu}"),
    }  # fmt: skip
    for program, arguments in programs.items():
        if shutil.which(program):
            found[program] = (told(program, "--version"), by_program(program, *arguments))
    if shutil.which("wine"):
        found["Windows library, wine"] = (told("wine", "--version"), by_host("win64", ["wine"]))
    if shutil.which("qemu-aarch64"):
        start = ["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"]
        found["ARM library, qemu"] = (told("qemu-aarch64", "--version"), by_host("aarch64-linux", start, "-ldl"))
    if shutil.which("musl-gcc"):
        found["small program, musl"] = ("", by_host("linux64", [], compiler="musl-gcc"))
    for number in (2, 3):
        if f"VDMCHECK{number}" in os.environ:
            found[f"VDMCheck {number}"] = ("", checked(number))
    return found


def as_table(found: dict[str, dict[str, str]]) -> str:
    """The figures in Markdown, a row for each importer."""
    columns = list(next(iter(found.values())))
    head = f"| importer | {' | '.join(columns)} |\n|---|{'---|' * len(columns)}\n"
    return head + "".join(f"| {tool} | {' | '.join(cells.values())} |\n" for tool, cells in found.items())


def told(program: str, option: str) -> str:
    """The first number with a point that a program says of itself."""
    said = subprocess.run([program, option], capture_output=True, text=True, check=False)
    number = re.search(r"\d+(\.\w+)+", said.stdout + said.stderr)
    return number.group() if number else ""


def jobs(folder: Path) -> dict[str, Job]:
    """Damper and car of FMI 2.0 and 3.0."""
    made = {}
    car = full_car(load_car(), [load("SA7")] * 2 + [load("SA8")] * 2)
    time = np.arange(STEPS + 1) * H
    rows = np.column_stack([time, 0.02 * np.sin(3 * time), np.full(len(time), 15.0), 500 * np.sin(20 * time)])
    drive = folder / "car.csv"
    lines = [",".join(f'"{name}"' for name in ("time", *CAR_INPUTS)), *(",".join(map(repr, row)) for row in rows.tolist())]
    drive.write_text("\n".join(lines) + "\n", encoding="utf-8")
    for fmi, platform in VERSIONS:
        damper = build_fmu(load("SA8"), folder, platforms=(platform,), fmi=fmi)
        with zipfile.ZipFile(damper) as archive:
            archive.extract(f"{FOLDER}/input.csv", folder)
        made[f"damper, FMI {fmi}"] = Job(damper, folder / FOLDER / "input.csv", ("force", "k_degr"))
        made[f"car, FMI {fmi}"] = Job(build_car_fmu(car, 15.0, folder, (platform,), fmi=fmi), drive, CAR_OUTPUTS)
    return made


def bench_importers() -> dict[str, dict[str, str]]:
    """For each importer the largest relative difference of an output to fmpy's, or why it did not run."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        todo, found = jobs(folder), {}
        for tool, (number, runner) in tools().items():
            cells = {}
            for what, job in todo.items():
                work = Path(tempfile.mkdtemp(dir=folder))
                try:
                    cells[what] = f"{job.difference(runner(job, work)):.1g}"
                except Exception as error:  # whatever a tool raises is its answer
                    cells[what] = " ".join(str(error).split())[:80]
            found[f"{tool} {number}".strip()] = cells
    return found
