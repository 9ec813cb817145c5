"""Whether stroke and force both have the other sign, which the work of a damper does not show.

With both turned the force over the velocity is mirrored at the origin: what differs between rebound and compression, and
the gas that pushes the rod out, change their sides; all else stays. So a model of the damper tells it, if it has a
difference to tell it by.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from twintube.common.arrays import Array
from twintube.common.words import listed
from twintube.dampers import Damper
from twintube.dampers.gas_spring import gas_force
from twintube.data.dataset_toml.manifest import Entry
from twintube.data.findings import Notes
from twintube.data.records.condition import is_intact
from twintube.data.records.record import Record

SIGNS = "force_sign"  # the key by which its finding is known
AS_STATED, UNTOLD, TURNED, PULLED = "as stated", "", "turned", "pulled in"  # pulled in: turned, or a zero of the load cell
PULLS_IN = "a constant force pulls the rod in"  # how the warning begins where a zero of the load cell would do as well
MOST = 20_000  # samples of a record that are looked at, evenly spread
REST = 1.0  # [s] without motion: the fluid force has died away
STILL = 0.004  # of the stroke's range, as in fitting/oscillations.py


@dataclass(frozen=True)
class Errors:
    """Squared errors of a model, relative to the square of the force."""

    stated: float  # with the signs as stated
    shifted: float  # the same beside a constant, as a zero of the load cell is
    turned: float  # with both channels turned
    symmetric: float  # as a damper without differences between its sides

    @property
    def told(self) -> str:
        """The side that leaves away most of the error of the other.

        It must also leave less than the damper without its differences does: one of another curve, or a worn one, has less
        of them or others, and is explained by neither.
        """
        if self.turned < min(self.symmetric, self.stated / 2):
            return TURNED if self.turned < self.shifted / 2 else PULLED
        return AS_STATED if self.stated < min(self.symmetric, self.turned / 2) else UNTOLD


def errors(force: Array, stated: Array, mirrored: Array) -> Errors:
    """Of a measured force (n,) against that of a model: as stated, and under stroke and velocity of the other sign."""
    size = max(float(np.mean(force**2)), float(np.finfo(float).tiny))
    left = force - stated
    several = left, left - left.mean(), force + mirrored, force - (stated - mirrored) / 2
    one, shifted, other, none = (float(np.mean(some**2)) / size for some in several)
    return Errors(one, shifted, other, none)


def quasi_steady(damper: Damper, stroke: Array, velocity: Array, gas: float) -> Array:
    """Force (n,) [N] of the intact damper by its F-v curve, saturated friction and a gas force [N] at stroke 0."""
    p = damper.parameters
    rebound, compression = (curve(side * velocity, v, F) for side, v, F in ((1, p.v_re, p.F_re), (-1, p.v_co, p.F_co)))
    scaling = p.k_high + (1.0 - p.k_high) * np.exp(-np.abs(velocity) / p.v_S)
    return rebound - compression + np.sign(velocity) * scaling * p.F_FrS + p.c_gas * stroke - gas


def curve(velocity: Array, points: Sequence[float], forces: Sequence[float]) -> Array:
    """A branch (n,) of the F-v curve, 0 below 0; the last segment goes on."""
    slope = (forces[-1] - forces[-2]) / (points[-1] - points[-2])
    beyond = slope * np.maximum(velocity - points[-1], 0.0)
    return np.asarray(np.interp(velocity, [0.0, *points], [0.0, *forces]) + beyond)


def told_by(damper: Damper, record: Record) -> str:
    """What a record with gas preload tells: by its force over the velocity, else by that at rest.

    Without some of its oil the damper has another F-v curve; then only motion so slow that the gas is most of what differs
    between the sides tells anything.
    """
    p = damper.parameters
    level = 0.0 if record.oil_level is None else record.oil_level  # unknown: the one with most friction, which hides most
    gas = gas_force(damper, record.gas_pressure)
    some = np.flatnonzero(record.usable)[:: 1 + len(record.time) // MOST]
    if not len(some):
        return UNTOLD
    z, v, force = (values[some] for values in (record.stroke, record.velocity, record.force))
    stated, mirrored = quasi_steady(damper, z, v, gas), quasi_steady(damper, -z, -v, gas)
    slow = bool(np.sqrt(np.mean(((stated + mirrored) / 2 + gas) ** 2)) <= gas)
    told = errors(force, stated, mirrored).told if slow or is_intact(level, True) else UNTOLD
    if told == PULLED and not slow:
        told = UNTOLD  # the constant is not that of the gas, but of a curve that is another one
    friction = p.F_FrS * (1.0 + p.oil_loss_gain * (1.0 - level))
    return told or at_rest(record.time[some], z, force - p.c_gas * z, gas, friction)


def at_rest(time: Array, stroke: Array, force: Array, gas: float, friction: float) -> str:
    """What the mean force (n,) [N] at rest tells of one of the gas [N]; friction [N], of either sign there, can hide it.

    Of the zero that the load cell would need one side asks for three times as much as the other, as `Errors` does.
    """
    window = int(REST / max(float(np.median(np.diff(time))), 1e-9)) // 2 * 2 + 1 if len(time) > 1 else 0
    if not 3 <= window < len(time):
        return UNTOLD
    still = maximum_filter1d(stroke, window) - minimum_filter1d(stroke, window) < STILL * np.ptp(stroke)
    if not still.any():
        return UNTOLD
    pulls = float(np.mean(force[still]))
    if abs(pulls) - friction <= gas / 2 or gas == 0.0:
        return UNTOLD
    return PULLED if pulls > 0.0 else AS_STATED


def check_signs(entries: Sequence[Entry], records: Sequence[Record], damper: Damper, notes: Notes) -> None:
    """A warning with the keys to set where records with gas preload are explained only with both channels turned."""
    told = {r.file: told_by(damper, r) for r in records if r.gas_preload == 1.0}
    turned, pulled = ([entry for entry in entries if told.get(entry.file) == sign] for sign in (TURNED, PULLED))
    right = AS_STATED in told.values()
    wrong = turned if turned and right else turned + pulled
    if not wrong:
        return
    first = wrong[0]
    files = listed((entry.file for entry in wrong), 3)
    keys = f"force_sign = {-first.force_sign} and stroke_sign = {-first.stroke_sign}"
    if turned:
        message = f"stroke and force seem to have the other sign both ({files}): {damper.name} explains them only with both "
        where = " in these records" if right else ""
        message += f"turned; unless this damper is stronger in compression, set {keys}{where}"
    else:
        message = f"{PULLS_IN} ({files}), which no gas does: the load cell has a zero"
        message += "" if right else f", or stroke and force have the other sign both: then set {keys}"
    notes.warning(message, SIGNS, first.line)
