"""Step one of the identification: F-v curve, friction and gas spring from records of the intact damper."""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array
from twintube.core.kernel import fluid_force, stribeck
from twintube.core.variables import FV_POINTS
from twintube.dampers import Damper
from twintube.dampers.curve import continued
from twintube.engine.simulate import InputError
from twintube.fitting.harmonic import Harmonic
from twintube.fitting.strokes import direction, turns
from twintube.identification.intact_intervals import scattered
from twintube.identification.uncertainty import Estimate

# The middle of the stroke, in which friction is saturated and no stop is near [share of the largest stroke].
MIDDLE = 0.6
NOISE = 0.01  # of the stroke's range: a reversal is more than that
POINTS = 10  # samples of a line
ACROSS = 0.5  # of that middle, which the parts of a line reach to both sides
MEDIAN = 1.25  # standard error of a median over that of a mean
V_SLOW = 1e-3  # velocity of the quasi-static measurement [m/s]


@dataclass(frozen=True)
class QuasiStatic:
    """Gas spring and friction from the quasi-static record."""

    c_gas: float  # slope of the force over the stroke [N/m]
    F_0: float  # gas force at stroke 0, pushes the rod out [N]
    F_FrS: float  # half the width of the hysteresis at stroke 0 [N]
    sigma_0: float  # slope of the hysteresis at reversal [N/m]
    errors: dict[str, tuple[float, int]]  # standard errors from the scatter of the strokes, with degrees of freedom


def ways(stroke: Array) -> list[slice]:
    """The strokes of one direction between reversals."""
    return [slice(a, b + 1) for a, b in itertools.pairwise(turns(stroke, NOISE * float(np.ptp(stroke)))) if b > a]


def lines(stroke: Array, force: Array, rising: bool) -> tuple[list[NDArray[np.floating]], NDArray[np.floating], int]:
    """Slope [N/m] and height [N] of every full stroke of a direction in the middle of the range.

    Also the squared standard errors of a single line from the scatter about it, and their degrees of freedom. A record of
    a single oscillation that begins in the middle has a direction in two parts: they are a single line.
    """
    reach = MIDDLE * np.abs(stroke).max()
    full, parts = [], [np.zeros(0, dtype=np.int64)]
    for way in ways(stroke):
        z = stroke[way]
        if (z[-1] > z[0]) != rising:
            continue
        # After a start or reversal friction needs a way to be whole.
        inner = np.flatnonzero((np.abs(z) <= reach) & (np.abs(z - z[0]) >= NOISE * np.ptp(stroke))) + way.start
        if np.abs(z).max() >= reach and z.min() < 0 < z.max() and len(inner) >= POINTS:
            full.append(inner)
        parts.append(inner)
    rows = np.concatenate(parts)
    across = len(rows) >= POINTS and stroke[rows].max() >= ACROSS * reach and stroke[rows].min() <= -ACROSS * reach
    several = full or ([rows] if across else [])
    if not several:
        return [], np.zeros(2), 0
    variances = np.diag(np.polyfit(stroke[several[0]], force[several[0]], 1, cov=True)[1])
    return [np.polyfit(stroke[some], force[some], 1) for some in several], variances, len(several[0]) - 2


def quasi_static(stroke: Array, force: Array) -> QuasiStatic:
    """Gas spring and friction from a slow record (n,) [m], [N] (Figure 7).

    Raises InputError where the record has no full stroke in either direction.
    """
    (rising, scatter_up, many), (falling, scatter_down, others) = (lines(stroke, force, way) for way in (True, False))
    if not rising or not falling:
        raise InputError("quasi-static record: no full stroke in both directions")
    up, down = (np.mean(some, axis=0) for some in (rising, falling))
    F_FrS = float(up[1] - down[1]) / 2
    if F_FrS <= 0:
        raise InputError(f"quasi-static record: half the hysteresis is {F_FrS:g} N, it must be above 0; check the signs")
    middle = (up + down) / 2
    counts = [len(some) for some in (rising, falling)]
    free = sum(counts) - 2
    # Pooled over both ways, as each may have few strokes.
    squares = sum(np.sum((np.array(some) - np.mean(some, axis=0)) ** 2, axis=0) for some in (rising, falling))
    slope, height = np.sqrt(squares / max(1, free) * sum(1 / n for n in counts)) / 2
    if free == 0:  # a single line each way
        slope, height = np.sqrt(scatter_up + scatter_down) / 2
        free = many + others
    sigma_0, spread, reversals = reversal_slope(stroke, force, middle, F_FrS)
    errors = {
        "c_gas": (float(slope), free), "F_0": (float(height), free), "F_FrS": (float(height), free),
        "sigma_0": (spread, reversals - 1),
    }  # fmt: skip
    return QuasiStatic(c_gas=float(middle[0]), F_0=float(-middle[1]), F_FrS=F_FrS, sigma_0=sigma_0, errors=errors)


def reversal_slope(stroke: Array, force: Array, line: Array, F_FrS: float) -> tuple[float, float, int]:
    """sigma_0 [N/m] from the stroke after a reversal that the friction needs to change its sign (delta_D = 1).

    Also its standard error and the number of reversals.

    After a reversal F = F_FrS (1 - 2 exp(-sigma_0 x / F_FrS)), which is zero at x = F_FrS ln 2 / sigma_0.
    """
    lengths = []
    for part in ways(stroke)[1:]:  # each begins with a reversal
        z = stroke[part]
        friction = (force[part] - np.polyval(line, z)) * (1.0 if z[-1] > z[0] else -1.0)
        crossed = np.flatnonzero((friction[:-1] < 0) & (friction[1:] >= 0))
        if len(crossed):
            i = int(crossed[0])
            share = -friction[i] / (friction[i + 1] - friction[i])
            lengths.append(abs(z[i] + share * (z[i + 1] - z[i]) - z[0]))
    if not lengths or np.median(lengths) <= 0:
        raise InputError("quasi-static record: the friction reverses within a single interval; sample more densely")
    sigma_0 = float(F_FrS * np.log(2) / np.median(lengths))
    spread = float(np.std(lengths) / np.median(lengths) / np.sqrt(max(1, len(lengths) - 1)))
    return sigma_0, sigma_0 * MEDIAN * spread, len(lengths)


def fv_points(damper: Damper, records: Sequence[Harmonic]) -> tuple[list[tuple[float, float]], list[tuple[float, float]]]:
    """Friction-reduced points (velocity [m/s], force [N]) of rebound and compression at stroke 0 (Figure 3)."""
    p = damper.parameters
    points: dict[bool, list[tuple[float, float]]] = {True: [], False: []}
    for record in records:
        span = slice(int(record.marks[0]), int(record.marks[-1]) + 1)
        z, v, F = record.stroke[span], record.velocity[span], record.force[span]
        for rising in (True, False):
            i = np.flatnonzero((z[:-1] < 0) & (z[1:] >= 0) if rising else (z[:-1] > 0) & (z[1:] <= 0))
            if len(i) == 0:
                low, high = float(z.min()), float(z.max())
                raise InputError(
                    f"{record.name or 'harmonic record'} (up to {record.top_speed:.3g} m/s): its stroke runs from "
                    f"{low:.3g} to {high:.3g} m and never crosses 0, the middle position; set stroke_offset in dataset.toml"
                )
            share = -z[i] / (z[i + 1] - z[i])
            # The median: the first crossing may still be the start from rest.
            speed = float(np.median(v[i] + share * (v[i + 1] - v[i])))
            total = float(np.median(F[i] + share * (F[i + 1] - F[i])))
            friction = stribeck(p, speed) * p.F_FrS * (1.0 if rising else -1.0)
            fluid = total + p.F_0 - friction
            points[rising].append((abs(speed), fluid if rising else -fluid))
    return sorted(points[True]), sorted(points[False])


def identify_intact(
    damper: Damper, slow: tuple[Array, Array] | None, records: Sequence[Harmonic]
) -> tuple[Damper, list[Estimate]]:
    """The damper with F-v curve, friction and gas spring from its intact records, and intervals of the latter.

    `slow` is stroke [m] and force [N] of the quasi-static record; without it friction and gas spring stay. The Stribeck
    scaling stays: these records do not determine it. Raises InputError, and ParameterError where the curve is not monotone.
    """
    if not 2 <= len(records) <= FV_POINTS:
        raise InputError(f"{len(records)} intact harmonic records, from 2 to {FV_POINTS} are needed for the F-v curve")
    if slow is None:
        return with_curve(damper, records), []
    stroke, force = slow
    for _ in range(3):  # the curve needs the friction, the friction the little fluid force at 1 mm/s
        q = quasi_static(stroke, force)
        values = {"c_gas": max(0.0, q.c_gas), "F_0": max(0.0, q.F_0), "F_FrS": q.F_FrS, "sigma_0": q.sigma_0}
        damper = with_curve(damper.with_(**values), records)
        rising = direction(stroke, NOISE * float(np.ptp(stroke)))
        p = damper.parameters
        force = slow[1] - np.where(rising, fluid_force(p, V_SLOW), fluid_force(p, -V_SLOW))
    return damper, scattered(values, q.errors)


def with_curve(damper: Damper, records: Sequence[Harmonic]) -> Damper:
    """The damper with the F-v curve of the records; raises ParameterError where it is not monotone."""
    rebound, compression = (continued(branch) for branch in fv_points(damper, records))
    return damper.with_(
        v_re=[v for v, _ in rebound], F_re=[F for _, F in rebound],
        v_co=[v for v, _ in compression], F_co=[F for _, F in compression],
    )  # fmt: skip
