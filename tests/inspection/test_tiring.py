"""The plate that watches the damper tire: what tires it, what does not, what a rest brings back, and what it cannot judge."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from twintube.cli import app
from twintube.dampers import Damper, load
from twintube.dampers.freed_gas import DEFAULT, with_freed_gas
from twintube.dampers.variants import scalar_factor
from twintube.engine.simulate import InputError
from twintube.inspection import USUAL, Plate, Setting, conditions, inspected
from twintube.inspection.benches import DT
from twintube.inspection.rough_road import road_growth
from twintube.inspection.scatter import BENCHES, HEAT, samples
from twintube.inspection.tiring import (
    COAST,
    COLLAPSED,
    CYCLES,
    ENOUGH,
    FREQUENCY,
    HIGHEST,
    HOLD,
    LIMIT,
    PLATES,
    RUN_UP,
    force_left,
    not_judged,
    returned,
    runs,
    shake,
    shaker,
    twice,
)  # fmt: skip
from twintube.report.inspection.summary import Inspection, sentence
from twintube.report.inspection.tiring import remarks
from twintube.vehicle.cars import load_car
from twintube.vehicle.ride import track

RUNNER = CliRunner()


def growth(damper: Damper, plates: tuple[Plate, ...] = PLATES, **changes: float) -> float:
    return max(run.growth for run in runs(damper, load_car().corner(damper, **changes), plates, DT))


def worn(name: str, oil_level: float, freed_gas: str = DEFAULT) -> Damper:
    return with_freed_gas(load(name).with_(oil_level=oil_level, gas_preload=0), freed_gas)


@pytest.mark.parametrize("factor", [1.0, 0.75, 0.5])
@pytest.mark.parametrize("name", ["SA8", "SA7"])
def test_a_weak_curve_does_not_tire(name, factor):
    assert growth(load(name).with_(**scalar_factor(factor))) == pytest.approx(1.0, abs=0.021)


@pytest.mark.parametrize("share", [0.8, 1.2])
def test_a_soft_or_stiff_tyre_does_not_tire(share):
    damper = load("SA8")
    assert growth(damper, PLATES[:1], c_tyre=share * load_car().corner(damper).c_tyre) == pytest.approx(1.0, abs=0.012)


@pytest.mark.parametrize("freed_gas", ["dissolves", "dissolves_fast", "stays", "half_pushes_oil", "pushes_oil"])
def test_ten_percent_of_the_oil_tire_sa8(freed_gas):
    assert growth(worn("SA8", 0.9, freed_gas)) > LIMIT


def test_the_force_of_the_plate_which_testers_measure_grows_too():
    car = load_car().corner(load("SA8"))
    (run,) = runs(worn("SA8", 0.9), car, PLATES[:1], DT)
    (intact,) = runs(load("SA8"), car, PLATES[:1], DT)
    assert run.force_growth > 1.3 and intact.force_growth == pytest.approx(1.0, abs=0.01)


def test_without_freed_gas_nothing_tires():
    assert growth(worn("SA8", 0.9).with_(Y_Re_cav=0.0, Y_Co_cav=0.0)) < 1.02


def test_a_plate_of_todays_amplitude_judges_nothing():
    car = load_car().corner(load("SA8"))
    (run,) = runs(worn("SA8", 0.9), car, shaker([3e-3]), DT)
    assert run.growth < 1.02
    assert "stays below 0.9 m/s, where this damper cavitates" in not_judged(load("SA8"), car, [run], DT)
    assert "frees no gas" in not_judged(load("SA4"), car, [run], DT)


def test_plates_are_run_until_one_tires_the_damper_or_is_fast_enough():
    damper = load("SA8")
    car = load_car().corner(damper)
    intact = runs(damper, car, PLATES, DT)
    assert [run.plate for run in intact] == list(PLATES[:2])
    assert intact[0].peak < ENOUGH <= intact[1].peak
    assert not not_judged(damper, car, intact, DT)
    assert [run.plate for run in runs(worn("SA8", 0.9), car, PLATES, DT)] == [PLATES[0]]


def test_half_of_a_stroke_at_enough_is_faster_than_the_highest_v_cav_of_the_eight_dampers():
    assert max(load(f"SA{i}").parameters.v_cav for i in range(1, 9)) == HIGHEST
    angle = np.linspace(0.0, 2 * np.pi, 100_001)
    speed = ENOUGH * np.abs(np.cos(angle))
    assert np.sum(speed[speed > HIGHEST]) / np.sum(speed) == pytest.approx(0.5, abs=1e-3)


def test_a_group_has_whole_cycles_of_the_plate():
    run = shake(PLATES[1], DT)
    assert np.diff(run.begins) * DT == pytest.approx(CYCLES / FREQUENCY, abs=DT)
    assert (run.begins[0] * DT > RUN_UP) and (run.begins[-1] * DT <= RUN_UP + HOLD)


def test_a_rest_brings_back_what_oil_loss_took_but_not_what_heat_took():
    damper = load("SA8")
    car = load_car().corner(damper)
    assert returned(*twice(worn("SA8", 0.9), car, PLATES[0], DT)) > 0.9
    hot, again = twice(damper, car, PLATES[0], DT, 3 * HEAT.high)
    assert hot.growth > LIMIT, "as an oil that fades three times as much as the limit allows for would do"
    assert returned(hot, again) < 0.2
    assert returned(*twice(worn("SA8", 0.9, "stays"), car, PLATES[0], DT)) < 0.5


@pytest.mark.parametrize("name", ["SA1", "SA7", "SA8"])
def test_the_heat_of_the_run_alone_fails_no_intact_damper_even_where_it_takes_most(name):
    damper = load(name)
    for sample in samples(12, 3):
        setting = sample.setting()
        found = runs(sample.made(damper), sample.corner(damper, load_car()), setting.shaker, DT, fade=HEAT.high)
        assert HEAT.low <= setting.fade <= HEAT.high
        assert max(run.growth for run in found) < LIMIT
        assert found[-1].growth > 1.02, "heat is felt"


def test_the_draws_of_the_other_benches_do_not_depend_on_those_of_tiring():
    random = np.random.default_rng([1, 0])
    first = samples(1, 1)[0]
    assert [first.values[item.name] for item in BENCHES] == [random.uniform(item.low, item.high) for item in BENCHES]
    assert first.seed == random.integers(2**32)
    assert first.setting().shaker[0].drift == first.values["drift"] != 0.0


def test_a_plate_that_drifts_ends_at_another_frequency():
    with pytest.raises(InputError, match=r"^plate.drift = 0.2: must be a number from -0.05 to 0.05$"):
        Plate(drift=0.2)
    even, drifting = (shake(Plate(6e-3, FREQUENCY, RUN_UP, HOLD, COAST, drift), DT) for drift in (0.0, 0.01))
    extra = FREQUENCY * HOLD * 0.01 / 2  # cycles
    assert len(drifting.begins) - len(even.begins) == pytest.approx(extra / CYCLES, abs=1.0)


@pytest.mark.parametrize(
    ("name", "levels", "passed"),
    [
        ("SA8", (0.95, 0.75, 0.52, 0.35), [False, False, None, None]),
        ("SA5", (0.95, 0.45, 0.2), [True, None, None]),
        ("SA1", (0.85, 0.25), [True, None]),
        ("SA2", (0.97, 0.35), [True, None]),
    ],
)
def test_what_has_collapsed_before_it_is_read_does_not_pass(name, levels, passed):
    entries = inspected(load(name), load_car(), conditions(levels, gas_preload=0.0), ("tiring",))
    assert [entry.passed for entry in entries] == passed
    said = entries[-1].as_json
    assert said["passed"] is None and said["not_judged"] == said["not_judged_ways"][DEFAULT] == COLLAPSED
    assert remarks(entries)[-1].endswith(f"oil: {COLLAPSED}")
    headline = sentence(Inspection([load(name)], load_car(), entries, [], [DEFAULT], 1), load(name))
    lowest = [level for level, holds in zip(levels, passed, strict=True) if holds]
    assert (f"down to {lowest[-1]:.0%} (" if lowest else "at none of these oil levels (") in headline


@pytest.mark.parametrize("factor", [1.0, 0.75, 0.4])
def test_a_weak_curve_has_all_its_force_left(factor):
    """It is judged, and passes."""
    damper = load("SA8").with_(**scalar_factor(factor))
    car = load_car().corner(damper)
    assert force_left(damper, car, PLATES[0], DT) == pytest.approx(1.0, abs=0.02)
    assert not_judged(damper, car, runs(damper, car, PLATES, DT), DT) == ""


def test_an_empty_damper_has_only_its_friction_left():
    damper = load("SA8")
    assert force_left(worn("SA8", 0.0), load_car().corner(damper), PLATES[0], DT) < 0.05


def test_a_plate_that_takes_all_force_at_once_judges_nothing():
    """The SA8 with 80 % oil tires at 6 mm; 12 mm leave nothing to be read."""
    entries = [
        inspected(
            load("SA8"), load_car(), conditions((0.8,), gas_preload=0.0), ("tiring",), setting=Setting(shaker=shaker([a]))
        )[0]
        for a in (6e-3, 12e-3)
    ]
    assert [entry.passed for entry in entries] == [False, None]
    assert "tiring" not in USUAL


def test_a_damper_that_is_never_judged_is_not_called_unseen() -> None:
    run = RUNNER.invoke(app, ["inspect", "SA4", "--method", "tiring", "--oil-level", "0.9", "--scatter", "20", "--processes", "1",
                              "--freed-gas", "dissolves"])  # fmt: skip
    assert run.exit_code == 0, run.output
    assert (
        "SA4 is not judged by tiring of the damper: in this damper's parameter set cavitation frees no gas (Y = 0)"
        in run.output
    )
    assert "false alarms at none, as it does not judge this damper" in run.output and "passes" not in run.output


def test_what_other_benches_see_counts_though_tiring_does_not_judge_it():
    """The headline of several methods: tiring judges the SA8 where it has something to lose, the SA6 never."""
    lines = {}
    for name in ("SA8", "SA6"):
        entries = inspected(load(name), load_car(), conditions((1.0, 0.4), gas_preload=0.0), ("eusama", "tiring"))
        lines[name] = sentence(Inspection([load(name)], load_car(), entries, [], [DEFAULT], 1), load(name))
    lost = "(below 100% its gas preload is lost)"
    assert lines["SA8"] == f"SA8 passes every method at all of these oil levels down to 100% {lost}."
    assert lines["SA6"].startswith("SA6 passes every method but tiring of the damper, which does not judge it, at all")


def test_a_rough_road_tires_a_damper_too():
    damper = load("SA8")
    car, rough = load_car().corner(damper), track(30.0, 30.0, road_class="E", seed=1)
    assert road_growth(damper, car, rough, damper) == 1.0
    assert road_growth(worn("SA8", 0.9), car, rough, damper) > 1.1
    smooth = track(30.0, 30.0, road_class="A", seed=1)
    assert road_growth(worn("SA8", 0.9), car, smooth, damper) == pytest.approx(1.0, abs=0.02)


def test_the_command_says_what_tires_what_returns_and_what_is_not_judged(tmp_path: Path) -> None:
    file = tmp_path / "tiring.json"
    options = ["--method", "tiring", "--oil-level", "1", "--oil-level", "0.9", "--gas-lost", "--scatter", "0"]
    run = RUNNER.invoke(app, ["inspect", "SA8", "SA6", *options, "--json", str(file), "--output", str(tmp_path / "page")])
    assert run.exit_code == 0, run.output
    returned = re.search(r"dissolves (\d+)%, pushes_oil (\d+)%: oil loss: heat would have stayed", run.output)
    assert returned is not None and min(map(int, returned.groups())) > 90, "three half-lives leave an eighth of the gas"
    assert (
        "SA6 is not judged by tiring of the damper: in this damper's parameter set cavitation frees no gas (Y = 0)"
        in run.output
    )
    found = json.loads(file.read_text())
    intact, tired, *others = found["entries"]
    assert (intact["damper"], intact["oil_level"], intact["passed"], tired["passed"]) == ("SA8", 1.0, True, False)
    assert intact["figure"] == pytest.approx(1.0, abs=0.01) and tired["figure"] > 1.3
    assert tired["scalar_factor"]["passed"] and tired["scalar_factor"]["figure"] == pytest.approx(1.0, abs=0.02)
    assert set(tired["freed_gas_ways"]) >= set(tired["after_rest"]["freed_gas_ways"]) > {"dissolves"}
    assert [entry["passed"] for entry in others] == [None, None]
    assert all("frees no gas" in entry["not_judged"] for entry in others)
    names = {path.name for path in (tmp_path / "page").iterdir()}
    assert {"SA8_tiring.png", "SA6_tiring.png", "report.html"} <= names and "plate.png" not in names
    page = (tmp_path / "page" / "report.html").read_text(encoding="utf-8")
    assert "Does SA8 tire?" in page and "Refuted by" in page


def test_dead_lengths_are_compared_within_their_bounds(tmp_path: Path) -> None:
    file = tmp_path / "lengths.json"
    options = ["--method", "tiring", "--oil-level", "0.9", "--gas-lost", "--scatter", "0", "--freed-gas", "dissolves"]
    run = RUNNER.invoke(app, ["inspect", *options, "--dead-length", "60", "--dead-length", "110", "--json", str(file)])
    assert run.exit_code == 0, run.output
    found = json.loads(file.read_text())
    assert found["dead_lengths_m"] == {"SA8_60mm": 0.06, "SA8_110mm": 0.11}
    assert [entry["passed"] for entry in found["entries"]] == [False, False]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--method", "tiring", "--plate", "40"], "error: plate.amplitude = 0.04 m: must be a number from 0.0001 to 0.02 m"),
        (["--method", "tiring", "--plate", "nan"], "error: plate.amplitude = nan m: must be a number from 0.0001 to 0.02 m"),
        (["--plate", "6"], "error: --plate: is the plate of --method tiring, which is not among the methods"),
        (
            ["--dead-length", "45"],
            "error: --dead-length = 45 mm: must be a number from 60 to 110 mm: piston with its valves",
        ),
    ],
)
def test_a_bad_plate_or_length_ends_with_one_line(arguments: list[str], message: str) -> None:
    run = RUNNER.invoke(app, ["inspect", *arguments])
    assert run.exit_code == 2
    assert run.stderr.startswith(message)
    assert run.stderr.count("\n") == 1


def test_a_plate_that_cannot_reach_the_speed_of_cavitation_says_so() -> None:
    options = [
        "--method",
        "tiring",
        "--plate",
        "3",
        "--oil-level",
        "0.9",
        "--gas-lost",
        "--scatter",
        "0",
        "--freed-gas",
        "dissolves",
    ]
    run = RUNNER.invoke(app, ["inspect", *options])
    assert run.exit_code == 0, run.output
    said = re.search(
        r"not judged: damper velocity (\d.\d+) m/s stays below 0.9 m/s, where this damper cavitates", run.output
    )
    assert said is not None and 0.1 < float(said[1]) < 0.9
    assert "passes" not in run.output
