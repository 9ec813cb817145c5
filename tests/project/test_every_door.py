"""One damper through every door: the same force and work wherever it comes from, by what its parameter file says.

The explorer's door is in tests/explorer/test_four_doors.py, the container's in tests/vehicle/test_car_fmus.py.
"""

import json
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from typer.testing import CliRunner

from twintube import build_fmu, load, simulate
from twintube.cli import app
from twintube.common.arrays import Array
from twintube.dampers import Damper, to_toml
from twintube.dampers.freed_gas import DEFAULT, with_freed_gas
from twintube.data import Record, load_dataset
from twintube.demo.damper_fmu import DamperFmu
from twintube.diagnosis.problem import Problem
from twintube.diagnosis.put_right import put_right
from twintube.engine.simulation import Simulation
from twintube.fitting.oscillations import harmonic
from twintube.fitting.prediction import calm, driven, predicted
from twintube.vehicle.cars import load_car
from twintube.vehicle.full.catalogue import Case
from twintube.vehicle.full.run import full_car
from twintube.vehicle.full.study import dampers_of, run_of
from twintube.vehicle.ride import ride, track

LEVEL = 0.6
STATE = ["--oil-level", str(LEVEL), "--gas-lost"]
VELOCITY = 1.048  # [m/s] above the speed of cavitation, where freed gas decides
DIGITS = 1e-4  # of the largest force, root mean square: a file holds nine digits, by which a step of the force falls a sample later


@pytest.fixture(scope="module", params=[DEFAULT, "stays"])
def mine(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A parameter file that says what freed gas does."""
    file = tmp_path_factory.mktemp("damper") / "mine.toml"
    file.write_text(to_toml(with_freed_gas(load("SA8"), request.param)))
    return file


@pytest.fixture(scope="module")
def worn(mine: Path) -> Damper:
    return load(mine).with_(oil_level=LEVEL, gas_preload=0)


@pytest.fixture(scope="module")
def block(mine: Path) -> Path:
    """What `twintube simulate` writes of a block, as a record of a bench would be: time, stroke, velocity, force."""
    file = mine.parent / "all.csv"
    run("simulate", str(mine), *STATE, "--velocity", str(VELOCITY), "--output", str(file))
    table, names = columns(file), ["time [s]", "stroke [m]", "velocity [m/s]", "force [N]"]
    record = mine.parent / "block.csv"
    rows = np.column_stack([table[name] for name in names])
    np.savetxt(record, rows, "%.9g", ",", header=",".join(names), comments="")
    return record


@pytest.fixture(scope="module")
def record(block: Path) -> Record:
    """The record of a dataset of its own."""
    folder = block.parent / "dataset"
    run("new-dataset", str(folder), "--from", str(block), str(block.parent / "mine.toml"), *STATE)
    (only,) = load_dataset(folder).records
    return only


def run(*arguments: str) -> str:
    done = CliRunner().invoke(app, list(arguments))
    assert done.exit_code == 0, done.output
    return done.output


def columns(file: Path) -> dict[str, Array]:
    with file.open(encoding="utf-8") as lines:
        names = next(lines).strip().split(",")
    return dict(zip(names, np.loadtxt(file, delimiter=",", skiprows=1, unpack=True), strict=True))


def force_and_work(file: Path) -> tuple[Array, Array]:
    table = columns(file)
    return table["force [N]"], table["work [J]"]


def apart(force: Array, other: Array) -> float:
    """How far two forces (n,) are apart, of the largest [1]."""
    return float(np.sqrt(np.mean((force - other) ** 2)) / np.abs(other).max())


def assert_same(found: tuple[Array, Array], expected: Simulation) -> None:
    assert apart(found[0], expected.force) < DIGITS
    assert found[1][-1] == pytest.approx(expected.work[-1], rel=DIGITS)


@pytest.fixture(scope="module")
def expected(worn: Damper, block: Path, record: Record) -> Simulation:
    return simulate(worn, record.stroke, record.velocity, record.time)


def test_simulate_a_block_and_a_record_with_and_without_a_dataset(
    mine: Path, block: Path, record: Record, expected: Simulation, tmp_path: Path
) -> None:
    assert_same(force_and_work(block.parent / "all.csv"), expected)
    said = []
    for source, damper in ((block, [str(mine), *STATE]), (block.parent / "dataset" / "block.csv", [])):
        out = tmp_path / "out.csv"
        said.append(run("simulate", *damper, "--record", str(source), "--output", str(out)).splitlines()[-2:])
        assert_same(force_and_work(out), expected)
    assert said[0] == said[1] and "measured against simulated: 0.0 N RMSE" in said[0][0]


def other_way(damper: Damper) -> Damper:
    """The damper with the other of the two ways of the freed gas."""
    return damper.with_(redissolution_rate=0.0 if damper.parameters.redissolution_rate else 0.085)


def test_the_other_way_of_the_gas_is_told_by_far_more(worn: Damper, record: Record, expected: Simulation) -> None:
    other = simulate(other_way(worn), record.stroke, record.velocity, record.time)
    assert apart(other.force, expected.force) > 100 * DIGITS
    assert abs(other.work[-1] / expected.work[-1] - 1) > 0.05


def test_identification_and_diagnosis_have_the_force_of_the_record(worn: Damper, record: Record, block: Path) -> None:
    dataset = load_dataset(block.parent / "dataset")
    assert dataset.damper.parameters == load(block.parent / "mine.toml").parameters
    assert apart(driven(dataset.damper, calm(record)).force, record.force) < DIGITS
    h = harmonic(record)
    span = slice(int(h.marks[0]), int(h.marks[-1]) + 1)
    assert apart(predicted(dataset.damper, h, 0.0)[span], h.force[span]) < DIGITS
    judged = put_right(dataset, None, lambda text: None).problem
    assert judged.given.parameters == dataset.damper.parameters
    # Means over intervals are not those of the finer record: the same way of the gas is nearer by far, not equal.
    other = Problem(other_way(judged.given), judged.records, usual=judged.usual)
    assert apart(judged.forces({}), judged.measured) < 0.2 * apart(other.forces({}), judged.measured)


@pytest.mark.parametrize(("kind", "fmi"), [("native", 2), ("native", 3), ("python", 2)])
def test_fmus(kind: Any, fmi: Any, tmp_path: Path) -> None:
    """An FMU moves at one velocity through each step: so does a record with each time twice."""
    mine = tmp_path / "mine.toml"
    mine.write_text(to_toml(with_freed_gas(load("SA8"), "stays")))
    worn = load(mine).with_(oil_level=LEVEL, gas_preload=0)
    options = ["--kind", kind, "--fmi", str(fmi), *(["--platform", fmpy.platform] if kind == "native" else [])]
    run("fmu", str(mine), *STATE, *options, "--output", str(tmp_path / "mine.fmu"))
    t = np.arange(4000) * 1e-3
    omega = VELOCITY / 0.045
    z = 0.045 * np.sin(omega * t)
    v = np.diff(z) / np.diff(t)
    twice = simulate(worn, np.repeat(z, 2)[1:-1], np.repeat(v, 2), np.repeat(t, 2)[1:-1])
    rows = []
    with DamperFmu(tmp_path / "mine.fmu") as fmu:
        for stroke, speed, dt in zip(z[:-1].tolist(), v.tolist(), np.diff(t).tolist(), strict=True):
            force = fmu.step(stroke, speed, dt)
            rows.append((force, fmu.outputs()["work"]))
    found = np.array(rows)
    assert np.abs(found[:, 0] - twice.force[1::2]).max() <= 1e-6 * np.abs(twice.force).max()
    assert found[-1, 1] == pytest.approx(twice.work[-1], rel=1e-5)  # an FMU begins at rest, a record at its first velocity
    evenly = simulate(worn, z, VELOCITY * np.cos(omega * t), t)  # other velocities between the samples
    assert found[-1, 1] == pytest.approx(evenly.work[-1], rel=0.01)


def test_a_ride_and_a_wheel_of_the_car(mine: Path, worn: Damper, tmp_path: Path) -> None:
    figures = tmp_path / "ride.json"
    run("ride", str(mine), *STATE, "--seconds", "20", "--json", str(figures))
    done = ride(worn, load_car().corner(worn), track(50.0, 20.0))
    assert json.loads(figures.read_text())["damping_work_J"] == pytest.approx(float(done.work[-1]), rel=1e-9)
    case = Case("ride", 50.0, "D", 1, LEVEL, gas_preload=0)
    four = dampers_of(load("SA7"), load(mine), "rear_left", case)
    assert four[2] == worn and four[3] == load(mine).with_(oil_level=1.0, gas_preload=1)
    wheel = run_of(full_car(load_car(), four), case)
    # The car's own steps are finer than its samples: the same way of the gas is nearer by far, not equal.
    motion = wheel.stroke[:, 2], wheel.velocity[:, 2], wheel.time
    work, alone, other = (
        wheel.damper_work[-1, 2],
        simulate(worn, *motion).work[-1],
        simulate(other_way(worn), *motion).work[-1],
    )
    assert abs(alone - work) < 0.2 * abs(other - work)


def test_python_builds_what_the_command_builds(worn: Damper, mine: Path, tmp_path: Path) -> None:
    run("fmu", str(mine), *STATE, "--kind", "python", "--output", str(tmp_path / "a.fmu"))
    build_fmu(worn, tmp_path / "b.fmu", "python")
    starts = [
        {v.name: v.start for v in fmpy.read_model_description(str(tmp_path / name)).modelVariables}
        for name in ("a.fmu", "b.fmu")
    ]
    assert starts[0] == starts[1]
