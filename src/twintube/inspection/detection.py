"""How many of the dampers that have lost oil an inspection finds, when 5 % of the intact ones are alarmed."""

import os
from collections.abc import Callable, Iterable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from scipy import stats

from twintube.common.arrays import Array, freeze_arrays
from twintube.common.processes import pool
from twintube.dampers import Damper
from twintube.dampers.freed_gas import DEFAULT
from twintube.engine.simulate import InputError
from twintube.inspection.benches import Setting, read
from twintube.inspection.corner import INTACT, LEAST_FACTOR, Condition, over_intact, relative, under
from twintube.inspection.methods import METHODS, USUAL, Method
from twintube.inspection.plate import Plate
from twintube.inspection.scatter import Sample, samples
from twintube.inspection.tiring import PLATES
from twintube.vehicle.cars import CarSet

FALSE_ALARMS = 0.05
SEEN = 0.9  # detected share from which a method sees a loss
CONFIDENCE = 0.95
FEWEST, MOST = 20, 10_000  # samples: with fewer there is no share of 5 %


@dataclass(frozen=True)
class Detection:
    """What a method says about one state over all samples."""

    damper: str
    method: Method
    condition: Condition
    figures: Array  # (n,) of the state, in the method's unit
    intact: Array  # (n,) of the intact damper in the same cars on the same testers

    def __post_init__(self) -> None:
        """Shared by all who read it."""
        freeze_arrays(self)

    @property
    def threshold(self) -> float:
        """The limit at which at most FALSE_ALARMS of the intact dampers fail."""
        ordered = np.sort(self.intact if self.method.low_fails else -self.intact)
        value = float(ordered[int(FALSE_ALARMS * len(ordered))])
        return value if self.method.low_fails else -value

    @property
    def detected(self) -> int:
        """Number of samples beyond the threshold."""
        beyond = self.figures < self.threshold if self.method.low_fails else self.figures > self.threshold
        return int(np.count_nonzero(beyond))

    @property
    def share(self) -> float:
        """Detected share [1]."""
        return self.detected / len(self.figures)

    @property
    def band(self) -> tuple[float, float]:
        """Interval of the share by the binomial distribution (Clopper and Pearson); the threshold is taken as known."""
        interval = stats.binomtest(self.detected, len(self.figures)).proportion_ci(CONFIDENCE)
        return float(interval.low), float(interval.high)

    @property
    def failed_share(self) -> float:
        """Share [1] that fails at the limit of the method."""
        return float(np.mean([not self.method.passed(float(figure)) for figure in self.figures]))

    @property
    def roc(self) -> tuple[Array, Array]:
        """Share of the intact and of this state that fail, (n,) each, for every limit from strict to lenient."""
        sign = 1.0 if self.method.low_fails else -1.0
        intact, worn = np.sort(sign * self.intact), np.sort(sign * self.figures)
        limits = np.concatenate([[-np.inf], np.unique(np.concatenate([intact, worn]))])
        return tuple(np.searchsorted(x, limits, side="right") / len(x) for x in (intact, worn))  # type: ignore[return-value]

    @property
    def area(self) -> float:
        """Area under the ROC curve: how often this state has the worse figure of a pair [1]."""
        return float(np.trapezoid(self.roc[1], self.roc[0]))

    @property
    def as_json(self) -> dict[str, Any]:
        """For JSON; the ROC curve at some false-alarm rates."""
        rates = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5)
        false_alarms, detected = self.roc
        return {
            "damper": self.damper,
            "method": self.method.name,
            "oil_level": self.condition.oil_level,
            "gas_preload": self.condition.gas_preload,
            "scalar_factor": self.condition.scalar,
            "freed_gas": None if self.condition.scalar else self.condition.freed_gas,
            "samples": len(self.figures),
            "false_alarm_rate": FALSE_ALARMS,
            "limit_at_false_alarm_rate": self.threshold,
            "detected_share": self.share,
            "detected_band": list(self.band),
            "failed_share_at_limit": self.failed_share,
            "roc_area": self.area,
            "roc": {f"{rate:g}": float(detected[false_alarms <= rate].max()) for rate in rates},
        }


@dataclass(frozen=True)
class Job:
    """One damper in one car on one tester."""

    damper: Damper
    sample: Sample
    reference: dict[str, float]  # figures of the intact damper in the nominal car that the others are over


def figures(
    job: Job, vehicle: CarSet, states: tuple[Condition, ...], methods: tuple[str, ...], plates: tuple[Plate, ...]
) -> list[list[float]]:
    """The figures by state and method."""
    rows = []
    car, setting, made = job.sample.corner(job.damper, vehicle), job.sample.setting(plates), job.sample.made(job.damper)
    for state in states:
        # The same noise for every state: what differs is the damper.
        row = relative(read(state.applied(made), car, methods, setting, noise=job.sample.seed), job.reference)
        rows.append([row[name] for name in methods])
    return rows


def check_count(count: int) -> None:
    """Raise InputError for a number of samples outside FEWEST to MOST."""
    if not FEWEST <= count <= MOST:
        raise InputError(f"samples = {count}: must be from {FEWEST} to {MOST}")


def study(  # noqa: PLR0913 - what is studied, and how it is run
    dampers: Sequence[Damper],
    vehicle: CarSet,
    states: Iterable[Condition],
    methods: tuple[str, ...] = USUAL,
    *,
    count: int,
    seed: int = 1,
    ways: Sequence[str] = (DEFAULT,),
    plates: tuple[Plate, ...] = PLATES,
    processes: int | None = None,
    progress: Callable[[], None] = lambda: None,
) -> list[Detection]:
    """The detection of every state under every way, and of the oil level as a scalar factor, over `count` samples.

    `progress` is called after each sample of each damper. `processes` is by default the number of cores; the result does not
    depend on it. `plates` are those of `tiring`. Raises InputError for a number of samples outside FEWEST to MOST.
    """
    check_count(count)
    levels = under(ways[:1], states)
    intact = replace(INTACT, freed_gas=ways[0])
    factors = [replace(s, scalar=True) for s in levels if s.oil_level >= LEAST_FACTOR]
    everything = (intact, *under(ways, levels), *factors)
    drawn = samples(count, seed)
    jobs = []
    for damper in dampers:
        reference = read(intact.applied(damper), vehicle.corner(damper), over_intact(methods), Setting())
        jobs += [Job(damper, sample, reference) for sample in drawn]
    work = partial(figures, vehicle=vehicle, states=everything, methods=methods, plates=plates)
    rows = []
    with ExitStack() as stack:
        workers = min(processes or os.cpu_count() or 1, len(jobs))
        mapped = map(work, jobs) if workers == 1 else stack.enter_context(pool(workers)).map(work, jobs)
        for row in mapped:
            rows.append(row)
            progress()
    values = np.array(rows).reshape(len(dampers), count, len(everything), len(methods))
    return [
        Detection(damper.name, METHODS[name], state, values[i, :, j, k], values[i, :, 0, k])
        for i, damper in enumerate(dampers)
        for k, name in enumerate(methods)
        for j, state in enumerate(everything)
        if j > 0
    ]


def first_seen(
    detections: Iterable[Detection], damper: str, method: str, freed_gas: str = DEFAULT, *, scalar: bool = False
) -> float | None:
    """The highest oil level from which on down the method detects SEEN of the dampers, else None.

    With `scalar`, those with the oil level as a factor; in them no gas is freed.
    """
    here = [
        d
        for d in detections
        if (d.damper, d.method.name, d.condition.scalar) == (damper, method, scalar)
        and (scalar or d.condition.freed_gas == freed_gas)
    ]
    seen = None
    for item in sorted(here, key=lambda d: d.condition.oil_level):
        if item.share < SEEN:
            break
        seen = item.condition.oil_level
    return seen
