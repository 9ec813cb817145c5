"""What a chassis engineer reads in the signals of a drive, about a minute at a time.

Of each wheel: power at wheel hop over that between the resonances, power at the body's resonance over the same, the damping
ratio of wheel hop, and wheel hop against the other wheel of its axle and against the wheel that runs over the same road.
All are ratios of one sensor's powers, as logarithms: neither the unit nor the amplification of a sensor matters.
"""

from collections.abc import Mapping
from typing import Final

import numpy as np

from twintube.common.arrays import Array
from twintube.driving.air import cold
from twintube.driving.channels import PLACES
from twintube.driving.physical import wheel_hop
from twintube.driving.signals import Signals
from twintube.driving.spectra import BETWEEN, BODY, HOP, WINDOW, Spectra, coherence, cross, density, spectra, taken, within

MINUTE: Final = round(60.0 / (0.5 * WINDOW)) - 1  # windows, each half over the next
LEAST: Final = 10  # windows: the power at wheel hop then scatters by 8 %, 1 over the root of 19 frequencies and 8 windows
OF_A_WHEEL: Final = {
    "hop": "power at wheel hop over that between the resonances",
    "body": "power at the body's resonance over that between the resonances",
    "damping": "damping ratio of wheel hop",
    "side": "power at wheel hop over that of the other wheel of the axle",
    "axle": "wheel hop over that of the wheel of the other axle on the same road",
}
OF_THE_BODY: Final = {
    "body_bounce": "power of the body at its resonance over that between the resonances",
    "body_hop": "power of the body at wheel hop over that between the resonances",
}
# Logarithms: speed over 1 m/s, power of the road that the wheels show, force of cold oil; the last where the air is known.
CONDITIONS: Final = ("speed", "level", "cold")


def band_power(frequency: Array, power: Array, band: tuple[float, float]) -> float:
    """Logarithm of the mean density in a band, over the frequencies that are there."""
    return float(np.log(np.nanmean(power[within(frequency, band)])))


def of_a_minute(some: Spectra) -> dict[str, float]:
    """The features of some windows, and under which CONDITIONS they were driven."""
    f = some.frequency
    row = {"speed": float(np.mean(np.log(some.speed)))}
    if np.isfinite(some.air).all():
        row["cold"] = cold(float(np.mean(some.air)))
    for sensor in some.sensors:
        each = {place: some.amplitude[f"{sensor}_{place}"] for place in PLACES}
        power = {place: density(x) for place, x in each.items()}
        hop, middle, body = ({place: band_power(f, power[place], band) for place in PLACES} for band in (HOP, BETWEEN, BODY))
        row[f"{sensor}_coherence"] = coherence(some, sensor)
        if sensor == "speed":
            row["level"] = float(np.median(list(middle.values())))
        for place in PLACES:
            side = place[0] + ("r" if place[1] == "l" else "l")
            row[f"{sensor}_hop_{place}"] = hop[place] - middle[place]
            row[f"{sensor}_body_{place}"] = body[place] - middle[place]
            row[f"{sensor}_damping_{place}"] = float(np.log(wheel_hop(f, power[place])[1]))
            row[f"{sensor}_side_{place}"] = hop[place] - hop[side]
        for side in "lr":
            same = cross(each[f"f{side}"], each[f"r{side}"], f, some.delay)
            # What both wheels have of the road alone: noise of either sensor has no part in it.
            shared = float(np.log(np.abs(np.nanmean(same[within(f, HOP)]))))
            row[f"{sensor}_axle_r{side}"] = shared - hop[f"f{side}"]
            row[f"{sensor}_axle_f{side}"] = shared - hop[f"r{side}"]
    if "body" in some.amplitude:
        power_z = density(some.amplitude["body"])
        middle_z = band_power(f, power_z, BETWEEN)
        row["body_bounce"] = band_power(f, power_z, BODY) - middle_z
        row["body_hop"] = band_power(f, power_z, HOP) - middle_z
    return row


def minutes(some: Spectra) -> list[dict[str, float]]:
    """The features of each MINUTE usable windows; a rest of fewer than LEAST belongs to the minute before."""
    starts = list(range(0, max(1, len(some) - LEAST + 1), MINUTE))
    ends = [*starts[1:], len(some)]
    rows = []
    for start, end in zip(starts, ends, strict=True):
        part = taken(some, slice(start, end))
        rows.append({"start_s": float(part.start[0]), "windows": float(len(part)), **of_a_minute(part)})
    return rows


def table(signals: Signals) -> list[dict[str, float]]:
    """The features of a drive, a row for each minute; raises InputError for signals that give none."""
    some = spectra(signals)
    return minutes(some) if len(some) else []


def mean_of(rows: list[dict[str, float]]) -> dict[str, float]:
    """Means over minutes."""
    return {name: float(np.nanmean([row[name] for row in rows])) for name in rows[0]} if rows else {}


def of_the_damper(row: Mapping[str, float], place: str) -> dict[str, float]:
    """The features that speak of one damper, without its place in their names."""
    found = {name[: -len(place) - 1]: value for name, value in row.items() if name.endswith(f"_{place}")}
    return found | {name: row[name] for name in OF_THE_BODY if name in row}
