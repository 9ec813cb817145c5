"""From the records of the benches to the figures of the methods."""

import numpy as np

from twintube.common.arrays import Array
from twintube.inspection.plate import Cycles, Motion, cycles

ABOVE_BODY = 2.0  # [Hz] bodies of cars swing at 1 to 1.6 Hz
LARGEST_SHARE = 2.0  # of the wheel's resonance
# Other readings of the window between the resonances: lower end [Hz], below the wheel's resonance where it is negative;
# upper end as a share of that resonance, or in Hz where it is above LARGEST_SHARE. 6 and 18 Hz and 5 Hz below the resonance
# are the MinCalcFreq, MaxCalcFreq and DeltaF of SPECSUS2018 in two public programs (donfreerk/shock_tester,
# 0wojtaszek0/Modele-inzynieryjne); how the standard joins them is not public.
WINDOWS = {
    "2 Hz to the wheel": (ABOVE_BODY, 1.0),
    "3 Hz to the wheel": (3.0, 1.0),
    "5 Hz to the wheel": (5.0, 1.0),
    "2 Hz to 0.8 of the wheel": (ABOVE_BODY, 0.8),
    "2 Hz to 1.2 of the wheel": (ABOVE_BODY, 1.2),
    "6 Hz to 18 Hz": (6.0, 18.0),
    "5 Hz below the wheel to the wheel": (-5.0, 1.0),
}
READING = "2 Hz to the wheel"
AROUND_WHEEL = (0.6, 1.6)  # of its resonance: cycles to which the single mass is fitted
LEAST_SWING = 1e-4  # [m] a swing that is not seen


def eusama(run: Motion, force: Array, static: float) -> float:
    """100 times the smallest plate force (n,) [N] of the coast over the static force [N]."""
    return 100.0 * max(0.0, float(force[run.coasting].min())) / static


def phase_shift(measured: Cycles, window: str = READING) -> float:
    """Smallest phase [deg] of the cycles in a window of WINDOWS, not below 0; where no cycle is, that of the next one.

    Where the wheel leaves the plate the force has other harmonics, and its first one may lag.
    """
    low, high = WINDOWS[window]
    low = low if low > 0.0 else measured.wheel_frequency + low
    end = high if high > LARGEST_SHARE else high * measured.wheel_frequency
    inside = (measured.frequency >= low) & (measured.frequency <= end)
    inside[np.argmin(np.abs(measured.frequency - low))] |= not inside.any()
    return max(0.0, float(measured.phase[inside].min()))


def damping_ratio(measured: Cycles) -> float:
    """Lehr's damping ratio of the wheel, by a fit of a single mass between plate and body to the cycles.

    With s = j omega the body stands still above its own resonance, and the force over the plate's height is

        (k_t + d_t s) (s^2 + b s + c) / (s^2 + B s + A),   damping ratio B / (2 sqrt(A)).

    Multiplied by its denominator the equation is linear in A, B and the coefficients of its numerator; real and imaginary
    parts of all cycles give them by least squares.
    """
    low, high = (share * measured.wheel_frequency for share in AROUND_WHEEL)
    near = (measured.frequency >= low) & (measured.frequency <= high)
    # In units of the resonance and of the largest force all coefficients are of the order of 1.
    s = 1j * measured.frequency[near] / measured.wheel_frequency
    answer = measured.answer[near] / np.abs(measured.answer).max()
    columns = np.stack([answer, answer * s, -np.ones_like(s), -s, -(s**2), -(s**3)], axis=1)
    known = -answer * s**2
    matrix = np.concatenate([columns.real, columns.imag])
    fitted = np.linalg.lstsq(matrix, np.concatenate([known.real, known.imag]), rcond=None)[0]
    A, B = float(fitted[0]), float(fitted[1])
    return max(0.0, B / (2.0 * A**0.5)) if A > 0.0 else 0.0


def push_down(body: Array, released: int) -> float:
    """Logarithmic decrement per cycle of the body's height (n,) [m] after its release at sample `released`.

    The first swing beyond rest is half a cycle after the release, so that the decrement is twice the logarithm of the push
    over that swing. A swing below LEAST_SWING counts as that; one beyond the push, as an undamped body's may be, as the
    push. Rest is the mean of the last tenth.
    """
    rest = float(body[-len(body) // 10 :].mean())
    swing = max(LEAST_SWING, float(body[released:].max()) - rest)
    return 2.0 * max(0.0, float(np.log(max(rest - float(body[released]), LEAST_SWING) / swing)))


def bump(acceleration: Array) -> float:
    """Root mean square [m/s2] of the axle's vertical acceleration (n,)."""
    return float(np.sqrt(np.mean(acceleration**2)))


def measured_cycles(run: Motion, force: Array, phase_error: float = 0.0) -> Cycles:
    """The cycles of a plate force (n,) [N] with the `phase_error` [deg] of the tester."""
    exact = cycles(run, force)
    return Cycles(exact.frequency, exact.answer * np.exp(1j * np.radians(phase_error)))
