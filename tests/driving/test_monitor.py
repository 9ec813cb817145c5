"""The monitor on oscillators whose damping is known, and on input that it must refuse."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from rolling import SHEET, rolling
from scipy import stats
from typer.testing import CliRunner

from twintube.cli import app
from twintube.driving import plausible
from twintube.driving.channels import PLACES
from twintube.driving.features import LEAST, MINUTE, table
from twintube.driving.model import DRIVEN, FLEET, MOST, REFERENCE, SETS, SIGNS, Difference, deviates, names_of, shipped
from twintube.driving.monitor import FINE, UNCLEAR, WATCH, WORN_OUT, Watched, watch
from twintube.driving.physical import wheel_hop
from twintube.driving.signals import Signals
from twintube.driving.spectra import HOP, coherence, density, hold, spectra
from twintube.driving.writing import write
from twintube.errors import InputError
from twintube.report.monitor import terminal


@pytest.mark.parametrize("zeta", [0.05, 0.1, 0.2])
@pytest.mark.parametrize("interval", [0.01, 0.02])
def test_damping_ratio_of_wheel_hop(zeta: float, interval: float) -> None:
    some = spectra(rolling((zeta,) * 4, seconds=300.0, interval=interval))
    found = [wheel_hop(some.frequency, density(some.amplitude[f"speed_{place}"])) for place in PLACES]
    assert np.mean([natural for natural, _ in found]) == pytest.approx(12.0, rel=0.03)
    assert np.mean([ratio for _, ratio in found]) == pytest.approx(zeta, rel=0.2)


def test_power_is_that_of_the_signal() -> None:
    signals = rolling(seconds=120.0)
    some = spectra(signals)
    step = some.frequency[1]
    for place in PLACES:
        values = signals.values[f"wheel_speed_{place}_rad_per_s"]
        power = np.nansum(density(some.amplitude[f"speed_{place}"])) * step
        # Below a step and at the orders of the wheel nothing is counted.
        assert 0.5 < power / np.var(values / values.mean()) < 1.1


def test_orders_of_the_wheel_are_left_out() -> None:
    turns = 20.0 / SHEET["wheel_radius_m"] / (2 * np.pi)
    some = spectra(rolling())
    assert HOP[0] < turns < HOP[1]
    hidden = np.isnan(density(some.amplitude["speed_fl"]))
    assert hidden[np.abs(some.frequency - turns) < 0.25].all() and hidden.mean() < 0.5


def test_slow_channels_are_taken_once() -> None:
    coarse = rolling(interval=0.02)
    twice = Signals(np.arange(2 * len(coarse)) * 0.01, {n: np.repeat(x, 2) for n, x in coarse.values.items()}, SHEET)
    assert (hold(twice), hold(coarse)) == (2, 1)
    assert table(twice)[0]["speed_hop_fl"] == pytest.approx(table(coarse)[0]["speed_hop_fl"])


def test_units_of_a_sensor_do_not_matter() -> None:
    signals = rolling(accels=True)
    scaled = {name: x * (0.1 if "wheel_accel" in name else 1.0) for name, x in signals.values.items()}
    first, second = table(signals)[0], table(replace(signals, values=scaled))[0]
    assert first == pytest.approx(second)


def test_minutes() -> None:
    rows = table(rolling(seconds=300.0))
    assert len(rows) == 5
    assert [row["windows"] for row in rows[:-1]] == [MINUTE] * 4 and rows[-1]["windows"] >= MINUTE
    assert len(table(rolling(seconds=2.0 * (LEAST + 1)))) == 1


ROUGH = 5e-3  # the wheels show the power of the training's middle, within a factor of two; at 1e-3 a fiftieth


@pytest.fixture(scope="module")
def good() -> Signals:
    return rolling(seconds=180.0, rough=ROUGH, seed=7)


@pytest.mark.parametrize("place", PLACES)
def test_a_lost_damper_is_named(place: str) -> None:
    damping = tuple(0.05 if each == place else 0.3 for each in PLACES)
    drive, good = (rolling(some, seconds=180.0, accels=True, seed=i) for i, some in enumerate((damping, (0.3,) * 4)))
    answer = watch(drive, [good])
    assert answer.way == REFERENCE and answer.sensors == "bus and wheels"
    assert answer.worst.place == place
    assert answer.worst.damping < 0.4
    # These wheels carry no body, which no car of the training does: nothing need be said of them.
    assert all(each.state in (FINE, UNCLEAR) for each in answer.dampers if each.place != place)


def test_good_dampers_are_fine() -> None:
    drive, good = (rolling(seconds=180.0, rough=ROUGH, accels=True, seed=i) for i in (1, 7))
    answer = watch(drive, [good])
    assert {each.state for each in answer.dampers} == {FINE}
    assert answer.coherence > 0.8 and answer.seconds == pytest.approx(180.0)


def test_wheel_speeds_alone_leave_good_dampers_open(good: Signals) -> None:
    """More than 1 in 20 worn dampers look as most of them do."""
    answer = watch(rolling(seconds=180.0, rough=ROUGH), [good])
    assert {each.state for each in answer.dampers} <= {UNCLEAR, FINE} and answer.of(UNCLEAR) and not answer.unlike
    assert all(each.fine < each.probability < 0.5 for each in answer.of(UNCLEAR))


def test_wheel_speeds_of_one_drive_call_nothing() -> None:
    answer = watch(rolling((0.02, 0.3, 0.3, 0.3), seconds=180.0, rough=ROUGH))
    assert {each.state for each in answer.dampers} <= {UNCLEAR, FINE}


def test_a_road_that_is_smoother_than_all_that_was_trained_is_not_judged() -> None:
    drive, good = (rolling(seconds=180.0, rough=3e-4, seed=i) for i in (1, 7))
    assert len(watch(drive, [good]).unlike) == 4


def test_the_answer_does_not_read_the_truth(good: Signals) -> None:
    drive = rolling((0.05, 0.3, 0.3, 0.3), seconds=120.0, rough=ROUGH)
    labelled = replace(drive, labels={"wheels": {place: {"oil_level": 1.0} for place in PLACES}})
    assert watch(drive, [good]).as_json == watch(labelled, [good]).as_json


def test_the_order_of_the_references_does_not_matter(good: Signals) -> None:
    drive, other = (
        rolling(zeta, seconds=120.0, rough=ROUGH, seed=i) for i, zeta in ((3, (0.05, 0.3, 0.3, 0.3)), (4, (0.3,) * 4))
    )
    one, two = (watch(drive, order) for order in ([good, other], [other, good]))
    for a, b in zip(one.dampers, two.dampers, strict=True):
        assert (a.probability, a.distance) == pytest.approx((b.probability, b.distance), rel=1e-9)


def test_more_damping_lost_is_never_less_worn() -> None:
    for ways in shipped().tables.values():
        for axles in ways.values():
            for each in axles.values():
                assert all(weight * SIGNS[name] > 0.0 for name, weight in each.weights.items())
                variance = {name: scale**2 for name, scale in each.scales.items()}
                nothing = Difference(dict.fromkeys(each.weights, 0.0), variance)
                lost = Difference({name: 100.0 * SIGNS[name] * each.scales[name] for name in each.weights}, variance)
                assert each.probability(nothing) < 0.5 < each.probability(lost)
                assert sum(each.parts(lost).values()) == pytest.approx(MOST * sum(map(abs, each.weights.values())))
                # The less is known of what is usual, the less is said, either way.
                for some in (nothing, lost):
                    doubtful = replace(some, variance={name: 1e6 * value for name, value in variance.items()})
                    assert each.probability(doubtful) == pytest.approx(0.5, abs=1e-4)


@pytest.mark.parametrize(
    ("probability", "limit", "state"),
    [(0.0, 0.5, FINE), (0.49, 0.96, FINE), (0.5, 0.96, UNCLEAR), (0.71, 0.96, UNCLEAR), (0.97, 0.96, WATCH),
     (0.6, 0.5, WATCH), (0.99, 0.96, WORN_OUT), (0.995, 0.997, UNCLEAR)],
)  # fmt: skip
def test_the_word_follows_from_the_probability_and_its_limit(probability: float, limit: float, state: str) -> None:
    assert Watched("fl", probability, limit, 1.0, {}, {}).state == state


@pytest.mark.parametrize("probability", [0.0, 0.7, 0.999])
def test_what_is_unlike_all_that_was_trained_is_neither_fine_nor_worn(probability: float) -> None:
    each = Watched("fl", probability, 0.9, 1.0, {}, {}, distance=5.1, far=5.0)
    assert each.unlike and each.state == UNCLEAR
    assert not replace(each, distance=4.9).unlike


@pytest.mark.parametrize("way", [REFERENCE, FLEET])
@pytest.mark.parametrize("sensors", SETS)
def test_the_distance_grows_with_every_feature_and_not_with_wear(way: str, sensors: str) -> None:
    for axle, place in (("front", "fl"), ("rear", "rl")):
        known = shipped().known[way][axle]
        nothing, spread = dict.fromkeys(known.names, 0.0), np.sqrt(np.diag(known.covariance))
        least = known.distance(Difference(nothing, {}), sensors)
        for amount in (0.5, 1.0, 3.0):  # of a worn damper here, beside it, and at the other axle
            for row in known.wear:
                worn = {name: amount * value for name, value in zip(known.names, row, strict=True)}
                assert known.distance(Difference(worn, {}), sensors) == pytest.approx(least, abs=1e-3)
        far = shipped().table(way, sensors, place).far
        for name, size in zip(known.names, spread, strict=True):
            # Wear moves a feature one way only, but for those that compare with another wheel, whose wear moves them back.
            if name in (*names_of(sensors), *DRIVEN) and not name.endswith(("_side", "_axle")):
                away = -SIGNS.get(name, 1) * 20.0 * far * size
                assert known.distance(Difference(nothing | {name: away}, {}), sensors) > far


@pytest.mark.parametrize("sensors", SETS)
def test_a_road_rougher_than_all_of_the_training_is_not_judged(sensors: str) -> None:
    """Whatever the wheels show: a wheel that leaves the road shows the damping of nothing."""
    known = shipped().known[REFERENCE]["front"]
    rough = dict.fromkeys(known.names, 0.0) | {"speed": -0.9, "level": 7.5}  # beyond class E at 25 km/h, 6
    assert known.distance(Difference(rough, {}), sensors) > shipped().table(REFERENCE, sensors, "fl").far


def test_a_deviate_is_as_rare_as_the_distance() -> None:
    for count in (2, 7, 16):
        for share in (0.5, 0.9, 0.99):
            distance = float(np.sqrt(stats.chi2.ppf(share, count)))
            assert deviates(distance, count) == pytest.approx(stats.norm.ppf(share), abs=0.06)


def test_a_washboard_is_not_judged(good: Signals) -> None:
    """One wave of 9 Hz under all wheels: no damper shows that."""
    drive = rolling(seconds=180.0, rough=ROUGH)
    wave = 0.02 * np.sin(2.0 * np.pi * 9.0 * drive.time)

    def waved(name: str, values: dict[str, np.ndarray]) -> np.ndarray:
        return values[name] * (1.0 + wave) if "wheel_speed" in name else values[name]

    assert not watch(drive, [good]).unlike
    answer = watch(changed(drive, waved), [good])
    assert len(answer.unlike) == 4 and {each.state for each in answer.dampers} == {UNCLEAR}
    assert "Cannot tell from this drive about any damper: unlike all that was trained." in terminal(answer)


def test_one_drive_alone_of_an_unknown_car_says_what_was_seen() -> None:
    """Oscillators without a body are no car."""
    text = " ".join(terminal(watch(rolling(seconds=180.0, rough=ROUGH, accels=True))).split())
    assert (
        "Cannot tell from one drive without references about the rear left and rear right dampers: unlike all that" in text
    )
    assert "Seen: the rear wheels run over the road 0.140 s after the front wheels, 0.140 s by wheelbase and speed" in text


def climbing(holds: float, swing: float = 0.5) -> Signals:
    """A drive over hills: the driver gives way by `holds` of the grade, 0 holding his speed and 1 his throttle."""
    drive = rolling(swing=swing, seconds=180.0)
    grade = 0.03 * np.sin(0.11 * drive.time)
    lost = holds * 9.81 * np.cumsum(grade) * drive.interval
    values = {name: x - lost / SHEET["wheel_radius_m"] if "wheel_speed" in name else x for name, x in drive.values.items()}
    values["accel_x_m_per_s2"] = values["accel_x_m_per_s2"] + 9.81 * grade * (1.0 - holds)
    return replace(drive, values=values)


@pytest.mark.parametrize("holds", [0.0, 0.5, 1.0])
def test_a_hill_is_no_other_unit(holds: float) -> None:
    plausible.check_units(climbing(holds))


@pytest.mark.parametrize("holds", [0.0, 0.5, 1.0])
def test_another_unit_is_seen_on_hills(holds: float) -> None:
    def metres(name: str, values: dict[str, np.ndarray]) -> np.ndarray:
        return values[name] * (SHEET["wheel_radius_m"] if "wheel_speed" in name else 1.0)

    with pytest.raises(InputError, match=r"wheel speeds: they gain 0\.\d\d times the speed that accel_x_m_per_s2 says"):
        plausible.check_units(changed(climbing(holds, 2.0), metres))


def backwards(name: str, values: dict[str, np.ndarray]) -> np.ndarray:
    return -values[name] if name == "accel_x_m_per_s2" else values[name]


def test_a_wheel_that_leaves_the_road_is_not_too_smooth() -> None:
    """Front and rear wheels that share nothing, each swinging at its hop."""
    drive, other = rolling((0.02,) * 4, seconds=120.0), rolling((0.02,) * 4, seconds=120.0, seed=2)
    rear = {name: x for name, x in other.values.items() if "_rl_" in name or "_rr_" in name}
    some = spectra(replace(drive, values=dict(drive.values) | rear))
    assert coherence(some, "speed") < plausible.LEAST_COHERENCE
    plausible.check_road(some)


def test_no_damper_that_is_likelier_worn_than_good_is_said_to_damp_as_good_ones(good: Signals) -> None:
    answer = watch(rolling(seconds=180.0, rough=ROUGH), [good])
    half = [
        replace(each, probability=p, limit=0.96) for each, p in zip(answer.dampers, (0.71, 0.6, 0.999, 0.0), strict=True)
    ]
    text = terminal(replace(answer, dampers=tuple(half)))
    said = " ".join(text.split())
    assert "The rear left damper has lost its damping: replace." in said
    assert (
        "Cannot tell from this drive about the front left and front right dampers: good and worn dampers look like that."
        in said
    )
    assert "1 other damps as a good one." in said
    row = next(line for line in text.splitlines() if line.startswith("front left damper"))
    assert row.split("  ")[1:] and "cannot tell" in row and "71 %" in row and "96 %" in row


def test_tables_for_all_sensors() -> None:
    model = shipped()
    assert {way: set(some) for way, some in model.tables.items()} == {REFERENCE: set(SETS), FLEET: set(SETS)}


def changed(signals: Signals, change: Callable[[str, dict[str, np.ndarray]], np.ndarray]) -> Signals:
    return replace(signals, values={name: change(name, dict(signals.values)) for name in signals.values})


def kmh(name: str, values: dict[str, np.ndarray]) -> np.ndarray:
    return values[name] * (3.6 * SHEET["wheel_radius_m"] if "wheel_speed" in name else 1.0)


def front_for_rear(name: str, values: dict[str, np.ndarray]) -> np.ndarray:
    other = {"_fl": "_rl", "_fr": "_rr", "_rl": "_fl", "_rr": "_fr"}
    end = next((end for end in other if end in name), "")
    return values[name.replace(end, other[end])] if "wheel_speed" in name else values[name]


def one_accel_twice(name: str, values: dict[str, np.ndarray]) -> np.ndarray:
    return values[name.replace("fl", "fr")] if name == "wheel_accel_fl_m_per_s2" else values[name]


def foreign_accel(name: str, values: dict[str, np.ndarray]) -> np.ndarray:
    return rolling(accels=True, seed=5).values[name] if name == "wheel_accel_fl_m_per_s2" else values[name]


def still(name: str, values: dict[str, np.ndarray]) -> np.ndarray:
    return np.full_like(values[name], 70.0) if name == "wheel_speed_rr_rad_per_s" else values[name]


def braking(name: str, values: dict[str, np.ndarray]) -> np.ndarray:
    return np.full_like(values[name], 2e6) if name == "brake_pressure_pa" else values[name]


@pytest.mark.parametrize(
    ("options", "change", "says"),
    [
        ({"swing": 0.5, "seconds": 120.0}, kmh, r"wheel speeds: .* as if they were in km/h; must be rad/s"),
        ({"swing": 0.5, "seconds": 120.0}, backwards, "accel_x_m_per_s2 falls where the wheels gain speed"),
        ({"runout": 1e-3}, kmh, r"wheel speeds: 1.08 times the rotation of the wheels, .* as if they were in km/h"),
        ({}, front_for_rear, "exchanged wheels: wheel_speed_fl_rad_per_s shows the rear left wheel, "),
        ({"accels": True}, one_accel_twice, "wheel_accel_fl_m_per_s2 and wheel_accel_fr_m_per_s2: the same values throughout"),
        ({"accels": True}, foreign_accel, "wheel_accel_fl_m_per_s2: unrelated to wheel_speed_fl_rad_per_s"),
        ({}, still, "wheel_speed_rr_rad_per_s = 70 throughout"),
        ({}, braking, r"drive too short: 0 usable windows .*\(29 braking\): must be at least 10"),
        ({"seconds": 15.0}, None, "drive too short: 6 usable windows"),
        ({"seconds": 3.0}, None, "a drive of 3 s: must be at least 4 s"),
        ({"speed": 5.0}, None, r".*29 slower than 25 km/h.*Are the wheel speeds rad/s\?"),
        ({"rough": 1e-6}, None, "drive too smooth: front and rear wheels share 0.0"),
        ({"interval": 0.04}, None, "wheel speeds every 40 ms: must be at most 25 ms"),
    ],
)  # fmt: skip
def test_bad_input_is_refused(options: dict[str, float], change: object, says: str) -> None:
    signals = rolling(**options)
    with pytest.raises(InputError, match="drive.parquet: " + says):
        watch(changed(signals, change) if change else signals, names=["drive.parquet"])  # type: ignore[arg-type]


def test_a_data_sheet_is_needed(good: Signals) -> None:
    with pytest.raises(InputError, match=r"car.wheelbase_m is not known: give --car FILE, in which \[body\] has wheelbase"):
        watch(replace(good, car={}))
    with pytest.raises(InputError, match=r"reference 1: car.wheelbase_m = 2.5: must be 2.8 as in the drive"):
        watch(rolling(), [replace(good, car=SHEET | {"wheelbase_m": 2.5})])


def test_km_per_h_without_a_line_only_misplaces_the_road() -> None:
    """12 % are within what unequal resonances do to the delay: the answer stands, and the docs say so."""
    drive = changed(rolling(), kmh)
    plausible.check_drive(spectra(drive), drive)


def test_lines_at_the_orders_of_rad_per_s_are_no_other_unit() -> None:
    plausible.check_turns(rolling(runout=1e-3))


def test_coherence_of_wheels_without_a_road() -> None:
    assert coherence(spectra(rolling(rough=0.0, seconds=180.0)), "speed") < 0.1


def test_command(tmp_path: Path, good: Signals) -> None:
    drive, reference = tmp_path / "drive.parquet", tmp_path / "good.parquet"
    write(rolling((0.3, 0.3, 0.05, 0.3), seconds=180.0, rough=ROUGH), drive)
    write(good, reference)
    page, figures = tmp_path / "monitor.html", tmp_path / "monitor.json"
    run = CliRunner().invoke(
        app, ["monitor", str(drive), "--reference", str(reference), "--output", str(page), "--json", str(figures)]
    )
    assert run.exit_code == 0, run.output
    assert "rear left damper" in run.output
    found = json.loads(figures.read_text())
    assert max(found["dampers"], key=lambda each: found["dampers"][each]["probability_worn"]) == "rl"
    assert found["compared_with"] == "reference"
    html = page.read_text()
    assert "rear left damper" in html and "Next:" in html and "drive.parquet" in html
    for arguments, says in (
        ([str(drive), "--reference", str(drive)], "is the drive itself"),
        ([str(drive), "--output", str(tmp_path / "page.pdf")], "must end in .html"),
        ([str(tmp_path / "none.parquet")], "none.parquet"),
    ):
        run = CliRunner().invoke(app, ["monitor", *arguments])
        assert run.exit_code == 2 and says in run.output
