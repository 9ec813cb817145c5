"""The monitor's tables from features whose meaning is made up, and how many worn dampers they see."""

import numpy as np
import pytest

from twintube.dampers.freed_gas import DEFAULT
from twintube.driving import detection
from twintube.driving.channels import PLACES
from twintube.driving.features import CONDITIONS, OF_A_WHEEL
from twintube.driving.model import REFERENCE, SIGNS, Difference, from_json, shipped, to_json
from twintube.driving.training import Drive, fitted_table, of_rows, usual_values
from twintube.driving.usual import Usual, fitted
from twintube.errors import InputError

NAMES = ("speed_hop", "speed_damping", "speed_side", "speed_body")


def test_weights_have_the_sign_of_physics_and_good_dampers_stay_at_the_limit() -> None:
    pytest.importorskip("sklearn")
    random = np.random.default_rng(1)
    worn = np.arange(4000) % 2 == 0
    values = random.standard_normal((4000, len(NAMES)))
    for i, name in enumerate(NAMES[:3]):
        values[worn, i] += 1.5 * SIGNS[name]
    values[worn, 3] -= 0.5  # goes the other way than lost damping moves it
    known = dict.fromkeys(NAMES, 1.0)
    several = [Difference(dict(zip(NAMES, row, strict=True)), known) for row in values]
    table = fitted_table(several[:2000], worn[:2000], [str(i % 40) for i in range(2000)], NAMES)
    assert set(table.weights) == set(NAMES[:3])
    assert all(weight * SIGNS[name] > 0.0 for name, weight in table.weights.items())
    found = np.array([table.probability(each) for each in several[2000:]])
    assert np.mean(found[~worn[2000:]] > table.limit) == pytest.approx(0.01, abs=0.01)
    assert np.mean(found[worn[2000:]] > table.limit) > 0.6
    for low, high in ((0.1, 0.4), (0.4, 0.6), (0.6, 0.9)):
        here = (found > low) & (found < high)
        scatter = 0.5 / np.sqrt(np.count_nonzero(here))  # at most, of a share of so many
        assert np.mean(worn[2000:][here]) == pytest.approx(np.mean(found[here]), abs=3.0 * scatter)


def row(change: dict[str, float], random: np.random.Generator) -> dict[str, float]:
    """A minute of features that differ from what is usual as those of worn dampers do."""
    model, minute = shipped(), dict(zip(CONDITIONS, shipped().middle, strict=True))
    for place in PLACES:
        axle = "front" if place[0] == "f" else "rear"
        for sensor in ("speed", "accel"):
            for name in OF_A_WHEEL:
                feature = f"{sensor}_{name}"
                known = model.known[REFERENCE][axle]
                worn = known.wear[0][known.names.index(feature)]
                away = 0.1 * random.standard_normal() + 0.5 * change.get(place, 0.0) * worn
                minute[f"{feature}_{place}"] = model.usual[axle][feature].value + away
    return minute | {"cold": 0.0, "body_bounce": model.usual["front"]["body_bounce"].value}


def drives(car: str, levels: tuple[float, ...], random: np.random.Generator) -> list[Drive]:
    """A reference and a drive of a car; the more oil a damper has lost, the more its features differ."""
    gas = tuple(int(level == 1.0) for level in levels)
    change = {place: 3.0 * (1.0 - level) for place, level in zip(PLACES, levels, strict=True)}
    good = Drive(car, [row({}, random) for _ in range(2)], (1.0,) * 4, (1,) * 4, reference=True)
    return [good, Drive(car, [row(change, random)], levels, gas)]


def test_detection_rises_with_oil_loss() -> None:
    random = np.random.default_rng(2)
    test = [each for i, level in enumerate((0.95, 0.55, 0.15)) for each in drives(f"test {i}", (level, 1, 1, 1), random)]
    training = drives("train 1", (1.0, 1.0, 1.0, 1.0), random)
    found = detection.summary(detection.tested(shipped(), training, test))["detection"]
    seen = {
        each["oil"]: each["seen"]
        for each in found
        if (each["method"], each["compared_with"], each["sensors"]) == ("monitor", "reference", "bus and wheels")
    }
    assert list(seen) == ["10 to 20 %", "50 to 60 %", "90 to 100 %"]
    assert list(seen.values()) == sorted(seen.values(), reverse=True) and seen["10 to 20 %"] == 1


def test_training_and_test_share_no_car() -> None:
    both = drives("train 1", (0.3, 1.0, 1.0, 1.0), np.random.default_rng(3))
    with pytest.raises(InputError, match="share the car train 1"):
        detection.tested(shipped(), both, both)


def test_minutes_do_not_hold_the_truth() -> None:
    truth = {f"{name}_{place}": 1.0 for name in ("oil_level", "gas_preload", "tyre_pressure") for place in PLACES}
    about = {"drive": 3, "group": "test", "car": 1, "reference": False, "model": DEFAULT, "minute": 1, "speed_kmh": 80.0}
    drive = of_rows([about | truth | row({}, np.random.default_rng(4))])
    assert drive.car == "test 1" and drive.good("fl")
    assert not {*truth, "minute", "drive"} & set(drive.minutes[0])


def test_slopes_are_those_within_a_car() -> None:
    """Cars that are driven faster, and differ besides, do not pass for what speed does."""
    random, found = np.random.default_rng(5), []
    for car in range(6):
        minutes = []
        for _ in range(20):
            minute, faster = row({}, random), float(random.uniform(-0.3, 0.3)) + 0.2 * car
            minute["speed"] += faster
            minute |= {name: value + 2.0 * faster - 5.0 * car for name, value in minute.items() if "speed_hop" in name}
            minutes.append(minute)
        found.append(Drive(str(car), minutes, (1.0,) * 4, (1,) * 4))
    usual = usual_values(found, shipped().middle)
    assert usual["front"]["speed_hop"].slopes[0] == pytest.approx(2.0, abs=0.1)


def test_tables_are_the_same_when_read_again() -> None:
    text = to_json(shipped())
    assert to_json(from_json(text)) == text


def cars(random: np.random.Generator, count: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """Cars of a standard deviation of 0.5 with slopes of 0.3 and 0, in drives of 0.1."""
    found = []
    for _ in range(count):
        there = random.standard_normal((6, 2))
        values = 2.0 + 0.5 * random.standard_normal() + 0.3 * random.standard_normal() * there[:, 0]
        found.append((there, values + 0.1 * random.standard_normal(6)))
    return found


def test_what_cars_differ_by_is_found_and_references_are_worth_what_they_say() -> None:
    random = np.random.default_rng(6)
    usual = fitted(2.0, [0.0, 0.0, 0.0], cars(random, 200))
    assert (usual.cars, usual.drives, usual.moves[0]) == pytest.approx((0.5, 0.1, 0.3), rel=0.15)
    assert usual.moves[1] < 0.03
    errors, told = [], []
    for there, values in cars(random, 400):
        mean, variance = usual.expected(there[0], there[1:], values[1:])
        errors.append(values[0] - mean)
        told.append(variance)
    assert np.mean(np.square(errors)) == pytest.approx(np.mean(told), rel=0.2)


def test_references_on_a_like_road_make_surer() -> None:
    usual, here = Usual(2.0, (0.0,) * 3, 0.5, (0.3, 0.0), 0.1), np.zeros(2)
    alone = usual.expected(here, np.empty((0, 2)), np.empty(0))
    assert alone == pytest.approx((2.0, 0.5**2 + 0.1**2))
    far, near = (usual.expected(here, np.array([[x, 0.0]]), np.array([3.0])) for x in (2.0, 0.0))
    assert alone[1] > far[1] > near[1]
    assert 2.0 < far[0] < near[0] < 3.0
    four = usual.expected(here, np.zeros((4, 2)), np.full(4, 3.0))
    assert four[1] < near[1] and four[0] > near[0]
