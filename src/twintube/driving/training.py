"""The monitor's tables from drives whose dampers are known; needs scikit-learn (extra `training`).

Drives are those of `twintube study driving`, in the group `train`; those of the group `test` are for `detection`.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from twintube.dampers.freed_gas import DEFAULT
from twintube.driving.channels import PLACES
from twintube.driving.features import CONDITIONS, mean_of, of_the_damper
from twintube.driving.model import (
    AXLES,
    DRIVEN,
    FLEET,
    LIKELIER,
    MOST,
    REFERENCE,
    SETS,
    SIGNS,
    WORN,
    Difference,
    Known,
    Model,
    Table,
    names_of,
)
from twintube.driving.usual import Usual, fitted, means
from twintube.errors import InputError

LENGTHS: Final = (1, 2, 5, 20)  # [min] of drives that are judged
FALSE_ALARMS: Final = 0.01  # of the good dampers, for the limit of a table
MISSED: Final = 0.05  # of the worn dampers, for what is said to be fine
STRENGTHS: Final = (0.01, 0.1, 1.0, 10.0)  # of the weights against their penalty; the best one for cars left out is taken
FOLDS: Final = 5  # groups of cars


@dataclass(frozen=True)
class Drive:
    """A drive of a car: its minutes, and the truth of the four dampers in the order of PLACES."""

    car: str
    minutes: Sequence[Mapping[str, float]]
    oil_levels: tuple[float, ...]
    gas_preload: tuple[float, ...]
    reference: bool = False  # a drive of the car in its good state, to compare others with
    model: str = DEFAULT  # of worn dampers: a way of the freed gas, or the scalar factor
    group: str = "train"

    def good(self, place: str) -> bool:
        """Whether a damper is as new."""
        i = PLACES.index(place)
        return self.oil_levels[i] == 1.0 and self.gas_preload[i] == 1

    def worn(self, place: str) -> bool:
        """Whether a damper is worn."""
        return self.oil_levels[PLACES.index(place)] <= WORN


def load(path: Path) -> list[Drive]:
    """The drives of a study's Parquet file that gave minutes; raises InputError for another file, OSError."""
    import pyarrow.parquet as pq

    names = pq.read_schema(path).names
    if missing := [name for name in ("drive", "car", "speed_hop_fl") if name not in names]:
        raise InputError(f"{path.name}: column {missing[0]} is missing: must be a file of `twintube study driving`")
    found: dict[tuple[int, str], list[dict[str, Any]]] = {}
    for row in pq.read_table(path).to_pylist():
        if row["minute"] > 0:
            found.setdefault((row["drive"], row["model"]), []).append(row)
    # Cars have a number in each file.
    return [replace(drive, car=f"{drive.car} of {path.name}") for drive in map(of_rows, found.values())]


def of_rows(rows: Sequence[Mapping[str, Any]]) -> Drive:
    """The drive of a study's rows."""
    first = rows[0]
    oil, gas = (tuple(first[f"{name}_{place}"] for place in PLACES) for name in ("oil_level", "gas_preload"))
    # The truth stays outside of the minutes: nothing that judges them can read it.
    known = {name for name in first if name in CONDITIONS or name.startswith(("speed_", "accel_", "body_"))}
    minutes = [{name: row[name] for name in known} for row in rows]
    car = f"{first['group']} {first['car']}"
    return Drive(car, minutes, oil, gas, first["reference"], first["model"], first["group"])


def references(drives: Iterable[Drive]) -> dict[str, list[Drive]]:
    """The reference drives by car."""
    found: dict[str, list[Drive]] = {}
    for drive in drives:
        if drive.reference:
            found.setdefault(drive.car, []).append(drive)
    return found


def usual_values(drives: Sequence[Drive], middle: Sequence[float]) -> dict[str, dict[str, Usual]]:
    """Fleet's value and slopes of all features by axle, from good dampers in cars whose dampers are all good.

    The slopes are those within a car: a car's own deviation has no part in them.
    """
    good = [drive for drive in drives if all(map(drive.good, PLACES))]
    found: dict[str, dict[str, Usual]] = {}
    for axle in ("front", "rear"):
        found[axle] = {}
        places = [place for place in PLACES if AXLES[place] == axle]
        rows = [(i, place, row) for i, drive in enumerate(good) for row in drive.minutes for place in places]
        x = np.array([[row[name] for name in CONDITIONS] for _, _, row in rows]) - np.array(middle)
        group = np.unique([f"{good[i].car} {place}" for i, place, _ in rows], return_inverse=True)[1]
        drive = np.unique([f"{i} {place}" for i, place, _ in rows], return_inverse=True)[1]
        car = group[np.unique(drive, return_index=True)[1]]  # of each drive
        driven = np.column_stack([np.bincount(drive, column) / np.bincount(drive) for column in x[:, : len(DRIVEN)].T])
        own = [of_the_damper(row, place) for _, place, row in rows]
        for name in SIGNS:
            if any(name not in each for each in own):
                continue
            y = np.array([each[name] for each in own])
            within_x, within_y = x - means(x, group), y - means(y[:, None], group)[:, 0]
            slopes = np.linalg.lstsq(within_x, within_y, rcond=None)[0]
            value = float(np.mean(y - x @ slopes))
            # The air is not known to every car.
            level = y - x[:, : len(DRIVEN)] @ slopes[: len(DRIVEN)]
            each = np.bincount(drive, level) / np.bincount(drive)
            found[axle][name] = fitted(
                value, list(map(float, slopes)), [(driven[car == i], each[car == i]) for i in range(car.max() + 1)]
            )
    return found


def examples(
    model: Model, drives: Sequence[Drive], way: str, place: str, lengths: Sequence[int] = LENGTHS
) -> list[tuple[Drive, int, Difference]]:
    """Drive, length [min] and differences of a damper, for all lengths that a drive has.

    A reference is a drive, too: a good one, compared with the other references.
    """
    known, found = references(drives) if way == REFERENCE else {}, []
    minutes = {id(drive): [model.at_middle(row, place) for row in drive.minutes] for drive in drives}
    for drive in drives:
        usual = [mean_of(minutes[id(each)]) for each in known.get(drive.car, ()) if each is not drive]
        if way == REFERENCE and not usual:
            continue
        for length in lengths:
            if length <= len(drive.minutes):
                found.append((drive, length, model.apart(mean_of(minutes[id(drive)][:length]), place, usual)))
    return found


def neighbours(place: str) -> tuple[tuple[str, ...], ...]:
    """The wheel itself, the other wheel of its axle, and those of the other axle."""
    side = place[0] + ("r" if place[1] == "l" else "l")
    return (place,), (side,), tuple(other for other in PLACES if other not in (place, side))


def known_of(rows: Sequence[tuple[Drive, str, Difference]]) -> Known:
    """What drives showed: of drives whose dampers are all good or worn."""
    sure = [each for each in rows if all(each[0].good(place) or each[0].worn(place) for place in PLACES)]
    names = [name for name in SIGNS if all(name in each.values for _, _, each in sure)] + list(DRIVEN)
    values = np.array([[each.values[name] for name in names] for _, _, each in sure])
    worn = np.array([[np.mean([drive.worn(p) for p in some]) for some in neighbours(place)] for drive, place, _ in sure])
    wear = np.linalg.lstsq(worn, values, rcond=None)[0]
    # Wear moves neither speed nor road.
    wear[:, len(names) - len(DRIVEN) :] = 0.0
    rest, good = values - worn @ wear, ~worn.any(axis=1)
    squares = [each.T @ each / max(1, len(each)) for each in (rest[good], rest[~good])]
    return Known(tuple(names), *(tuple(map(tuple, each.tolist())) for each in (wear, *squares)))


def fitted_table(
    differences: Sequence[Difference], worn: np.ndarray[Any, np.dtype[np.bool_]], cars: Sequence[str], names: Sequence[str]
) -> Table:
    """The weights (features with the sign that physics gives alone) and the limit, from differences.

    A feature whose weight has the wrong sign says nothing that the others do not; it is left out, and the rest fitted anew.
    """
    from sklearn.linear_model import LogisticRegression
    from sklearn.model_selection import GridSearchCV, StratifiedGroupKFold, cross_val_predict

    values = np.array([[each.values[name] for name in names] for each in differences])
    scale = np.std(values[~worn], axis=0)
    used = list(range(len(names)))
    folds = list(StratifiedGroupKFold(FOLDS).split(values, worn, cars))
    while True:
        x = np.clip(values / scale, -MOST, MOST)[:, used]
        # Even odds, however many dampers of the training are worn.
        weighing = LogisticRegression(class_weight="balanced", solver="newton-cholesky")
        search = GridSearchCV(weighing, {"C": STRENGTHS}, scoring="neg_log_loss", cv=folds).fit(x, worn)
        best = search.best_estimator_
        weights = best.coef_[0]
        wrong = [i for i, weight in zip(used, weights, strict=True) if weight * SIGNS[names[i]] <= 0.0]
        if not wrong:
            break
        used = [i for i in used if i not in wrong]
        if not used:
            raise InputError(f"training: none of {', '.join(names)} goes the way that lost damping moves it")
    table = Table(
        float(best.intercept_[0]),
        {names[i]: float(weight) for i, weight in zip(used, weights, strict=True)},
        {names[i]: float(scale[i]) for i in used},
        LIKELIER,
    )
    # The penalty makes probabilities too even: a factor of the log odds of cars left out puts that right (Platt).
    odds = cross_val_predict(best, x, worn, cv=folds, method="decision_function")
    odds = np.array([[table.sure(each) * x] for each, x in zip(differences, odds, strict=True)])
    line = LogisticRegression(class_weight="balanced", fit_intercept=False).fit(odds, worn)
    slope, probability = float(line.coef_[0, 0]), line.predict_proba(odds)[:, 1]
    return Table(
        slope * table.intercept,
        {name: slope * weight for name, weight in table.weights.items()},
        table.scales,
        # A damper that is likelier good than worn is none to watch.
        max(LIKELIER, float(np.quantile(probability[~worn], 1.0 - FALSE_ALARMS))),
        min(LIKELIER, float(np.quantile(probability[worn], MISSED))),
    )


def examples_of(model: Model, drives: Sequence[Drive], way: str, axle: str) -> list[tuple[Drive, str, Difference]]:
    """Drive, place and differences of the good and worn dampers of an axle."""
    return [
        (drive, place, difference)
        for place in PLACES
        if AXLES[place] == axle
        for drive, _, difference in examples(model, drives, way, place)
        if drive.model == DEFAULT and (drive.good(place) or drive.worn(place))
    ]


def trained_axle(model: Model, drives: Sequence[Drive], way: str, axle: str) -> tuple[Known, dict[str, Table]]:
    """What the dampers of an axle showed, and its tables by sensors; raises InputError without good or worn dampers."""
    from sklearn.model_selection import StratifiedGroupKFold

    rows = examples_of(model, drives, way, axle)
    worn = np.array([drive.worn(place) for drive, place, _ in rows])
    if worn.all() or not worn.any():
        raise InputError(f"training: {np.count_nonzero(worn)} of {len(worn)} {axle} dampers are worn: must be some")
    known, tables, cars = known_of(rows), {}, [drive.car for drive, _, _ in rows]
    # How far the good dampers of cars are that had no part in what is known.
    strange = [
        (known_of([rows[i] for i in others]), [rows[i] for i in left if rows[i][0].good(rows[i][1])])
        for others, left in StratifiedGroupKFold(FOLDS).split(rows, worn, cars)
    ]
    for sensors in SETS:
        names = list(names_of(sensors))
        if not set(names) <= set(known.names):
            continue
        table = fitted_table([each for _, _, each in rows], worn, cars, names)
        distances = [other.distance(each, sensors) for other, some in strange for _, _, each in some]
        tables[sensors] = replace(table, far=float(np.quantile(distances, 1.0 - FALSE_ALARMS)))
    return known, tables


def for_other_cars(model: Model, tables: dict[str, Table], others: Sequence[Drive], axle: str) -> dict[str, Table]:
    """The tables without references, with limits that at most 1 in 100 good dampers of another kind of car passes, too.

    By wheel speeds alone one drive calls no damper: a decision, after it missed most worn ones and passed the limit on the
    one real drive, whose dampers nobody knows.
    """
    good = [each for drive, place, each in examples_of(model, others, FLEET, axle) if drive.good(place)]
    limits = {
        sensors: float(np.quantile([table.probability(each) for each in good], 1.0 - FALSE_ALARMS))
        for sensors, table in tables.items()
        if "accel_" in SETS[sensors]
    }
    return {sensors: replace(table, limit=max(table.limit, limits.get(sensors, 1.0))) for sensors, table in tables.items()}


def train(drives: Sequence[Drive], about: Mapping[str, Any], others: Sequence[Drive] = ()) -> Model:
    """All tables from drives; raises InputError where a set has no good or no worn dampers.

    Without references the kind of a car counts: with drives of `others`, of another kind, the limits hold for them, too.
    """
    conditions = np.array([[row[name] for name in CONDITIONS] for drive in drives for row in drive.minutes])
    middle = tuple(map(float, np.mean(conditions, axis=0)))
    model = Model(middle, usual_values(drives, middle), {}, {}, about)
    # The air is not known to every car: a table must do without it. Where it is, the differences are the smaller.
    unknown, strange = (
        [replace(drive, minutes=[without_air(row) for row in drive.minutes]) for drive in some] for some in (drives, others)
    )
    known: dict[str, dict[str, Known]] = {}
    tables: dict[str, dict[str, dict[str, Table]]] = {}
    for way in (REFERENCE, FLEET):
        for axle in ("front", "rear"):
            known.setdefault(way, {})[axle], own = trained_axle(model, unknown, way, axle)
            if way == FLEET and strange:
                own = for_other_cars(model, own, strange, axle)
            for sensors, table in own.items():
                tables.setdefault(way, {}).setdefault(sensors, {})[axle] = table
    return replace(model, known=known, tables=tables)


def without_air(row: Mapping[str, float]) -> dict[str, float]:
    """A minute of a car that does not say how cold it is."""
    return {name: value for name, value in row.items() if name in DRIVEN or name not in CONDITIONS}
