"""What a user should know about the records behind an identified parameter set."""

from collections.abc import Sequence

from twintube.common.readable import amount
from twintube.dampers import Damper
from twintube.data import LoadedDataset
from twintube.data.records.signs import AS_STATED, SIGNS, TURNED, errors
from twintube.engine.simulate import simulate
from twintube.fitting.harmonic import Harmonic
from twintube.fitting.prediction import state

EQUAL_SPEEDS = 1.03  # velocities of sines, free of noise, that differ by a smaller factor are taken for equal
NOISY = 0.02  # of the length over which friction builds up: a quarter of it changes the friction by some 5 %
SINGLE = (
    "a single harmonic record: friction, gas spring and F-v curve are hardly told apart, and nothing is left to check "
    "the result against; measure at least three velocities, five to hold some out"
)


def reach(measured: Sequence[Harmonic]) -> float:
    """Largest velocity [m/s] of the records behind the F-v curve, 0 without any."""
    return max((h.top_speed for h in measured), default=0.0)


def continuation(damper: Damper, measured: Sequence[Harmonic]) -> list[str]:
    """A remark on the F-v curve beyond the measured velocities."""
    top, last = reach(measured), max(damper.parameters.v_re[-1], damper.parameters.v_co[-1])
    if top == 0.0 or last <= EQUAL_SPEEDS * top:
        return []
    return [
        f"the F-v curve was measured up to {top:.3g} m/s; identified.toml goes on to {last:.3g} m/s by the last "
        "slope, which nothing confirms"
    ]


def noisy(damper: Damper, sines: Sequence[Harmonic]) -> list[str]:
    """A remark on strokes whose noise would change the friction."""
    worst = max(sines, key=lambda h: h.stroke_noise)
    length = damper.parameters.F_FrS / damper.parameters.sigma_0
    if worst.stroke_noise <= NOISY * length:
        return []
    return [
        f"noise of {amount(1e6 * worst.stroke_noise, 'µm')} in the stroke ({worst.name}) was taken out: friction builds up "
        f"over {amount(1e6 * length, 'µm')} and would count it as reversals; the validation also says the error over the "
        "recorded stroke"
    ]


def signs(dataset: LoadedDataset, sines: Sequence[Harmonic]) -> list[str]:
    """A remark where both channels seem to have the other sign: as on reading, else by simulations of all states."""
    found = [finding.message for finding in dataset.findings if finding.column == SIGNS]
    if found:
        return found
    told = []
    for h in sines:
        damper, used = state(dataset.damper, h.oil_level, h.gas_preload, h.gas_pressure), h.counts(slice(None))
        stated, mirrored = (simulate(damper, side * h.stroke, side * h.velocity, h.time).force for side in (1.0, -1.0))
        told.append(errors(h.force[used], stated[used], mirrored[used]).told)
    if TURNED not in told or AS_STATED in told:
        return []
    return [
        f"{dataset.damper.name} explains the records only with stroke and force both turned: unless this damper is stronger "
        "in compression than in rebound, set force_sign = -1 and stroke_sign = -1 in dataset.toml, or leave both out there"
    ]
