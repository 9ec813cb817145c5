"""How many worn dampers the monitor sees, at the limit that 1 in 100 good dampers of the training passes.

The drives that are judged are those of other cars, tyres and roads than the training's.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from scipy import stats

from twintube.common.arrays import Array
from twintube.dampers.freed_gas import DEFAULT
from twintube.driving.channels import PLACES
from twintube.driving.model import AXLES, FLEET, REFERENCE, Model
from twintube.driving.training import FALSE_ALARMS, Drive, examples
from twintube.errors import InputError

CONFIDENCE: Final = 0.95
MONITOR, BASELINE = "monitor", "damping ratio"
ONE, AXLE, ALL, OTHER = "one damper", "an axle", "all four", "several"
STEP: Final = 10  # [%] of oil level in a row
EDGES: Final = np.array([0.0, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0])  # of the probabilities whose reliability is told


@dataclass(frozen=True)
class Judged:
    """One damper in one drive, judged: `score` is the probability, or minus the change of ln damping ratio.

    `unlike` is one that is too far from the training to be judged; below `fine` it is said to be fine.
    """

    drive: Drive
    place: str
    minutes: int
    way: str
    sensors: str
    method: str
    score: float
    limit: float
    unlike: bool = False
    fine: float = -np.inf

    @property
    def seen(self) -> bool:
        """Whether it is beyond the limit, and judged."""
        return self.score > self.limit and not self.unlike

    @property
    def passed(self) -> bool:
        """Whether it is said to be fine."""
        return self.score < self.fine and not self.unlike

    @property
    def oil(self) -> str:
        """The truth, in steps of STEP: `30 to 40 %`."""
        low = int(self.drive.oil_levels[PLACES.index(self.place)] * 100 // STEP * STEP)
        return f"{low} to {low + STEP} %"

    @property
    def good(self) -> bool:
        """The truth."""
        return self.drive.good(self.place)

    @property
    def pattern(self) -> str:
        """How many dampers of the car are not good."""
        bad = [place for place in PLACES if not self.drive.good(place)]
        if len(bad) < 2:
            return ONE
        if len(bad) == len(PLACES):
            return ALL
        return AXLE if len(bad) == 2 and AXLES[bad[0]] == AXLES[bad[1]] else OTHER


def baseline_limits(model: Model, training: Sequence[Drive]) -> dict[tuple[str, str], float]:
    """By way and axle, how far the damping ratio of wheel hop falls in 1 of 100 good dampers of the training."""
    limits = {}
    for way in (REFERENCE, FLEET):
        for axle in ("front", "rear"):
            places = [place for place in PLACES if AXLES[place] == axle]
            falls = [
                -difference.values["speed_damping"]
                for place in places
                for drive, _, difference in examples(model, training, way, place)
                if drive.good(place)
            ]
            limits[way, axle] = float(np.quantile(falls, 1.0 - FALSE_ALARMS))
    return limits


def judged(model: Model, drives: Sequence[Drive], limits: dict[tuple[str, str], float]) -> list[Judged]:
    """Every damper of all drives, for each length, way, set of sensors, and by the damping ratio alone."""
    found = []
    for way in (REFERENCE, FLEET):
        for place in PLACES:
            for drive, length, difference in examples(model, drives, way, place):
                fall = -difference.values["speed_damping"]
                limit = limits[way, AXLES[place]]
                found.append(Judged(drive, place, length, way, "bus", BASELINE, fall, limit))
                for sensors in model.tables[way]:
                    table = model.table(way, sensors, place)
                    if all(name in difference.values for name in table.weights):
                        unlike = model.distance(way, sensors, place, difference) > table.far
                        score = table.probability(difference)
                        found.append(
                            Judged(drive, place, length, way, sensors, MONITOR, score, table.limit, unlike, table.fine)
                        )
    return found


def share(some: Sequence[Judged]) -> dict[str, Any]:
    """Share of the seen with its interval (Clopper and Pearson), and how many there are."""
    count = sum(each.seen for each in some)
    interval = stats.binomtest(count, len(some)).proportion_ci(CONFIDENCE)
    return {
        "seen": count,
        "share": count / len(some),
        "band": [float(interval.low), float(interval.high)],
        "dampers": len(some),
        "unlike": sum(each.unlike for each in some),
    }


def rows(some: Iterable[Judged]) -> list[dict[str, Any]]:
    """The seen share of the dampers that lost oil, by all that a drive differs in."""
    groups: dict[tuple[Any, ...], list[Judged]] = {}
    for each in some:
        if not each.good:
            key = (each.method, each.way, each.sensors, AXLES[each.place], each.pattern, each.minutes, each.drive.model,
                   each.oil)  # fmt: skip
            groups.setdefault(key, []).append(each)
    names = ("method", "compared_with", "sensors", "axle", "worn", "minutes", "model", "oil")
    return [dict(zip(names, key, strict=True)) | share(group) for key, group in sorted(groups.items())]


def answers(some: Iterable[Judged], kind: Callable[[Judged], str]) -> list[dict[str, Any]]:
    """What was said of good dampers, and of those as worn as in the training, by their kind, way, sensors and length."""
    groups: dict[tuple[Any, ...], list[Judged]] = {}
    for each in some:
        if each.method == MONITOR and each.drive.model == DEFAULT:
            groups.setdefault((kind(each), each.way, each.sensors, each.minutes), []).append(each)
    found = []
    for key, group in sorted(groups.items()):
        good, worn = [each for each in group if each.good], [each for each in group if is_worn(each)]
        whole = [each for each in worn if each.pattern == ALL]
        counts = {
            "cars": len({each.drive.car for each in group}), "good": len(good), "called": sum(x.seen for x in good),
            "fine": sum(x.passed for x in good), "unlike": sum(x.unlike for x in good),
            "worn": len(worn), "seen": sum(x.seen for x in worn), "missed": sum(x.passed for x in worn),
            "all four": len(whole), "all four seen": sum(x.seen for x in whole),
        }  # fmt: skip
        found.append(dict(zip(("kind", "compared_with", "sensors", "minutes"), key, strict=True)) | counts)
    return found


def false_alarms(some: Iterable[Judged]) -> list[dict[str, Any]]:
    """The seen share of good dampers, in cars whose dampers are all good, and in others."""
    groups: dict[tuple[Any, ...], list[Judged]] = {}
    for each in some:
        if each.good:
            others = "all good" if all(map(each.drive.good, PLACES)) else "some worn"
            key = (each.method, each.way, each.sensors, AXLES[each.place], each.minutes, others)
            groups.setdefault(key, []).append(each)
    names = ("method", "compared_with", "sensors", "axle", "minutes", "car")
    return [dict(zip(names, key, strict=True)) | share(group) for key, group in sorted(groups.items())]


def reliability(some: Iterable[Judged]) -> list[dict[str, Any]]:
    """Of dampers as good or as worn as in the training: the mean probability, and the share that is worn at even odds."""
    own_method = [each for each in some if each.method == MONITOR and each.drive.model == DEFAULT]
    used = [each for each in own_method if is_good(each) or is_worn(each)]
    found = []
    for way in (REFERENCE, FLEET):
        own = [each for each in used if each.way == way]
        score, worn = np.array([each.score for each in own]), np.array([not each.good for each in own])
        # Worn and good dampers weigh the same, as the probability takes them to be as likely.
        of_worn, of_good = (0.5 / max(1, int(np.count_nonzero(kind))) for kind in (worn, ~worn))
        weight = np.where(worn, of_worn, of_good)
        place = np.clip(np.searchsorted(EDGES, score, side="right") - 1, 0, len(EDGES) - 2)
        for i in range(len(EDGES) - 1):
            if (here := place == i).any():
                found.append({
                    "compared_with": way, "from": float(EDGES[i]), "to": float(EDGES[i + 1]),
                    "probability": mean(score[here], weight[here]), "worn": mean(worn[here], weight[here]),
                    "dampers": int(np.count_nonzero(here)),
                })  # fmt: skip
    return found


def mean(values: Array, weight: Array) -> float:
    """Weighted mean."""
    return float(values @ weight / weight.sum())


def is_worn(each: Judged) -> bool:
    """Whether a damper is as worn as those of the training."""
    return each.drive.worn(each.place)


def is_good(each: Judged) -> bool:
    """Whether a damper is as new."""
    return each.good


def tested(model: Model, training: Sequence[Drive], test: Sequence[Drive]) -> list[Judged]:
    """All judgements of the test; raises InputError where it shares a car with the training."""
    if shared := {drive.car for drive in training} & {drive.car for drive in test}:
        raise InputError(f"training and test share the car {sorted(shared)[0]}: they must not")
    return judged(model, test, baseline_limits(model, training))


def summary(some: Sequence[Judged]) -> dict[str, Any]:
    """All figures of a test for JSON."""
    return {
        "tested": {"cars": len({each.drive.car for each in some}), "drives": len({id(each.drive) for each in some})},
        "answers": answers(some, lambda each: each.drive.group),
        "detection": rows(some),
        "false_alarms": false_alarms(some),
        "reliability": reliability(some),
    }
