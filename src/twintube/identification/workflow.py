"""The paper's four-step parameterisation (Section 3.2) as one function, and the intervals of its result."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from twintube.common.arrays import Array
from twintube.common.showing import data_frame
from twintube.core.effects import Parameters
from twintube.dampers import Damper
from twintube.dampers.variants import NO_CAVITATION, NO_FOAM
from twintube.engine.simulate import InputError
from twintube.fitting.harmonic import Harmonic
from twintube.fitting.parameters import DEGRADATION, TABLE_6, TABLES_7_8
from twintube.identification.intact import identify_intact, quasi_static
from twintube.identification.objective import FINE, Objective
from twintube.identification.optimise import DEFAULT, Best
from twintube.identification.sines import identify_sines
from twintube.identification.together import VALLEYS, search, together
from twintube.identification.uncertainty import Estimate, estimates, polished
from twintube.provenance import fingerprint

if TYPE_CHECKING:
    import pandas as pd

SLOW = 0.53  # Table 6 is fitted to records up to 0.5 m/s, which is the bench's 0.524 m/s
TOGETHER = "all together"
HARDLY_APART = 0.9  # correlation of two parameters that the records hardly tell apart
Slow = tuple[Array, Array]  # stroke [m] and force [N] of a quasi-static record


@dataclass(frozen=True)
class Budget:
    """Population and generations of the searches, walkers and steps of the intervals.

    The first two are those of the paper's steps, which only the method pso takes.
    """

    table_6: tuple[int, int]
    tables_7_8: tuple[int, int]
    together: tuple[int, int]
    intervals: tuple[int, int]

    def generations(self, method: str) -> int:
        """All calls of `progress`, for a progress bar; a step of the walkers is two half generations."""
        paper = 0 if method == DEFAULT else self.table_6[1] + self.tables_7_8[1]
        return paper + self.together[1] + VALLEYS + 2 * self.intervals[1]


PAPER = Budget((48, 100), (120, 500), (40, 75), (64, 300))  # the swarms as the paper has them
QUICK = Budget((24, 40), (40, 60), (40, 40), (40, 100))


@dataclass(frozen=True)
class Step:
    """A search: the parameters that it changed and its best error."""

    title: str
    names: tuple[str, ...]
    best: Best
    unit: str  # of the error: N (equation 42) or N + J (equation 43)


@dataclass(frozen=True, repr=False)
class Identification:
    """The identified damper and what is known about it."""

    damper: Damper
    steps: list[Step]
    estimates: list[Estimate]
    pairs: list[tuple[str, str, float]]  # parameters that the records hardly tell apart, with their correlation
    offset: float  # zero of the load cell [N], sought only without a quasi-static record
    remarks: list[str]

    def to_dataframe(self) -> pd.DataFrame:
        """A row for each parameter: value, interval (95 % for all together), allowed range, and whether it is determined.

        Values are SI numbers, with their unit in a column. Raises UserError where pandas is not installed.
        """
        known = Parameters.__dataclass_fields__
        rows = [
            {
                "name": e.name, "value": e.value, "low": e.low, "high": e.high, "unit": known[e.name].metadata["unit"],
                "allowed_from": e.bounds[0], "allowed_to": e.bounds[1], "determined": e.determined, "at_bound": e.at_bound,
            }
            for e in self.estimates
        ]  # fmt: skip
        return data_frame(rows, index="name")

    def __repr__(self) -> str:
        known = sum(e.determined for e in self.estimates)
        return f"<Identification: {self.damper.name}, {known} of {len(self.estimates)} parameters determined>"


def identify_damper(  # noqa: PLR0913 - records of four kinds, and how they are searched
    damper: Damper,
    slow: Slow | None,
    intact: Sequence[Harmonic],
    degraded: Sequence[Harmonic],
    *,
    slow_lost: Sequence[tuple[float, Slow]] = (),
    method: str = DEFAULT,
    budget: Budget = PAPER,
    seed: int = 1,
    journal: Path | None = None,
    progress: Callable[[str, float], None] | None = None,
) -> Identification:
    """Identify a damper from its records; its geometry is given (step two of the paper).

    Args:
        damper: geometry and starting values; what the records do not reach stays as it is here.
        slow: quasi-static record of the intact damper.
        intact: harmonic records of the intact damper; without any, F-v curve, friction and gas spring stay.
        degraded: harmonic records of degraded states; without any, only the intact damper is identified.
        slow_lost: oil level and quasi-static record of states without preload.
        method: de searches all parameters together; pso first takes the third and fourth step of the paper.
        budget: how long to search.
        seed: of all random numbers.
        journal: a folder that makes a killed run resumable.
        progress: called with the step's title and its error after each generation.

    Raises InputError and ParameterError.

    """
    if not intact and not degraded:
        raise InputError("no harmonic record to identify from")
    remarks: list[str] = []
    damper, offset, known = first_step(damper, slow, intact, slow_lost, remarks)
    if not degraded:
        remarks.append("no degraded record: only the intact damper is identified")
        return Identification(damper, [], known, [], offset, remarks)
    run = Searches(method, seed, journal, progress)
    starts: list[Array] = []
    if method != DEFAULT:
        damper = run.as_in_the_paper(damper, degraded, budget, remarks)
        starts = [np.array([getattr(damper.parameters, name) for name in DEGRADATION])]
    # The third step leaves out foam, which its own records may hold, and the fourth cannot undo that.
    names = DEGRADATION
    with (
        Objective(damper, names, degraded, with_work=True) as coarse,
        Objective(damper, names, degraded, with_work=True, samples=FINE) as fine,
    ):
        file, told = run.file(coarse), run.told(TOGETHER)
        best = together(coarse, budget.together, seed=seed, starts=starts, journal=file, progress=told)
        candidates = [run.kept(TOGETHER, coarse, best)]
        candidates.append(polished(fine, candidates[0]))
        x = candidates[int(np.argmin(fine(np.array(candidates))))]
        # How far the sampling alone moves the optimum: an error that the noise does not show.
        moved = np.abs(polished(coarse, x) - x)
        every = coarse.corrected(fine, x)
        intervals, related = estimates(
            every, x, moved, walkers=budget.intervals[0], steps=budget.intervals[1], seed=seed, journal=run.file(every),
            progress=run.told("intervals"),
        )  # fmt: skip
    return Identification(every.damper_at(x), run.steps, known + intervals, alike(intervals, related), offset, remarks)


def alike(intervals: Sequence[Estimate], related: Array) -> list[tuple[str, str, float]]:
    """Pairs of DEGRADATION that the records determine but hardly tell apart, with their correlation."""
    return [
        (DEGRADATION[i], DEGRADATION[j], float(related[i, j]))
        for i in range(len(DEGRADATION))
        for j in range(i)
        if abs(related[i, j]) > HARDLY_APART and intervals[i].determined and intervals[j].determined
    ]


@dataclass(frozen=True)
class Searches:
    """The searches of an identification, one after the other, and what they found."""

    method: str
    seed: int
    journal: Path | None
    progress: Callable[[str, float], None] | None
    steps: list[Step] = field(default_factory=list)

    def file(self, objective: Objective) -> Path | None:
        """The journal of the next step."""
        return journal_file(self.journal, len(self.steps), objective)

    def told(self, title: str) -> Callable[[float], None] | None:
        """What a step of this title calls after each generation."""
        progress = self.progress
        return None if progress is None else lambda error: progress(title, error)

    def kept(self, title: str, objective: Objective, best: Best) -> Array:
        """Keep a step; its values (k,)."""
        self.steps.append(Step(title, objective.names, best, "N + J" if objective.with_work else "N"))
        return best.x

    def alone(self, title: str, objective: Objective, size: tuple[int, int]) -> Array:
        """A search of its own; its values (k,)."""
        file, told = self.file(objective), self.told(title)
        best = search(objective, size, method=self.method, seed=self.seed, journal=file, progress=told)
        return self.kept(title, objective, best)

    def as_in_the_paper(self, damper: Damper, degraded: Sequence[Harmonic], budget: Budget, remarks: list[str]) -> Damper:
        """The damper after the third and fourth step of the paper."""
        calm = [r for r in degraded if r.top_speed <= SLOW]
        if calm:
            with Objective(damper.with_(**NO_FOAM, **NO_CAVITATION), TABLE_6, calm, with_work=False) as bare:
                x = self.alone("Table 6", bare, budget.table_6)
            damper = damper.with_(**dict(zip(TABLE_6, x.tolist(), strict=True)))
        else:
            remarks.append(f"no degraded record up to {SLOW} m/s: Table 6 is fitted together with the others")
        with Objective(damper, TABLES_7_8, degraded, with_work=True) as full:
            return full.damper_at(self.alone("Tables 7 and 8", full, budget.tables_7_8))


def journal_file(folder: Path | None, number: int, objective: Objective) -> Path | None:
    """The journal of a step, named after all that its values depend on: the objective's inputs and the program.

    A run that is resumed after an upgrade computes anew instead of mixing the values of two programs.
    """
    return None if folder is None else folder / f"{number}_{objective.digest}_{fingerprint(__name__)}.jsonl"


def first_step(
    damper: Damper,
    slow: Slow | None,
    intact: Sequence[Harmonic],
    slow_lost: Sequence[tuple[float, Slow]],
    remarks: list[str],
) -> tuple[Damper, float, list[Estimate]]:
    """F-v curve, friction and gas spring, the zero of the load cell [N] where only sines show it, and intervals."""
    offset, pulls = 0.0, 0.0
    known: list[Estimate] = []
    if slow is not None and len(intact) >= 2:
        damper, known = identify_intact(damper, slow, intact)
        pulls = -quasi_static(*slow).F_0
    elif intact:
        fit = identify_sines(damper, intact)
        damper, offset, known = fit.damper, fit.offset, fit.estimates
        pulls = offset
        remarks.append(
            "friction and gas spring from the harmonic records, as there is no quasi-static record of the intact damper"
        )
    else:
        remarks.append("no intact harmonic record: F-v curve, friction and gas spring are those of the given parameter set")
    if round(pulls, 1) > 0.0:
        remarks.append(
            f"a constant {pulls:.1f} N pulls the rod in, which no gas does; F_0 stays at its bound 0: a zero of the load "
            "cell, or both signs turned (force_sign = -1 and stroke_sign = -1 in dataset.toml)"
        )
    rises = []
    for level, (stroke, force) in slow_lost:
        q = quasi_static(stroke, force)
        damper = damper.with_(c_gas_lost=max(0.0, q.c_gas))
        if level < 1.0:
            rises.append((q.F_FrS / damper.parameters.F_FrS - 1.0) / (1.0 - level))
    if rises:
        damper = damper.with_(oil_loss_gain=float(np.clip(np.mean(rises), 0.0, 5.0)))
    return damper, offset, known
