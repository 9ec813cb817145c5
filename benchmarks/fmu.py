"""Speed of the FMUs: native and Python kind beside a trivial FMU, in a C host and through fmpy; the quarter car."""

import subprocess
import tempfile
import zipfile
from pathlib import Path

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Slave

from benchmarks.timing import best
from twintube.core import effects, model
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import Damper, load
from twintube.demo.damper_fmu import DamperFmu
from twintube.demo.ride import RideCase, ride
from twintube.fmu import build_fmu
from twintube.fmu.platforms import PLATFORMS, Fmi, Kind
from twintube.native.compiler import FLAGS, compiled
from twintube.native.units import HEADERS
from twintube.vehicle.cars import load_car
from twintube.vehicle.ride import track

TRIVIAL = Path(__file__).parent / "trivial.c"
HOST = Path(__file__).parent / "step_host.c"
STEPS, PERIODS = 20000, 64
HOST_STEPS, MOST_STEPS = 500_000, 4_000_000  # the latter: a thousand instances of 4000 steps
VERSIONS: tuple[tuple[Fmi, str], ...] = ((2, fmpy.platform), (3, fmpy.platform_tuple))
STEP_LENGTHS, INSTANCES = (1e-4, 1e-3, 5e-3), 1000  # [s]


def trivial(native: Path, folder: Path) -> Path:
    """The native FMU with the library of the trivial one in its place, compiled the same way."""
    name = fmpy.read_model_description(str(native)).coSimulation.modelIdentifier
    ending, targets = PLATFORMS[fmpy.platform]
    library = folder / f"{name}.{ending}"
    compiled([TRIVIAL], targets[0], library, (*FLAGS, f"-I{HEADERS}"))
    target = folder / "trivial.fmu"
    with zipfile.ZipFile(native) as old, zipfile.ZipFile(target, "w") as new:
        for item in old.namelist():
            new.writestr(item, library.read_bytes() if item.startswith("binaries/") else old.read(item))
    return target


def moves() -> list[tuple[float, float]]:
    """Strokes [m] and the mean velocities [m/s] of the steps of 1 ms that follow; they end where they begin."""
    stroke = 0.03 * np.sin(np.arange(STEPS + 1) * (2 * np.pi * PERIODS / STEPS))
    return list(zip(stroke[:-1].tolist(), (np.diff(stroke) / 1e-3).tolist(), strict=True))


def by_fmpy(fmu: Path, folder: Path) -> float:
    """Time [s] of a set, step and get with fmpy's own functions."""
    description = fmpy.read_model_description(str(fmu))
    slave = FMU2Slave(
        guid=description.guid, unzipDirectory=fmpy.extract(str(fmu), str(folder / f"{fmu.stem}_unpacked")),
        modelIdentifier=description.coSimulation.modelIdentifier, instanceName="damper",
    )  # fmt: skip
    slave.instantiate()
    slave.setupExperiment(startTime=0.0)
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    time = 0.0

    def run() -> None:
        nonlocal time
        for z, v in moves():
            slave.setReal([0, 1], [z, v])
            slave.doStep(time, 1e-3)
            slave.getReal([2])
            time += 1e-3

    found = best(run) / STEPS
    slave.terminate()
    slave.freeInstance()
    return found


def by_handle(fmu: Path) -> float:
    """The same with the preallocated buffers of the vehicle demo."""
    with DamperFmu(fmu) as unit:
        return best(lambda: [unit.step(z, v, 1e-3) for z, v in moves()]) / STEPS


def in_c(folder: Path, damper: Damper) -> dict[str, float]:
    """The same in a program of C, at three steps, of FMI 2.0 and 3.0 and of the trivial library: time of the processor."""
    target = PLATFORMS[fmpy.platform][1][0]
    host, bare = folder / "host", folder / "bare.so"
    compiled([HOST], target, host, ("-std=gnu99", "-O2", "-ldl", f"-I{HEADERS}"))
    compiled([TRIVIAL], target, bare, (*FLAGS, f"-I{HEADERS}"))
    found: dict[str, float] = {}
    for fmi, platform in VERSIONS:
        unit = build_fmu(damper, folder / f"c{fmi}.fmu", platforms=(platform,), fmi=fmi)
        guid = fmpy.read_model_description(str(unit)).guid
        library = next((Path(fmpy.extract(str(unit), str(folder / f"c{fmi}"))) / "binaries" / platform).iterdir())

        def run(file: Path, step: float, steps: int, instances: int, *, guid: str = guid, fmi: Fmi = fmi) -> list[float]:
            """Time of a step [us] and memory of an instance [kB]."""
            command = [host, file, guid, fmi, step, steps, instances, 0, 1, 2]
            done = subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True)
            return [float(number) * 1e-3 for number in done.stdout.split()]

        for step in STEP_LENGTHS:
            both = [min(run(file, step, HOST_STEPS, 1)[0] for _ in range(3)) for file in (library, bare)]
            found |= {f"fmi{fmi}_{step * 1e3:g}_ms_us": both[0], f"fmi{fmi}_{step * 1e3:g}_ms_ratio": both[0] / both[1]}
        found[f"fmi{fmi}_of_{INSTANCES}_us"], found[f"fmi{fmi}_of_{INSTANCES}_kB_each"] = run(
            library, 1e-3, MOST_STEPS, INSTANCES
        )
    return found


def kernel(damper: Damper) -> float:
    """Time [s] of a step of the interpreted kernel."""
    p, d, s, f = damper.parameters, blank(Derived), blank(effects.State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    return best(lambda: [model.advance(p, d, s, f, z + v * 1e-3, v, v, 1e-3) for z, v in moves()]) / STEPS


def bench_fmu_step() -> dict[str, float]:
    """Set, step and get, SA8 at 60 % oil: `us_per_step` beside a trivial C FMU, both through fmpy; in C, see `in_c`."""
    damper = load("SA8").with_(oil_level=0.6, gas_preload=0)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        native = build_fmu(damper, folder / "native.fmu", platforms=(fmpy.platform,))
        python = build_fmu(damper, folder / "python.fmu", "python")
        bare = trivial(native, folder)
        inside = in_c(folder, damper)
        found = {
            "us_per_step": by_fmpy(native, folder),
            "reference_us_per_step": by_fmpy(bare, folder),
            "python_kind_us_per_step": by_fmpy(python, folder),
            "buffered_us_per_step": by_handle(native),
            "buffered_reference_us_per_step": by_handle(bare),
            "interpreted_kernel_us_per_step": kernel(damper),
        }
    figures = {key: value * 1e6 for key, value in found.items()}
    return figures | {"ratio": figures["us_per_step"] / figures["reference_us_per_step"]} | inside


def bench_quarter_car() -> dict[str, float]:
    """One case of the demo on one core: 60 s at 50 km/h, 60 % oil, steps of 1 ms, FMU in the loop."""
    damper = load("SA8")
    car = load_car().corner(damper)
    case = RideCase(50.0, 0.6, 0)
    on = track(50.0, 60.0)

    def seconds(kind: Kind, folder: str) -> float:
        fmu = build_fmu(damper, Path(folder) / f"{kind}.fmu", kind, (fmpy.platform,))
        return best(lambda: ride(fmu, car, case, on))

    with tempfile.TemporaryDirectory() as folder:
        native, python = seconds("native", folder), seconds("python", folder)
    return {
        "times_real_time": 60.0 / native,
        "seconds": native,
        "python_kind_seconds": python,
        "times_python_kind": python / native,
    }
