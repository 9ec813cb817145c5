"""Runs of an FMU or SSP in importers: each takes a job and a folder, and gives the outputs at the end of each step."""

import csv
import re
import subprocess
import zipfile
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import fmpy
import numpy as np

from benchmarks.fmu import VERSIONS
from benchmarks.importer_jobs import STEPS, H, Job
from twintube.common.arrays import Array
from twintube.dampers import load
from twintube.fmu import build_fmu
from twintube.fmu.platforms import PLATFORMS_3
from twintube.fmu.ssp import CAR
from twintube.native.compiler import compiled
from twintube.native.units import HEADERS

HOST = Path(__file__).parent.parent / "tests" / "fmu" / "foreign_host.c"
NO_ERRORS = "no errors"
Runner = Callable[[Job, Path], Array | str]


def apart(runner: Runner, job: Job, folder: Path) -> Array | str:
    """What a runner gives in a process of its own, since tools may end theirs. Raises RuntimeError with what it said."""
    context = get_context("fork")
    receiver, sender = context.Pipe(duplex=False)

    def run() -> None:
        try:
            sender.send(runner(job, folder))
        except Exception as error:  # whatever a tool raises is its answer
            sender.send(RuntimeError(str(error)))

    process = context.Process(target=run)
    process.start()
    sender.close()
    try:
        found: Array | str | RuntimeError = receiver.recv()
    except EOFError:
        found = RuntimeError("it ends the process")
    process.join()
    if isinstance(found, RuntimeError):
        raise found
    return found


def by_ecos(job: Job, _: Path) -> Array:
    """By ecos."""
    import ecospy

    rows = []
    with ExitStack() as opened:
        if job.system:
            run = opened.enter_context(ecospy.EcosSimulation(step_size=H, ssp_path=str(job.file)))
            run.init(parameter_set="passat_b8")
        else:
            structure = opened.enter_context(ecospy.EcosSimulationStructure())
            structure.add_model(CAR, str(job.file))
            run = opened.enter_context(ecospy.EcosSimulation(step_size=H, structure=structure))
            run.init()
        for row in job.given.tolist():
            for name, value in zip(job.names[1:], row, strict=True):
                run.set_real(f"{CAR}::{name}", value)
            run.step()
            rows.append([run.get_real(f"{CAR}::{name}") for name in job.outputs])
        run.terminate()
    return np.array(rows)


def by_libcosim(job: Job, _: Path) -> Array:
    """By libcosim."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimManipulator import CosimManipulator
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    length = round(H * 1e9)
    if job.system:
        execution = CosimExecution.from_ssp_file(ssp_path=str(job.unit.parents[1]), step_size=length)
        (slave,) = (info.index for info in execution.slave_infos() if info.name == CAR.encode())
    else:
        execution = CosimExecution.from_step_size(step_size=length)
        slave = execution.add_local_slave(CosimLocalSlave(fmu_path=str(job.file), instance_name=CAR))
    manipulator, observer = CosimManipulator.create_override(), CosimObserver.create_last_value()
    execution.add_manipulator(manipulator)
    execution.add_observer(observer)
    inputs, outputs = job.referred()
    rows = []
    for row in job.given.tolist():
        if not (manipulator.slave_real_values(slave, inputs, row) and execution.step()):
            raise RuntimeError("it ended the run")
        rows.append(observer.last_real_values(slave, outputs))
    return np.array(rows)


def by_fmi4c(job: Job, _: Path) -> Array:
    """By fmi4c's Python module. Its program fmi4ctest writes six decimals, and no file for FMI 2.0."""
    import fmi4c

    unit: Any = fmi4c.fmi4c()
    unit.fmi4c_loadFmu(str(job.file), "unit")
    if job.new:
        at = unit.fmi3_instantiateCoSimulation(False, False, False, False, [], 0)
        status = [unit.fmi3_enterInitializationMode(at, False, 0.0, 0.0, False, 0.0), unit.fmi3_exitInitializationMode(at)]
    else:
        at = unit.fmi2_instantiate(1, False, False)  # 1: co-simulation
        status = [unit.fmi2_setupExperiment(at, False, 0.0, 0.0, False, 0.0), unit.fmi2_enterInitializationMode(at),
                  unit.fmi2_exitInitializationMode(at)]  # fmt: skip
    (inputs, outputs), rows = job.referred(), []
    n, m = len(inputs), len(outputs)
    for i, row in enumerate(job.given.tolist()):
        if job.new:
            status += [unit.fmi3_setFloat64(at, inputs, n, row, n), unit.fmi3_doStep(at, i * H, H, True)[0]]
            read, values = unit.fmi3_getFloat64(at, outputs, m, m)
        else:
            status += [unit.fmi2_setReal(at, inputs, n, row), unit.fmi2_doStep(at, i * H, H, True)]
            read, values = unit.fmi2_getReal(at, outputs, m)
        if any((*status, read)):
            raise RuntimeError(f"status {status}, {read}")
        status = []
        rows.append(values)
    return np.array(rows)


def by_program(command: str) -> Runner:
    """By a program that reads and writes CSV; `{fmu}`, `{input}`, `{result}` and `{stop}` are put in."""

    def run(job: Job, folder: Path) -> Array:
        result = folder / "result.csv"
        values = {"fmu": job.file, "input": job.inputs, "result": result, "stop": STEPS * H}
        call([word.format(**values) for word in command.split()], folder)
        with result.open(encoding="utf-8", newline="") as lines:
            names, *rows = csv.reader(lines)
        columns = [names.index(name) for name in job.outputs]
        return np.array([[float(row[i]) for i in columns] for row in rows if row])[1 : STEPS + 1]  # without the start

    return run


def by_host(platforms: tuple[str, str], start: Sequence[str], *flags: str, compiler: str = "") -> Runner:
    """By a small program of another platform, as FMI 2.0 and 3.0 call it, which runs the damper's library."""

    def run(job: Job, folder: Path) -> Array:
        platform, (fmi, _) = platforms[job.new], VERSIONS[job.new]
        ending, targets = PLATFORMS_3[platforms[1]]
        fmu, host = build_fmu(load("SA8"), folder / "other.fmu", platforms=(platform,), fmi=fmi), folder / "host.exe"
        if compiler:
            call([compiler, "-O1", f"-I{HEADERS}", str(HOST), "-o", str(host)], folder)
        else:
            compiled([HOST], targets[0], host, ("-O1", f"-I{HEADERS}", *flags))
        with zipfile.ZipFile(fmu) as archive:
            library = archive.extract(f"binaries/{platform}/twintube_SA8.{ending}", folder)
        guid = fmpy.read_model_description(str(fmu)).guid
        values = (str(job.references["oil_level"]), "1", str(job.references["gas_preload"]), "1")
        lines = "".join(f"{z!r} {v!r} {H!r}\n" for z, v in job.given.tolist())
        found = call([*start, str(host), library, guid, str(fmi), *values], folder, lines)
        return np.array(found.split(), dtype=float)[:, None]

    return run


def checked(jar: str) -> Runner:
    """By VDMCheck, which reads the model description and runs nothing."""

    def run(job: Job, folder: Path) -> str:
        call(["java", "-cp", jar, "VDMCheckPlus", str(job.file)], folder)
        return NO_ERRORS

    return run


def call(command: Sequence[str], folder: Path, given: str | None = None) -> str:
    """What a program prints; raises RuntimeError with its last line where it fails."""
    done = subprocess.run(command, cwd=folder, input=given, capture_output=True, text=True, check=False, timeout=600)
    if done.returncode:
        raise RuntimeError("".join((done.stdout + done.stderr).strip().splitlines()[-1:]))
    return done.stdout


def told(program: str, option: str = "--version") -> str:
    """The first number with a point that a program says of itself; empty where it says none."""
    said = subprocess.run([program, option], capture_output=True, text=True, check=False)
    number = re.search(r"\d+(\.\w+)+", said.stdout + said.stderr)
    return number.group() if number else ""
