"""The intact damper from sines alone, where no quasi-static record tells friction and gas spring apart.

Force = F-v curve + friction + gas spring is linear in all but the stroke over which the friction reverses: bounded least
squares for the linear part inside a search over that length (variable projection).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import qr
from scipy.optimize import lsq_linear, minimize_scalar

from twintube.common.arrays import Array
from twintube.core import effects
from twintube.core.kernel import stribeck
from twintube.dampers import Damper
from twintube.dampers.curve import continued
from twintube.engine.simulate import InputError
from twintube.fitting.averaging import averaged
from twintube.fitting.harmonic import Harmonic
from twintube.identification.intact_intervals import covariance, of_sines
from twintube.identification.uncertainty import Estimate

KNOTS = 8  # of each branch, spaced evenly in the logarithm
SLOWEST = 0.05  # first knot as a share of the largest velocity
REVERSAL = (1e-6, 5e-3)  # [m] length over which the friction reverses, F_FrS / sigma_0
LENGTHS = np.log(np.geomspace(*REVERSAL, 16))
MOST = 4000  # samples of a record that the fit takes, evenly spread
NUDGE = 0.05  # of the logarithm of that length, for a derivative
TOUCHING = 1e-9  # from a bound [N, N/m]
FAR_BEYOND = 1.25  # of its upper limit: how far the first estimate of a friction may be off
RISING = 1e-3  # smallest rise from knot to knot as a share of the largest force: below it a velocity shows nothing


@dataclass(frozen=True)
class SineFit:
    """The intact damper from sines, and the error of the fit."""

    damper: Damper
    rmse: float  # over the fitted records, all with equal weight [N]
    offset: float  # constant force [N] that pulls the rod in, which no gas does: zero of the load cell, or signs
    estimates: list[Estimate]  # friction and gas spring with their intervals


def saturation(stroke: Array, length: float) -> Array:
    """Dahl's friction (n,) relative to its saturated value: the exact solution of equation 2 for delta_D = 1."""
    way = np.diff(stroke)
    decay = np.exp(-np.abs(way) / length)
    relative = np.empty(len(stroke))
    relative[0] = 0.0
    state = 0.0
    for i, (share, direction) in enumerate(zip(decay.tolist(), np.sign(way).tolist(), strict=True)):
        state = direction + (state - direction) * share if direction else state
        relative[i + 1] = state
    return relative


def ramps(velocity: Array, knots: Array) -> Array:
    """Rise (n, k) from knot to knot of a curve through the origin; the last ramp goes on."""
    edges = np.concatenate([[0.0], knots])
    share = (velocity[:, None] - edges[:-1]) / np.diff(edges)
    share[:, :-1] = np.minimum(share[:, :-1], 1.0)
    rises: Array = np.maximum(share, 0.0)
    return rises


def identify_sines(damper: Damper, records: Sequence[Harmonic]) -> SineFit:
    """The damper with F-v curve, friction and gas spring from harmonic records of the intact damper.

    The Stribeck scaling and delta_D = 1 are not determined by sines and stay. A force channel that was averaged is fitted
    by a model averaged in the way of the channel. Raises InputError without records, and, before any search, where the
    friction is far beyond its range.
    """
    if not records:
        raise InputError("no intact harmonic record to identify from")
    spans = [slice(int(r.marks[0]), int(r.marks[-1]) + 1, 1 + int(r.marks[-1] - r.marks[0]) // MOST) for r in records]
    F = np.concatenate([r.force[s] for r, s in zip(records, spans, strict=True)])

    def seen(columns: Sequence[Array]) -> Array:
        """What the fit takes of the records' columns, as the force channel shows it."""
        several = zip(records, columns, spans, strict=True)
        return np.concatenate([averaged(r.time, column, r.averaged)[s] for r, column, s in several])

    usable = [r.counts(s) for r, s in zip(records, spans, strict=True)]
    weight = np.concatenate([some / np.sqrt(max(1, some.sum())) for some in usable]) / np.sqrt(len(records))
    top = max(r.top_speed for r in records)
    knots = np.geomspace(SLOWEST, 1.0, KNOTS) * top
    scaling = [np.array([stribeck(damper.parameters, float(x)) for x in r.velocity]) for r in records]
    fixed = seen([np.column_stack([ramps(r.velocity, knots), -ramps(-r.velocity, knots), -np.ones_like(r.time), r.stroke])
                  for r in records])  # fmt: skip
    lower = np.concatenate([np.full(2 * KNOTS, RISING * np.abs(F[weight > 0.0]).max() / KNOTS), [-np.inf, 0.0, 0.0]])

    # The orthogonal factor of what does not depend on the length, once.
    Q, R = qr(fixed * weight[:, None], mode="economic")
    known = Q.T @ (F * weight)
    rest = F * weight - Q @ known

    def rubbed(log_length: float) -> Array:
        length = float(np.exp(log_length))
        return seen([saturation(r.stroke, length) * scale for r, scale in zip(records, scaling, strict=True)])

    def solved(log_length: float) -> tuple[float, NDArray[np.float64]]:
        rubbing = rubbed(log_length) * weight
        along = Q.T @ rubbing
        across = rubbing - Q @ along
        size = max(float(np.linalg.norm(across)), 1e-300)
        shown = float(across @ rest) / size
        A = np.block([[R, along[:, None]], [np.zeros((1, R.shape[1])), np.array([[size]])]])
        fit = lsq_linear(A, np.append(known, shown), bounds=(lower, np.inf))
        return float(np.sqrt(max(0.0, 2 * fit.cost + rest @ rest - shown**2))), fit.x

    refuse_friction(float(solved(LENGTHS[len(LENGTHS) // 2])[1][-1]))
    log_length = least(lambda x: solved(x)[0])
    rmse, x = solved(log_length)
    F_0, c_gas, F_FrS = (float(value) for value in x[2 * KNOTS :])
    up, down = (rubbed(log_length + side * NUDGE) for side in (1, -1))
    columns = np.column_stack([fixed, rubbed(log_length), F_FrS * (up - down) / (2 * NUDGE)])
    C = covariance(
        columns, np.where(weight > 0.0, F - columns[:, :-1] @ x, 0.0), weight, np.append(x > lower + TOUCHING, True),
        [(r.marks - r.marks[0]) // (s.step or 1) for r, s in zip(records, spans, strict=True)],
    )[2 * KNOTS :, 2 * KNOTS :]  # fmt: skip
    offset, F_0 = max(0.0, -F_0), max(0.0, F_0)
    sigma_0 = min(1e8, max(1.0, F_FrS / float(np.exp(log_length))))
    values = {"F_FrS": F_FrS, "sigma_0": sigma_0, "F_0": F_0, "c_gas": c_gas}
    fitted = damper.with_(**curve(knots, x[: 2 * KNOTS]), delta_D=1.0, **values)
    return SineFit(fitted, rmse, offset, of_sines(values, C))


def least(error: Callable[[float], float]) -> float:
    """Logarithm of the length of the least error; a coarse scan first, as the error may have more than one valley."""
    best = int(np.argmin([error(x) for x in LENGTHS]))
    ends = LENGTHS[max(0, best - 1)], LENGTHS[min(len(LENGTHS) - 1, best + 1)]
    return float(minimize_scalar(error, bounds=ends, method="bounded").x)


def curve(knots: Array, rises: Array) -> dict[str, list[float]]:
    """The parameters of an F-v curve that rises from knot to knot (k,) [m/s] by forces (2 k,) [N], rebound first."""
    forces = [np.cumsum(branch).tolist() for branch in np.split(rises, 2)]
    rebound, compression = (continued(list(zip(knots.tolist(), branch, strict=True))) for branch in forces)
    return {
        "v_re": [a for a, _ in rebound], "F_re": [b for _, b in rebound],
        "v_co": [a for a, _ in compression], "F_co": [b for _, b in compression],
    }  # fmt: skip


def refuse_friction(F_FrS: float) -> None:
    """Raise InputError where a first estimate of the friction [N] is far beyond its range."""
    upper = float(effects.Parameters.__dataclass_fields__["F_FrS"].metadata["upper"])
    if F_FrS > FAR_BEYOND * upper:
        raise InputError(
            f"the records show a friction of about {F_FrS:.0f} N, friction.F_FrS must be from 0 to {upper:g} N: "
            "a friction damper is not a hydraulic one; if it is none, check the unit of the force"
        )
