"""From features to the probability that a damper is worn: a table of weights, each of a feature with a meaning.

What counts is by how much a feature differs from what is usual: for the car in its good state, where references are given,
else for the fleet of the training (`usual.py`). The sum of weight times difference over scale is the logarithm of the odds
against a good damper, a worn one taken as likely as a good one before the drive. It counts the less the less is known of
what is usual.

That says which of two kinds a damper is likelier of, and nothing of whether it is of either. So there is a distance, too: of
all features, and of speed and road, to what good dampers show plus any amount of what wear adds, at this wheel, at the other
wheel of the axle and at the other axle; and of speed and road alone. What is further off than 99 of 100 good dampers is not
judged.
"""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from functools import lru_cache
from importlib.resources import files
from typing import Any, Final

import numpy as np
from scipy import linalg, optimize

from twintube.driving.channels import PLACES
from twintube.driving.features import CONDITIONS, OF_A_WHEEL, mean_of, of_the_damper
from twintube.driving.usual import Usual

FILE: Final = "monitor.json"
MOST: Final = 4.0  # scales that a feature counts at most: no good damper is further off, and no damper is surer worn
WORN: Final = 0.4  # oil level of a worn damper, the lower one of the paper's degraded states
LIKELIER: Final = 0.5  # probability: below, a damper is likelier good than worn
REFERENCE, FLEET = "reference", "fleet"
DRIVEN: Final = ("speed", "level")  # of CONDITIONS: those that every drive shows
AXLES: Final = {place: "front" if place[0] == "f" else "rear" for place in PLACES}
# Which way a feature goes where damping is lost.
SIGNS: Final = {
    **{f"{sensor}_{name}": -1 if name == "damping" else 1 for sensor in ("speed", "accel") for name in OF_A_WHEEL},
    "body_bounce": 1,
}
SETS: Final = {  # sensors by the beginnings of their features
    "bus": ("speed_",),
    "bus and body": ("speed_", "body_"),
    "bus and wheels": ("speed_", "accel_"),
    "bus, body and wheels": ("speed_", "body_", "accel_"),
}


def names_of(sensors: str) -> tuple[str, ...]:
    """The features of a set of sensors."""
    return tuple(name for name in SIGNS if name.startswith(SETS[sensors]))


def sensors_of(rows: Sequence[Mapping[str, float]]) -> str:
    """The largest set of sensors whose features are in all minutes."""
    shared = set.intersection(*(set(of_the_damper(row, PLACES[0])) for row in rows))
    return [name for name in SETS if shared.issuperset(names_of(name))][-1]


def clipped(value: float) -> float:
    """A difference over its scale, within +-MOST."""
    return min(max(value, -MOST), MOST)


@dataclass(frozen=True)
class Difference:
    """By how much a drive differs from what is usual, by feature and DRIVEN, and the variance of that by feature."""

    values: Mapping[str, float]
    variance: Mapping[str, float]


@dataclass(frozen=True)
class Table:
    """The weights of an axle: log odds = intercept + sum of weight * difference / scale, each within +-MOST.

    A scale is the standard deviation of good dampers. `limit` [1] is the probability that at most 1 in 100 good dampers
    of the training passes, `far` the distance. Below `fine` lie at most 1 in 20 worn ones, and none that is likelier worn.
    """

    intercept: float
    weights: Mapping[str, float]
    scales: Mapping[str, float]
    limit: float
    fine: float = LIKELIER
    far: float = math.inf

    def sure(self, difference: Difference) -> float:
        """How well what is usual is known, over how well it was in the training: variances of the log odds."""
        parts = {name: weight**2 for name, weight in self.weights.items()}
        return sum(parts.values()) / sum(x * difference.variance[name] / self.scales[name] ** 2 for name, x in parts.items())

    def parts(self, difference: Difference) -> dict[str, float]:
        """What each feature adds to the log odds."""
        sure = self.sure(difference)
        return {
            name: sure * weight * clipped(difference.values[name] / self.scales[name])
            for name, weight in self.weights.items()
        }

    def odds(self, difference: Difference) -> float:
        """Their logarithm, that the damper is worn rather than good."""
        return self.sure(difference) * self.intercept + sum(self.parts(difference).values())

    def probability(self, difference: Difference) -> float:
        """That the damper is worn [1]."""
        return 1.0 / (1.0 + math.exp(-self.odds(difference)))


def deviates(distance: float, count: int) -> float:
    """How rare a distance of `count` features is, as deviates of a normal distribution (Wilson and Hilferty 1931)."""
    spread = 2.0 / (9.0 * count)
    return float(((distance**2 / count) ** (1.0 / 3.0) - 1.0 + spread) / math.sqrt(spread))


@dataclass(frozen=True)
class Known:
    """What the training showed at the wheels of an axle, in the order of `names`, all features and DRIVEN.

    `wear` (3, n) is what a worn damper adds to the differences: that of the wheel itself, that of the other wheel of the
    axle, those of the other axle. `covariance` (n, n) is that of the rest in good cars; `scatter` (n, n) in cars with worn
    dampers, as no two cars answer to wear alike.
    """

    names: tuple[str, ...]
    wear: tuple[tuple[float, ...], ...]
    covariance: tuple[tuple[float, ...], ...]
    scatter: tuple[tuple[float, ...], ...]

    def distance(self, difference: Difference, sensors: str) -> float:
        """How far a difference is from good dampers and any wear, or its speed and road from the training: what is rarer."""
        both = (*names_of(sensors), *DRIVEN), DRIVEN
        return max(deviates(self.away(difference, names), len(names)) for names in both)

    def away(self, difference: Difference, names: Sequence[str]) -> float:
        """The same of some features, in standard deviations of good dampers, root of the sum."""
        which = [self.names.index(name) for name in names]
        own, more = (np.array(each)[np.ix_(which, which)] for each in (self.covariance, self.scatter))
        wear, seen = np.array(self.wear)[:, which].T, np.array([difference.values[name] for name in names])
        amounts, distance = np.zeros(len(self.wear)), 0.0
        # The more wear there is, the more it scatters, up to that of the training: first how much, then how far.
        for _ in range(2):
            root = linalg.cholesky(own + min(1.0, float(amounts @ amounts)) * more, lower=True)
            amounts, distance = optimize.nnls(*(linalg.solve_triangular(root, each, lower=True) for each in (wear, seen)))
        return float(distance)


@dataclass(frozen=True)
class Model:
    """All tables: `usual` by axle and feature, `known` by REFERENCE or FLEET and axle, `tables` by sensors besides.

    `about` says of what they were made.
    """

    middle: tuple[float, ...]  # of CONDITIONS in the training
    usual: Mapping[str, Mapping[str, Usual]]
    known: Mapping[str, Mapping[str, Known]]
    tables: Mapping[str, Mapping[str, Mapping[str, Table]]]
    about: Mapping[str, Any] = field(default_factory=dict)

    def at_middle(self, row: Mapping[str, float], place: str) -> dict[str, float]:
        """The features of a damper as they would be at the middle of the conditions, and DRIVEN from there.

        A condition that is not known is taken for the middle.
        """
        away = {name: row.get(name, middle) - middle for name, middle in zip(CONDITIONS, self.middle, strict=True)}
        own = of_the_damper(row, place)
        return {name: away[name] for name in DRIVEN} | {
            name: own[name] - sum(a * b for a, b in zip(usual.slopes, away.values(), strict=True))
            for name, usual in self.usual[AXLES[place]].items()
            if name in own
        }

    def difference(
        self, rows: Sequence[Mapping[str, float]], place: str, references: Sequence[Sequence[Mapping[str, float]]] = ()
    ) -> Difference:
        """By how much the features of a damper differ from what is usual, and DRIVEN from the middle.

        `rows` are the minutes of the drive, `references` those of drives of the same car in its good state.
        """
        here, *there = (mean_of([self.at_middle(row, place) for row in some]) for some in (rows, *references))
        return self.apart(here, place, there)

    def apart(self, here: Mapping[str, float], place: str, there: Sequence[Mapping[str, float]] = ()) -> Difference:
        """As `difference`, of means of minutes that are `at_middle`."""
        driven, known = (np.array([[some[name] for name in DRIVEN] for some in several]) for several in ((here,), there))
        values, variance = {name: here[name] for name in DRIVEN}, {}
        for name, usual in self.usual[AXLES[place]].items():
            if name in here:
                mean, variance[name] = usual.expected(driven[0], known, np.array([some[name] for some in there]))
                values[name] = here[name] - mean
        return Difference(values, variance)

    def table(self, way: str, sensors: str, place: str) -> Table:
        """The weights for REFERENCE or FLEET, a set of sensors and a damper."""
        return self.tables[way][sensors][AXLES[place]]

    def distance(self, way: str, sensors: str, place: str, difference: Difference) -> float:
        """How far the difference of a damper is from all that was trained."""
        return self.known[way][AXLES[place]].distance(difference, sensors)


def to_json(model: Model) -> str:
    """The model as text, with the digits that count."""
    return json.dumps(rounded(asdict(model)), indent=None, separators=(", ", ": ")).replace("}, ", "},\n") + "\n"


def rounded(value: Any) -> Any:
    """Numbers with five digits."""
    if isinstance(value, Mapping):
        return {name: rounded(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [rounded(each) for each in value]
    return float(f"{value:.5g}") if isinstance(value, float) else value


def from_json(text: str) -> Model:
    """The model of a text that `to_json` wrote."""
    content = json.loads(text)
    usual = {
        axle: {name: Usual(**each | {key: tuple(each[key]) for key in ("slopes", "moves")}) for name, each in some.items()}
        for axle, some in content["usual"].items()
    }
    tables = {
        way: {sensors: {axle: Table(**each) for axle, each in axles.items()} for sensors, axles in some.items()}
        for way, some in content["tables"].items()
    }
    known = {
        way: {
            axle: Known(tuple(each["names"]), *(tuple(map(tuple, each[name])) for name in ("wear", "covariance", "scatter")))
            for axle, each in axles.items()
        }
        for way, axles in content["known"].items()
    }
    return Model(tuple(content["middle"]), usual, known, tables, content["about"])


@lru_cache
def shipped() -> Model:
    """The model that comes with the package."""
    return from_json(files("twintube.driving").joinpath(FILE).read_text(encoding="utf-8"))
