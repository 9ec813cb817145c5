"""At which wheel each sensor sits, by what the wheels share: so exchanged channels are found.

A rear wheel runs over what the front wheel of its side ran over, later by wheelbase over speed; at a wheel, speed and
acceleration see the road at once. Each of these links is a correlation R of two signals, both whitened. Its logarithm of
the likelihood against no link is -N ln(1 - R), N being the independent values; of unrelated signals it is exponentially
distributed with mean 1 (for N - 1, Goodman 1963). The order of the channels is that whose links are the likeliest.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise, permutations, product
from typing import Final

import numpy as np
from scipy import stats

from twintube.common.arrays import Array
from twintube.driving.channels import PLACES
from twintube.driving.spectra import BETWEEN, HOP, SENSORS, Spectra, within

Order = tuple[int, ...]  # by place, the number in PLACES of the channel that sits there
AS_NAMED: Final[Order] = (0, 1, 2, 3)
ORDERS: Final = tuple(permutations(AS_NAMED))
# [Hz] within about 2 Hz two wheels' frequency responses turn against each other by little: the peak of wheel hop, at 12 Hz
# with a damping ratio of 0.1, is 2.4 Hz wide.
EDGES: Final = np.linspace(BETWEEN[0], HOP[1], 7)
FEWEST: Final = 2.0  # independent values of a band: one is always alike
CHANCE: Final = 1e-4  # that unrelated signals pass a limit


@dataclass(frozen=True)
class Links:
    """The log likelihood that channels are linked, by their numbers in PLACES."""

    followed: Array  # [sensor, front, rear] as front and rear wheel of a side
    together: Array | None  # [speed, acceleration] as those of a wheel; None without accelerations
    independent: float  # values of a signal

    def likelihood(self, orders: Sequence[Order]) -> float:
        """Of an order for each sensor."""
        pairs = zip(self.followed, orders, strict=True)
        total = sum(each[order[0], order[2]] + each[order[1], order[3]] for each, order in pairs)
        if self.together is not None:
            total += self.together[orders[0], orders[1]].sum()
        return float(total)

    def share(self, orders: Sequence[Order]) -> float:
        """The squared correlation of what belongs together in an order, mean of the links."""
        return -math.expm1(-self.likelihood(orders) / (self.count * max(self.independent, 1.0)))

    @property
    def count(self) -> int:
        """How many links a car has."""
        return 2 * len(self.followed) + (0 if self.together is None else len(PLACES))


def white(some: Spectra, sensor: str, there: Array) -> Array:
    """Amplitudes (4, windows, frequencies) of a sensor's wheels over the root of their density; 0 where an order lies."""
    amplitude = np.nan_to_num(np.array([some.amplitude[f"{sensor}_{place}"] for place in PLACES])[:, :, there])
    power = np.mean(np.abs(amplitude) ** 2, axis=1, keepdims=True)
    return np.asarray(amplitude / np.sqrt(np.where(power > 0.0, power, 1.0)))


def linked(first: Array, second: Array, independent: float) -> Array:
    """The log likelihood (4, 4) that the whitened signals of one kind are linked with those of another in a band."""
    one, other = (each.reshape(len(PLACES), -1) for each in (first, second))
    power = np.outer(*(np.sum(np.abs(each) ** 2, axis=1) for each in (one, other)))
    share = np.abs(np.conj(one) @ other.T) ** 2 / np.maximum(power, np.finfo(float).tiny)
    return np.asarray(-(independent - 1.0) * np.log1p(-np.minimum(share, 1.0 - 1e-12)))


def links(some: Spectra) -> Links:
    """The links between all wheels of a drive."""
    followed = np.zeros((len(some.sensors), len(PLACES), len(PLACES)))
    together, values = np.zeros((len(PLACES), len(PLACES))), 0.0
    for band in pairwise(EDGES):
        there = within(some.frequency, band)
        # Windows lie half over one another, and a step of frequency is one over their length: a half is independent.
        independent = 0.5 * np.count_nonzero(np.isfinite(some.amplitude["speed_fl"][:, there]))
        if independent < FEWEST:
            continue
        values += independent
        later = np.exp(2j * np.pi * some.frequency[there] * some.delay[:, None])
        wheels = [white(some, sensor, there) for sensor in some.sensors]
        followed += [linked(each, each * later, independent) for each in wheels]
        together += linked(wheels[0], wheels[-1], independent)
    return Links(followed, together if some.sensors == SENSORS else None, values)


def limit(count: int, others: int, chance: float = CHANCE) -> float:
    """What the likeliest of `others` orders of `count` unrelated links passes with a probability of `chance` at most."""
    return float(stats.gamma.isf(chance / others, count * (len(EDGES) - 1)))


def likelier(found: Links) -> list[tuple[Order, ...]]:
    """The likeliest orders, one for each sensor, where they are likelier than the names say by more than chance; else none.

    They are at least two: left for right in all sensors is not told apart.
    """
    orders = list(product(ORDERS, repeat=len(found.followed)))
    likelihood = {each: found.likelihood(each) for each in orders}
    best = max(likelihood.values())
    if best - likelihood[(AS_NAMED,) * len(found.followed)] <= limit(found.count, len(orders) - 2):
        return []
    return [each for each in orders if math.isclose(likelihood[each], best, rel_tol=1e-9)]


def fewest_moved(orders: Sequence[tuple[Order, ...]]) -> list[tuple[Order, ...]]:
    """Those in which the fewest channels sit elsewhere than their names say, and of these the fewest wheel speeds."""

    def moved(each: tuple[Order, ...]) -> tuple[int, int]:
        counts = [sum(i != k for i, k in zip(order, AS_NAMED, strict=True)) for order in each]
        return sum(counts), counts[0]

    fewest = min(map(moved, orders))
    return [each for each in orders if moved(each) == fewest]
