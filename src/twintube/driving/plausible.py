"""Whether a drive can be judged, and whether its channels are what their names say: each doubt ends with one line."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations
from typing import Final

import numpy as np
from scipy import signal

from twintube.common.arrays import Array
from twintube.common.words import counted
from twintube.driving.channels import NAMES, PLACES, channel_name
from twintube.driving.columns import SPEEDS
from twintube.driving.features import LEAST
from twintube.driving.places import AS_NAMED, Links, Order, fewest_moved, likelier, limit, links
from twintube.driving.signals import Signals
from twintube.driving.spectra import (
    BETWEEN,
    HOP,
    SENSORS,
    WINDOW,
    Spectra,
    braked,
    coherence,
    cross,
    density,
    swing,
    taken,
    thinned,
    windows,
    within,
)
from twintube.errors import InputError

LEAST_COHERENCE: Final = 0.25  # of front and rear wheel: the road then makes half of the power of each, 0.5 squared
# Wheel hop over the noise of the sensor below which that noise alone makes so little coherence. Above it a wheel swings so
# that it leaves the road, and then front and rear wheels differ: no smooth road, but lost damping.
LEAST_SWING: Final = 1.0 / (1.0 - LEAST_COHERENCE**0.5)
# Numbers of a wheel speed over those in rad/s, times the radius.
UNITS: Final = {name: 1.0 / size for name, size in SPEEDS.items()}
FACTORS: Final = np.geomspace(
    0.1, 12.0, 100
)  # of the speed at which the rear wheels may follow: from rev/s to m/s and beyond
ENOUGH: Final = 150  # windows, 5 minutes, that show the delay
# Resonances of unequal front and rear dampers pass for a delay of a quarter period: 20 ms of the 50 that 200 km/h leaves.
GROSS: Final = 2.5
SURE: Final = 4.0  # standard errors
FEWEST_BLOCKS: Final = 4  # of a second, for a slope with an error
LEAST_GAIN: Final = 0.2  # [m/s2] root mean square: below, the wheels' own noise has a part in what they gain
DIFFERS: Final = 0.08  # of the speed: tyres are worn and pressed by 4 %, km/h for rad/s is 12 %
ORDERS: Final = (1, 2, 3, 4)  # of a wheel: at 90 km/h below the Nyquist frequency of 10 ms
BESIDE: Final = (4, 5, 6)  # steps of 1 / WINDOW beside an order, outside of its main lobe
ASIDE: Final = 0.06  # of the rotation: half way from km/h to rad/s


def check_channels(signals: Signals) -> None:
    """Raise InputError where a sensor stands still, or a channel is another than its name says."""
    check_alive(signals)
    check_units(signals)
    check_turns(signals)


def check_drive(some: Spectra, signals: Signals) -> None:
    """Raise InputError where a drive is too short or smooth for an answer, or a channel is another wheel's."""
    check_length(some)
    found = links(some)
    check_order(found, signals)
    check_road(some)
    check_same_wheel(some, found)


def check_alive(signals: Signals) -> None:
    """Raise InputError for a sensor of a wheel or the body that stands still throughout, or is that of another wheel."""
    for name, values in signals.values.items():
        if ("wheel" in name or "body" in name) and values.max() == values.min():
            raise InputError(f"{name} = {values[0]:.6g} throughout: this sensor does not move")
    for one, other in combinations((name for name in signals.values if "wheel" in name), 2):
        if np.array_equal(signals.values[one], signals.values[other]):
            raise InputError(f"{one} and {other}: the same values throughout, must be of two wheels")


def slope(y: Array, x: Array) -> tuple[float, float]:
    """Slope of y over x through the origin, and its standard error; both NaN where x does not move."""
    power = float(x @ x)
    if power == 0.0 or len(x) < 3:
        return float("nan"), float("nan")
    value = float(y @ x) / power
    rest = y - value * x
    return value, float(np.sqrt(rest @ rest / (len(x) - 1) / power))


def blocks(values: Array, count: int) -> Array:
    """Means (b,) over blocks of samples."""
    whole = len(values) // count * count
    return np.asarray(values[:whole].reshape(-1, count).mean(axis=1))


def check_units(signals: Signals) -> None:
    """Raise InputError where the wheels gain another speed than the car."""
    count = max(2, round(1.0 / signals.interval))
    radius = float(signals.car["wheel_radius_m"])
    wheel = {place: blocks(signals.values[f"wheel_speed_{place}_rad_per_s"] * radius, count) for place in PLACES}
    if len(wheel["fl"]) < 4:
        return
    off = blocks(braked(signals.values).astype(float), count) > 0.0
    gained = np.diff(np.mean(list(wheel.values()), axis=0)) / (count * signals.interval)
    along = blocks(signals.values["accel_x_m_per_s2"], count)
    along = 0.5 * (along[1:] + along[:-1])
    free = ~(off[1:] | off[:-1])
    if np.count_nonzero(free) < FEWEST_BLOCKS:
        return
    gained, along = (each[free] - each[free].mean() for each in (gained, along))
    if np.sqrt(np.mean(gained**2)) <= LEAST_GAIN:
        return
    # On a hill the sensor shows the slope of the road besides. A driver who holds his speed lets the sensor show more than
    # the wheels do, one who holds the throttle less: how many times too much the wheels gain lies between the two slopes.
    (low, low_error), (share, share_error) = slope(gained, along), slope(along, gained)
    if share < -SURE * share_error:
        raise InputError("accel_x_m_per_s2 falls where the wheels gain speed: it must be positive where the car gains speed")
    high, high_error = (1.0 / share, share_error / share**2) if share > 0.0 else (np.inf, 0.0)
    too_fast = low - 1.0 > max(DIFFERS, SURE * low_error)
    if too_fast or 1.0 - high > max(DIFFERS, SURE * high_error):
        factor = low if too_fast else high
        raise InputError(
            f"wheel speeds: they gain {factor:.2f} times the speed that accel_x_m_per_s2 says{unit_of(factor, radius)}; "
            "must be rad/s and m/s2"
        )


def turned(signals: Signals, order: Order = AS_NAMED) -> list[tuple[int, int]]:
    """The axles, by the places of their wheels, that turn with the other sign than the yaw in an `order` of the channels."""
    count = max(2, round(1.0 / signals.interval))
    wheel = [blocks(signals.values[channel_name("speed", PLACES[i])], count) for i in order]
    yaw = blocks(signals.values["yaw_rate_rad_per_s"], count)
    found = []
    for left, right in ((0, 1), (2, 3)):
        ratio, error = slope(wheel[right] - wheel[left], yaw)
        if ratio < -SURE * error:
            found.append((left, right))
    return found


def unit_of(ratio: float, radius: float) -> str:
    """The unit whose numbers would be so many times too large, in words; empty where there is none."""
    near = {name: abs(np.log(ratio / (factor * radius))) for name, factor in UNITS.items() if ratio > 0.0}
    name = min(near, key=lambda each: near[each], default="")
    return f", as if they were in {name}" if name and near[name] < DIFFERS else ""


def check_turns(signals: Signals) -> None:
    """Raise InputError where the wheels' orders lie at another speed of rotation than the wheel speeds say.

    What is uneven in an encoder, a rim or a tyre repeats with each turn: it draws lines, whatever the dampers do.
    """
    for unit, factor in UNITS.items():
        ratio = factor * float(signals.car["wheel_radius_m"])
        found, *others = orders(signals, [1.0 / ratio, 1.0, (1.0 - ASIDE) / ratio, (1.0 + ASIDE) / ratio])
        # A resonance near an order stands above its surroundings as well, but no more than it does aside of the order.
        more = found - others
        if len(found) > 2 and (more.mean(axis=1) > SURE * more.std(axis=1, ddof=1) / np.sqrt(len(found))).all():
            raise InputError(
                f"wheel speeds: {ratio:.2f} times the rotation of the wheels, by what repeats with each turn, "
                f"as if they were in {unit}; must be rad/s"
            )


def orders(signals: Signals, turns: Sequence[float]) -> Array:
    """How far the power at the orders is above that beside them: natural logarithms, mean of wheels and ORDERS.

    `turns` (n,) are speeds of rotation over the wheel speeds; the result is (n, windows). Windows in which a wheel stands
    or does not change its speed are left out.
    """
    first = signals.time < signals.time[0] + 0.5 * WINDOW * ENOUGH
    values = {name: each[first] for name, each in signals.values.items()}
    interval, values = thinned(replace(signals, time=signals.time[first], values=values))
    count = round(WINDOW / interval)
    if len(next(iter(values.values()))) < count:
        return np.empty((len(turns), 0))
    speeds = np.array([windows(values[f"wheel_speed_{place}_rad_per_s"], count) for place in PLACES])
    moves = (speeds > 0.5 * speeds.mean(axis=2, keepdims=True)) & (np.ptp(speeds, axis=2, keepdims=True) > 0.0)
    speeds = speeds[:, moves.all(axis=(0, 2))]
    uneven = signal.detrend(speeds / speeds.mean(axis=2, keepdims=True)) * signal.windows.hann(count, sym=False)
    angle = np.cumsum(speeds, axis=2) * interval
    above = np.zeros((len(turns), speeds.shape[1]))
    for i, share in enumerate(turns):
        for order in ORDERS:
            around = np.abs(np.fft.fft(uneven * np.exp(-1j * order * share * angle))) ** 2
            beside = around[:, :, [*BESIDE, *(-step for step in BESIDE)]].mean(axis=2)
            above[i] += np.log(around[:, :, 0] / beside).mean(axis=0) / len(ORDERS)
    return above


def check_length(some: Spectra) -> None:
    """Raise InputError where fewer than LEAST windows are usable."""
    if len(some) >= LEAST:
        return
    left = [f"{count} {reason}" for reason, count in some.left_out.items() if count]
    why = f" ({', '.join(left)})" if left else ""
    slow = 2 * next(iter(some.left_out.values()), 0) > some.all_windows  # the first reason is the speed
    raise InputError(
        f"drive too short: {counted(len(some), 'usable window')} of {WINDOW:g} s among {some.all_windows}{why}: "
        f"must be at least {LEAST}, which are {0.5 * WINDOW * (LEAST + 1):g} s of rolling straight"
        + (". Are the wheel speeds rad/s?" if slow else "")
    )


def check_road(some: Spectra) -> None:
    """Raise InputError where front and rear wheels do not show one road, or show it at another speed."""
    shared = {sensor: coherence(some, sensor) for sensor in some.sensors}
    if max(shared.values()) < LEAST_COHERENCE and max(swing(some, sensor) for sensor in some.sensors) < LEAST_SWING:
        raise InputError(
            f"drive too smooth: front and rear wheels share {shared['speed']:.2f} of what they show at wheel hop (coherence "
            f"of {HOP[0]:g} to {HOP[1]:g} Hz): must be at least {LEAST_COHERENCE:g}; drive over a rougher road"
        )
    factor = followed(some)
    if not 1.0 / GROSS < factor < GROSS:
        raise InputError(
            f"wheel speeds: the rear wheels run over the road {some.delay.mean() / factor:.3g} s after the front wheels, "
            f"at this speed it must be about {some.delay.mean():.3g} s: another unit than rad/s, or another wheelbase"
        )


def check_order(found: Links, signals: Signals) -> None:
    """Raise InputError where the channels of wheels are likelier in another order than their names say."""
    as_named = (AS_NAMED,) * len(found.followed)
    if better := likelier(found):
        better = fewest_moved([each for each in better if not turned(signals, each[0])] or better)
        shares = [found.share(orders) for orders in (as_named, better[0])]
        raise InputError(
            f"exchanged wheels: {'; or '.join(map(in_words, better))}. What belongs together shares {shares[0]:.2f} of its "
            f"power as named, {shares[1]:.2f} so"
        )
    if axles := turned(signals):
        order = list(AS_NAMED)
        for left, right in axles:
            order[left], order[right] = right, left
        raise InputError(
            f"exchanged wheels: {in_words([tuple(order)] * len(as_named))}; or yaw_rate_rad_per_s has the other sign: in a "
            "left turn the right wheels must turn faster"
        )


def in_words(orders: Sequence[Order]) -> str:
    """Which channels show another wheel than their names say."""
    return ", ".join(
        f"{channel_name(sensor, PLACES[i])} shows the {NAMES[PLACES[k]]}"
        for sensor, order in zip(SENSORS, orders, strict=False)
        for i, k in sorted(zip(order, AS_NAMED, strict=True))
        if i != k
    )


def check_same_wheel(some: Spectra, found: Links) -> None:
    """Raise InputError where a wheel's acceleration and speed are unrelated: the sensor of another car, or another clock.

    Both must show the road: else nothing is said.
    """
    if found.together is None or min(coherence(some, sensor) for sensor in SENSORS) < LEAST_COHERENCE:
        return
    least = limit(1, len(PLACES))
    for place, related in zip(PLACES, np.diag(found.together), strict=True):
        if related <= least:
            speed, accel = (channel_name(sensor, place) for sensor in SENSORS)
            raise InputError(
                f"{accel}: unrelated to {speed}; log likelihood {related:.0f} that both are of one wheel, must be above "
                f"{least:.0f}: another car's, or its clock is another"
            )


def followed(some: Spectra) -> float:
    """At how many times the speed the rear wheels follow the front ones; 1 where none is clear.

    The cross density, each frequency weighted by its coherence, is largest for the right delay (generalised correlation).
    Another delay than a likely one must explain twice as much, as the resonances of unequal wheels turn the phase as well.
    """
    some = taken(some, slice(0, ENOUGH))
    total = np.zeros(len(FACTORS), dtype=complex)
    for side in "lr":
        front, rear = (some.amplitude[f"speed_{end}{side}"] for end in "fr")
        over = np.sqrt(density(front) * density(rear))
        there = within(some.frequency, (BETWEEN[0], HOP[1])) & np.isfinite(over)
        for i, factor in enumerate(FACTORS):
            shared = cross(front[:, there], rear[:, there], some.frequency[there], some.delay / factor)
            total[i] += np.mean(shared / over[there]) / 2.0
    power = np.abs(total) ** 2
    likely = (FACTORS > 1.0 / GROSS) & (FACTORS < GROSS)
    best = int(np.argmax(power))
    return float(FACTORS[best]) if power[best] > max(LEAST_COHERENCE, 2.0 * power[likely].max()) else 1.0
