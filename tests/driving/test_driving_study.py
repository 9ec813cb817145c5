"""Random drives: the groups share nothing, and a study that was interrupted goes on."""

import json
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
from typer.testing import CliRunner

from twintube.cli import app
from twintube.dampers import load
from twintube.dampers.freed_gas import SCALAR
from twintube.driving import study
from twintube.driving.channels import CHANNELS
from twintube.driving.draws import GROUPS, HOP_SPEED, LEVELS, PER_CAR, SCALES, SEEDS, SIZES, draw, sized, tuned
from twintube.driving.signals import read
from twintube.errors import UserError
from twintube.studies import StudyError
from twintube.vehicle.cars import load_car

RUNNER = CliRunner()


def test_the_groups_share_no_car_no_road_and_no_tyre() -> None:
    drawn = [draw(number, 60.0, 1) for number in range(0, 42 * PER_CAR, 5)]
    several = [[each for each in drawn if each.group == group] for group in ("train", "test")]
    assert len(several[0]) == len(several[1]) and {each.group for each in drawn} == set(GROUPS)
    for of in (
        lambda d: d.car, lambda d: d.vehicle.car.name, lambda d: d.vehicle.seed, lambda d: d.vehicle.tyre,
        lambda d: d.conditions.road_seed, lambda d: d.conditions.scale,
    ):  # fmt: skip
        train, test = ({of(each) for each in some} for some in several)
        assert train and test and not train & test
    for ends in (SIZES, SCALES, SEEDS):
        assert ends["train"][1] <= ends["test"][0]
    # Tyres lie in other halves of their ranges: grip over the size of the car.
    grip = [
        [d.vehicle.car.whole["front_tyre"]["most_x"] / d.vehicle.car.whole["front_tyre"]["I_spin"] for d in some]
        for some in several
    ]
    assert max(grip[0]) < min(grip[1])


def test_a_car_is_the_same_in_all_its_drives_and_worn_in_some() -> None:
    drawn = [draw(number, 60.0, 1) for number in range(6 * PER_CAR)]
    for i in range(6):
        cars = [each.vehicle for each in drawn if each.car == i]
        assert len(cars) == PER_CAR and all(each == cars[0] for each in cars)
    worn = [each for each in drawn if min(each.wear.oil_level) < 1.0]
    assert worn and not any(each.reference for each in worn) and sum(each.reference for each in drawn) == 24
    assert all(LEVELS[0][0] <= min(each.wear.oil_level) <= LEVELS[1][1] for each in worn)
    assert draw(7, 60.0, 1) == drawn[7] and draw(7, 60.0, 2) != drawn[7]


def test_references_of_one_season_and_of_all_four_worn() -> None:
    drawn = [draw(number, 60.0, 1) for number in range(40 * PER_CAR)]
    spread = [np.ptp([each.conditions.ambient for each in drawn if each.car == car and each.reference]) for car in range(40)]
    # Weather alone has a standard deviation of 5 K, the year a range of 18 K.
    assert min(spread) < 8.0 and max(spread) > 15.0
    assert any(max(each.wear.oil_level) < 0.4 for each in drawn)
    assert all(0.0 <= each.conditions.temperature - each.conditions.ambient <= 25.0 for each in drawn)


def test_dampers_give_a_wheel_the_damping_that_is_asked_for() -> None:
    axle = load_car().axles["front"]
    p = tuned(load("SA7"), axle, 0.3).parameters
    speed = HOP_SPEED * axle["ratio"]
    constant = 0.5 * (np.interp(speed, p.v_re, p.F_re) + np.interp(speed, p.v_co, p.F_co)) / HOP_SPEED * axle["ratio"]
    assert constant / (2.0 * np.sqrt(axle["m_wheel"] * (axle["c_tyre"] + axle["c_body"]))) == pytest.approx(0.3)


def test_one_group_of_cars_alone_with_fewer_drives_of_each() -> None:
    plan = study.Plan(12, 1.0, group="other", per_car=6)
    drawn = [draw(plan.number(i), 60.0, 1) for i in range(12)]
    assert {each.group for each in drawn} == {"other"} and len({each.car for each in drawn}) == 2
    assert sum(each.reference for each in drawn) == 8


def test_a_larger_car_has_the_same_frequencies() -> None:
    car, large = load_car(), sized(load_car(), 1.3)
    for axle in ("front", "rear"):
        own, other = car.axles[axle], large.axles[axle]
        assert other["m_body"] == pytest.approx(1.3 * own["m_body"])
        for name in ("c_body", "c_tyre"):
            assert other[name] / other["m_wheel"] == pytest.approx(own[name] / own["m_wheel"])


def test_an_interrupted_study_goes_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    plan = study.Plan(4, 1.0, scalar=True)
    monkeypatch.setattr(study, "draw", lambda number, *rest: draw(number + 4, *rest))  # of these some are worn
    whole, part = tmp_path / "whole.parquet", tmp_path / "part.parquet"
    counts = study.run(plan, whole, processes=1)
    table = pq.read_table(whole).to_pylist()
    assert counts[0] == len(table) and {row["drive"] for row in table} == set(range(4, 8))
    twins = [row for row in table if row["model"] == SCALAR]
    assert twins and all(
        min(row["oil_level_fl"], row["oil_level_rl"], row["oil_level_rr"], row["oil_level_fr"]) < 1 for row in twins
    )

    done = 0

    def stopped(*arguments: object) -> list[dict[str, object]]:
        nonlocal done
        done += 1
        if done > 3:
            raise KeyboardInterrupt
        return rows(*arguments)

    rows = study.rows
    with monkeypatch.context() as patched, pytest.raises(KeyboardInterrupt):
        patched.setattr(study, "rows", stopped)
        study.run(plan, part, processes=1)
    journal = study.journal_of(part)
    assert not part.exists()
    with journal.open("a", encoding="utf-8") as file:
        file.write('[{"drive": 5, "gro')  # cut short by a power failure
    with pytest.raises(StudyError, match="of another study or version: remove it"):
        study.run(study.Plan(4, 2.0), part, processes=1)
    again = []
    monkeypatch.setattr(study, "rows", lambda *arguments: again.append(arguments) or rows(*arguments))
    study.run(plan, part, processes=1)
    assert len(again) == len(plan) - 3 and not journal.exists()
    assert part.read_bytes() == whole.read_bytes()


def test_the_signals_of_a_study_are_kept(tmp_path: Path) -> None:
    study.run(study.Plan(1, 1.0, signals=str(tmp_path / "signals")), tmp_path / "drives.parquet", processes=1)
    signals = read(tmp_path / "signals" / "drive_000000.parquet")
    assert set(signals.values) == set(CHANNELS) and len(signals) == 6000 and signals.labels["group"] == "train"
    row = pq.read_table(tmp_path / "drives.parquet").to_pylist()[0]
    assert row["road_seed"] == signals.labels["road_seed"]
    assert json.loads(pq.read_schema(tmp_path / "drives.parquet").metadata[b"twintube.study"])["minutes"] == 1.0


def test_a_worker_of_another_version_is_refused() -> None:
    with pytest.raises(StudyError, match="install the same version"):
        study.work(study.Plan(1, 1.0), 0, 1, "another")


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("study driving --drives 0", "drives = 0: must be from 1 to 100000"),
        ("study driving --minutes 0.5", "minutes = 0.5: must be from 1 to 60"),
        ("study driving --group fleet", "group fleet: must be one of train, test, other"),
        ("study driving --per-car 4", "per_car = 4: must be from 5 to 10"),
        ("study driving --seed -1", "seed = -1: must not be below 0"),
        ("study driving --processes 0", "processes = 0: must be at least 1"),
        ("study variants --drives 3", "--drives: only with the study driving"),
        ("drive --output a.csv", "the ending .csv: must be one of"),
        ("drive --output a.parquet --road-class F", "--road-class F: must be one of"),
        ("drive --output a.parquet --worn left", "--worn left: must be one of"),
        ("drive --output a.parquet --car bus", "bus"),
    ],
)
def test_bad_input_ends_with_one_line(line: str, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    run = RUNNER.invoke(app, line.split())
    assert run.exit_code == 2 and message in run.stderr and run.stderr.count("\n") == 1
    assert not list(tmp_path.iterdir())


def test_a_drive_is_written_with_its_truth(tmp_path: Path) -> None:
    path = tmp_path / "drive.parquet"
    options = "--minutes 0.2 --worn rear --oil-level 0.5 --gas-lost --speed 60 --road-class A --output"
    run = RUNNER.invoke(app, ["drive", *options.split(), str(path)])
    assert run.exit_code == 0, run.output
    signals = read(path)
    wheels = signals.labels["wheels"]
    assert [wheels[place]["oil_level"] for place in ("fl", "fr", "rl", "rr")] == [1.0, 1.0, 0.5, 0.5]
    assert [wheels[place]["gas_preload"] for place in ("fl", "fr", "rl", "rr")] == [1, 1, 0, 0]
    radius = signals.car["wheel_radius_m"]
    assert np.mean(signals.values["wheel_speed_rl_rad_per_s"]) * radius == pytest.approx(60 / 3.6, rel=0.1)


def test_the_example_of_a_drive_is_read(tmp_path: Path) -> None:
    run = RUNNER.invoke(app, ["example", str(tmp_path / "drive"), "--drive"])
    assert run.exit_code == 0, run.output
    good, worn = (read(tmp_path / "drive" / f"{name}.parquet") for name in ("good", "worn"))
    assert len(good) == len(worn) == 3000
    assert min(each["oil_level"] for each in good.labels["wheels"].values()) == 1.0
    assert worn.labels["wheels"]["rl"]["oil_level"] == 0.4


def test_a_number_below_zero_is_refused() -> None:
    with pytest.raises(UserError, match="must not be below 0"):
        draw(-1, 60.0, 1)


def test_a_worn_damper_drives_again_with_each_way_of_the_freed_gas_and_a_good_one_does_not() -> None:
    plan = study.Plan(10, 1.0, seed=3, freed_gas=True, scalar=True)
    several = len(plan.models)
    worn = next(n for n in range(10) if min(draw(n, 60.0, 3).wear.oil_level) < 1.0)
    rows = [study.rows(plan, several * worn + i)[0] for i in range(several)]
    assert [row["model"] for row in rows] == ["dissolves", "stays", "limited", "pushes_oil", "scalar factor"]
    assert len({row["road_seed"] for row in rows}) == 1
    assert len({row.get("speed_hop_rl") for row in rows}) > 1
    assert study.rows(plan, several * 0 + 1) == []  # a reference drive
