"""Records prepared for comparison: what is thinned, what is compared, and what was before."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from twintube.core.checks import KELVIN, tube_limit
from twintube.data import LoadedDataset, Record
from twintube.data.check.defects import resolution
from twintube.diagnosis.records.noise import noise
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.records.thinning import thin
from twintube.diagnosis.rules import RULES
from twintube.engine.simulate import checked
from twintube.fitting.intervals import impulse, means
from twintube.fitting.strokes import noise as noise_of_stroke
from twintube.fitting.strokes import quiet


def prepare(dataset: LoadedDataset) -> list[PreparedRecord]:
    """All records of a dataset; raises InputError where a stroke leaves the tube."""
    begins = [x for x in (beginning_temperature(record) for record in dataset.records) if x is not None]
    usual = float(np.median(begins)) if begins else dataset.damper.parameters.T_curve - KELVIN
    ready = [prepared(record, tube_limit(dataset.damper.parameters), usual) for record in dataset.records]
    before = np.cumsum([0.0, *(np.ptp(record.time) for record in ready[:-1])])
    return [replace(record, before=float(past)) for record, past in zip(ready, before, strict=True)]


def beginning_temperature(record: Record) -> float | None:
    """Temperature [degC] at the beginning of a record, where known."""
    return float(record.temperature[0]) if record.temperature is not None else record.start_temperature


def prepared(record: Record, limit: float, usual: float) -> PreparedRecord:
    """A record prepared; `usual` [degC] is its temperature where it says none.

    Raises InputError where its stroke exceeds `limit` [m].
    """
    at, cycle, stretch = thin(record)
    path = CubicSpline(record.time, quiet(record.time, record.stroke))
    stroke, velocity = path(record.time[at]), path(record.time[at], 1)
    checked(stroke, velocity, limit)
    peak = float(np.quantile(np.abs(record.force), RULES.peak_quantile))
    top_speed = float(np.quantile(np.abs(velocity), RULES.speed_quantile))
    force = means(record.time[at], impulse(record.time, record.force)[at])
    levels = resolution(record.force)
    # What nobody knows is sought; full until then.
    oil_level = 1.0 if record.oil_level is None else record.oil_level
    gas_preload = 1.0 if record.gas_preload is None else float(record.gas_preload)
    begin = beginning_temperature(record)
    along = record.temperature[at] if record.temperature is not None else np.full(len(at), usual if begin is None else begin)
    ready = PreparedRecord(
        name=record.name, measurement=record.measurement, oil_level=oil_level, gas_preload=gas_preload,
        top_speed=top_speed, path=path, stroke_noise=noise_of_stroke(record.stroke)[0],
        force=np.concatenate([record.force[:1], force]),
        time=record.time[at], stroke=stroke, velocity=velocity, cycle=cycle, noise=np.zeros(len(at)),
        peak=peak, resolution=levels[0] if levels else 0.0, period=float(np.median(np.diff(record.time))),
        samples=np.zeros(len(at), dtype=np.int64),
        judged=comparable(record, at, stretch), edges=np.zeros(len(at)),
        kelvins=KELVIN + along, gas_pressure=record.gas_pressure if gas_preload else None,
    )  # fmt: skip
    held = np.maximum(1, np.diff(at, prepend=at[0] - 1))  # measured samples per interval
    ready = replace(ready, samples=held)
    return replace(ready, noise=noise(ready, ready.force))


def comparable(record: Record, at: NDArray[np.int64], stretch: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Intervals (n,) that hold usable samples only and no rest; the first sample has no interval before it."""
    bad = np.concatenate([[0], np.cumsum(~record.usable)])
    whole = np.diff(bad[at + 1], prepend=bad[at[0]]) == 0
    moving = np.diff(stretch, prepend=-1) == 0
    moving[0] = False
    # At rest friction holds whatever force it stopped with.
    way = np.abs(np.diff(record.stroke[at], prepend=record.stroke[at[0]]))
    still = (way < RULES.still * np.ptp(record.stroke)).astype(np.int8)
    resting = maximum_filter1d(minimum_filter1d(still, RULES.still_run), RULES.still_run).astype(bool)
    usable = np.asarray(whole & moving & ~resting)
    kicked = np.zeros(len(at), dtype=bool) if record.measurement == "stochastic" else kicks(record, at)
    calm = usable & ~kicked
    return calm if calm.sum() > RULES.kicked_most * usable.sum() else usable


def kicks(record: Record, at: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Intervals (n,) from where a rig changes its speed at once to the next reversal: between samples anything happened."""
    way, span = np.diff(record.stroke[at]), np.maximum(np.diff(record.time[at]), 1e-9)
    speed = np.abs(way) / span
    changes = np.abs(np.diff(speed, prepend=speed[0]))
    # With few samples per oscillation every change is large.
    change = changes > max(RULES.kick * float(speed.max()), RULES.kick_usual * float(np.quantile(changes, 0.9)))
    turned = np.diff(np.sign(way), prepend=np.sign(way[0])) != 0
    # The number of the latest kick lies behind that of the latest reversal.
    number = np.arange(len(way))
    latest = [np.maximum.accumulate(np.where(some, number, -1)) for some in (change, turned & ~change)]
    kicked = (latest[0] >= 0) & (latest[0] >= latest[1])
    return np.concatenate([[False], kicked | np.append(kicked[1:], False)])
