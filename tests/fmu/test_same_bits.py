"""FMI 2.0, FMI 3.0, the Python kind and `simulate` compute the same bits, also where states are set back and forth."""

import shutil
import sys
import zipfile
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy.build import build_platform_binary
from fmpy.util import create_zip_archive
from masters import Unit, wheels_of

from twintube.common.arrays import Array
from twintube.dampers import load
from twintube.demo.damper_fmu import VOLUMES, DamperFmu
from twintube.engine.simulate import simulate
from twintube.fmu import build_fmu
from twintube.fmu.car import build_car_fmu
from twintube.vehicle import drive as vehicle_drive
from twintube.vehicle.cars import load_car
from twintube.vehicle.full.run import full_car
from twintube.vehicle.ride import track

HERE = (fmpy.platform_tuple,)
H = 1e-3
WORN = {"oil_level": 0.6, "gas_preload": 0}


class Driven:
    """A quarter car with a worn damper on a class D road: its strokes and velocities, as an FMU is given them."""

    def __init__(self, seconds: float) -> None:
        route = track(50.0, seconds)
        damper = load("SA8").with_(**WORN)
        self.velocity = vehicle_drive.drive(
            damper, load_car().corner(load("SA8")), route.heights, H, rates=route.rates
        ).velocity
        self.stroke = np.zeros(len(self.velocity))
        for i, v in enumerate(self.velocity[:-1].tolist()):
            self.stroke[i + 1] = self.stroke[i] + v * H
        self.simulated = self.by_simulate()

    def by_simulate(self) -> Array:
        """Force, degradation and volumes: at each communication point the velocity changes in no time."""
        z, v = np.column_stack([self.stroke, self.stroke + self.velocity * H]).ravel(), self.velocity.repeat(2)
        ends = np.cumsum(np.full(len(self.velocity), H))
        run = simulate(load("SA8").with_(**WORN), z, v, np.column_stack([np.append(0.0, ends[:-1]), ends]).ravel())
        names = ("force", "k_degr", *(name.replace(".", "_") for name in VOLUMES))
        return np.column_stack([getattr(run, name) for name in names])[1::2]

    def by(self, fmu: Path) -> tuple[Array, list[float]]:
        """The same by an FMU, and the work; its state is set back every 100 steps after a wrong way, once as bytes."""
        rows, works = [], []
        with DamperFmu(fmu, **WORN) as damper:
            for i, (z, v) in enumerate(zip(self.stroke.tolist(), self.velocity.tolist(), strict=True)):
                if i % 100 == 99:
                    state, time = damper.fmu.getFMUState(), damper.now.value
                    if i % 200 == 199:
                        state = carried(damper, state)
                    for _ in range(20):
                        damper.step(0.5 * z, -0.5 * v, H)
                    damper.fmu.setFMUState(state)
                    damper.fmu.freeFMUState(state)
                    damper.now.value = time
                force, outputs = damper.step(z, v, H), damper.outputs()
                rows.append([force, outputs["k_degr"], *damper.volumes()])
                works.append(outputs["work"])
        return np.array(rows), works


def carried(damper: DamperFmu, state: Any) -> Any:
    """A state that went through bytes."""
    unit = damper.fmu
    kept = unit.serializeFMUState(state) if damper.new else unit.serializeFMUstate(state)
    unit.freeFMUState(state)
    return unit.deserializeFMUState(kept) if damper.new else unit.deSerializeFMUstate(kept)


def test_all_kinds_and_simulate_compute_the_same_bits_over_a_class_d_drive(
    sa8_fmi3: Path, sa8_native: Path, tmp_path: Path
) -> None:
    driven = Driven(2.0)
    assert np.ptp(driven.stroke) > 0.05
    rows, works = driven.by(sa8_fmi3)
    for fmu in (sa8_native, build_fmu(load("SA8"), tmp_path / "python.fmu", "python")):
        others, their_works = driven.by(fmu)
        assert others.tobytes() == rows.tobytes()
        assert their_works == works
    assert rows.tobytes() == driven.simulated.tobytes()
    assert works[-1] > 50


def test_with_the_velocity_going_evenly_the_work_is_that_of_simulate_too(sa8_native: Path) -> None:
    """FMI 2.0 has input derivatives for it; FMI 3.0 has none."""
    driven = Driven(1.0)
    rates = (np.diff(driven.velocity) / H).tolist()
    z, v, time = [0.0], driven.velocity[:1].tolist(), [0.0]
    for rate in rates:
        z.append(z[-1] + (v[-1] + 0.5 * rate * H) * H)
        v.append(v[-1] + rate * H)
        time.append(time[-1] + H)
    run = simulate(load("SA8").with_(**WORN), z, v, time)
    with DamperFmu(sa8_native, **WORN) as damper:
        reference = [damper.variables["velocity"].valueReference]
        for i, rate in enumerate(rates):
            damper.fmu.setRealInputDerivatives(reference, [1], [rate])
            assert damper.step(z[i], v[i], H) == run.force[i + 1]
            assert damper.outputs()["work"] == run.work[i + 1]


def test_the_car_of_fmi_3_drives_as_that_of_fmi_2(tmp_path: Path) -> None:
    car = full_car(load_car(), [load("SA7")] * 2 + [load("SA8")] * 2)
    random = np.random.default_rng(3)
    forces, rates = 300.0 * random.standard_normal((300, 4)), 0.05 * random.standard_normal((300, 4))
    names = ("motion.x", "motion.yaw", *wheels_of("stroke"), *wheels_of("load"))
    runs = []
    for fmi, platform in ((2, fmpy.platform), (3, fmpy.platform_tuple)):
        rows = []
        with Unit(build_car_fmu(car, 15.0, tmp_path, (platform,), fmi=fmi)) as unit:
            unit.set({"steer": 0.02, "brake_pressure": 1e6})
            for n, (force, rate) in enumerate(zip(forces.tolist(), rates.tolist(), strict=True)):
                unit.set(
                    dict(zip(wheels_of("force"), force, strict=True)) | dict(zip(wheels_of("road_rate"), rate, strict=True))
                )
                unit.step(n * H, H)
                rows.append(unit.get(*names))
        runs.append(rows)
    assert runs[0] == runs[1]
    assert len(list(tmp_path.glob("*.fmu"))) == 2


@pytest.mark.skipif(shutil.which("cmake") is None, reason="cmake is absent: fmpy compiles with it")
@pytest.mark.skipif(sys.platform != "win32" and shutil.which("cc") is None, reason="a C compiler is absent: no cc")
def test_fmpy_compiles_the_sources(sa8_fmi3: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "fmu"
    with zipfile.ZipFile(sa8_fmi3) as archive:
        archive.extractall(folder)
    shutil.rmtree(folder / "binaries")
    monkeypatch.setenv("CFLAGS", "-ffp-contract=off")  # some compilers fuse multiplication and addition
    build_platform_binary(folder)
    create_zip_archive(tmp_path / "compiled.fmu", folder)
    driven = Driven(0.5)
    (rows, works), (others, their_works) = driven.by(sa8_fmi3), driven.by(tmp_path / "compiled.fmu")
    assert rows.tobytes() == others.tobytes() and works == their_works
