"""One case of a study: a pure function of the study and the case's number."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array
from twintube.core import kernel
from twintube.core.variables import Derived, blank
from twintube.dampers import Damper
from twintube.dampers.variants import NO_CAVITATION, NO_FOAM
from twintube.engine.simulate import InputError, simulate_quietly
from twintube.provenance import fingerprint
from twintube.rig.signals import AMPLITUDE, PRECONDITIONING, V_PRECONDITIONING, harmonic_block, oscillations
from twintube.studies.definition import FIELDS, Signal, Study, StudyCase, StudyError
from twintube.version import __version__

RESULTS = ("work_J", "work_relative", "peak_rebound_N", "peak_compression_N")


def version_mark() -> str:
    """Version and fingerprint of the sources: the results depend on them and on the study only."""
    return f"{__version__} {fingerprint(__name__)}"


def chunk(study: Study, start: int, stop: int, expected: str) -> Array:
    """Results of the cases from `start` to before `stop`, one row per case and oscillation; columns as in `RESULTS`.

    Raises StudyError if a case fails, or if the version mark of this process is not `expected`.
    """
    if version_mark() != expected:
        raise StudyError(
            f"a worker has twintube {version_mark()}, this is twintube {expected}: install the same version on both"
        )
    return np.concatenate([results(study, number) for number in range(start, stop)])


def results(study: Study, number: int) -> Array:
    """The rows of one case; raises StudyError."""
    case = study.case(number)
    try:
        intact = reference(study, case.damper, case.signal, case.values)
        table = oscillation_results(study, state(study, case), study.signals[case.signal], study.rows(case))
    except (InputError, ValueError) as error:
        raise StudyError(f"case {number} ({study.dampers[case.damper].name}, {case}): {error}") from error
    relative = table[:, :1] / intact if intact > 0.0 else np.full((len(table), 1), np.nan)
    return np.hstack([table[:, :1], relative, table[:, 1:]])


@lru_cache(maxsize=4096)
def reference(study: Study, damper: int, signal: int, values: tuple[float, ...]) -> float:
    """Work [J] of the first oscillation of the intact damper with the same parameters."""
    intact = state(study, StudyCase(damper, signal, values, oil_level=1.0, gas_preload=1, variant=4))
    return float(oscillation_results(study, intact, study.signals[signal], (1,))[0, 0])


def state(study: Study, case: StudyCase) -> Damper:
    """The damper of a case, with the model variants of Section 3.4 of the paper.

    1. A scalar factor: the oil level times the fluid force of the intact damper; friction and gas force are those of
       the degraded state.
    2. The basic model without foam and cavitation.
    3. With foam.
    4. The complete model.

    Parameters that a variant sets to 0 stay 0 if the study varies them.
    """
    changes = {FIELDS[name].name: value for name, value in zip(study.parameters, case.values, strict=True)}
    if case.variant == 1:
        return scaled(study.dampers[case.damper].with_(**changes), case.oil_level, case.gas_preload)
    if case.variant == 2:
        changes |= NO_FOAM
    if case.variant in (2, 3):
        changes |= NO_CAVITATION
    return study.dampers[case.damper].with_(**changes, oil_level=case.oil_level, gas_preload=case.gas_preload)


def scaled(damper: Damper, factor: float, gas_preload: float) -> Damper:
    """The intact damper with the F-v curve times `factor`, and friction and gas force of the degraded state."""
    degraded = damper.with_(oil_level=factor, gas_preload=gas_preload).parameters
    d = blank(Derived)
    kernel.prepare(degraded, d)
    return damper.with_(
        oil_level=1.0,
        gas_preload=1,
        F_re=[factor * force for force in degraded.F_re],
        F_co=[factor * force for force in degraded.F_co],
        F_FrS=d.F_FrS,
        F_0=d.F_0,
        c_gas=d.c_gas,
    )


def excitation(study: Study, signal: Signal) -> tuple[Array, Array, Array, NDArray[np.int64]]:
    """Time [s], stroke [m], velocity [m/s] and the samples of the oscillations' bounds; a record is one oscillation."""
    if not signal.stroke.size:
        block = harmonic_block(signal.velocity, signal.amplitude, study.time_step)
        return block.time, block.stroke, block.velocity, block.marks
    t, z, v = oscillations(V_PRECONDITIONING, AMPLITUDE, PRECONDITIONING, 2e-3)
    stroke, velocity = np.concatenate([z, signal.stroke]), np.concatenate([v, signal.speed])
    time = np.concatenate([t, t[-1] + 2e-3 + signal.time - signal.time[0]])
    return time, stroke, velocity, np.array([len(z), len(stroke) - 1])


def oscillation_results(study: Study, damper: Damper, signal: Signal, counted: tuple[int, ...]) -> Array:
    """Work [J], peak force in rebound and in compression [N] (negative) of the oscillations `counted` from 1."""
    time, stroke, velocity, marks = excitation(study, signal)
    end = int(marks[counted[-1]]) + 1
    run = simulate_quietly(damper, stroke[:end], velocity[:end], time[:end])
    rows = []
    for number in counted:
        first, last = int(marks[number - 1]), int(marks[number])
        force, v = run.force[first : last + 1], velocity[first : last + 1]
        rows.append(
            (
                run.work[last] - run.work[first],
                np.max(force, where=v > 0, initial=-np.inf),
                np.min(force, where=v < 0, initial=np.inf),
            )
        )
    table = np.array(rows)
    table[np.isinf(table)] = np.nan  # a record that moves in one direction only
    return table
