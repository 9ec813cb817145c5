"""The diagnosis on blind trials: what its answers are worth, and from which strength on a cause is found."""

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from worlds.blind_trials.hidden import EFFECTS
from worlds.makers import FIRST_TRIAL, TRIALS, Job, jobs, of_trials
from worlds.run import run
from worlds.scoring import score
from worlds.scoring.marks import top_right

STRENGTHS = (0.0625, 0.125, 0.25, 0.5, 1.0)  # of the typical strength, for the detection limit
ENOUGH = 0.9  # share of the datasets in which an effect must come first
BATCH = 2  # seeds of all effects between two looks at what is given up


@contextmanager
def folder_of(keep: Path | None) -> Iterator[Path]:
    """The folder of a run, which is removed at the end where it is not to be kept."""
    if keep is not None:
        yield keep
        return
    with TemporaryDirectory() as folder:
        yield Path(folder)


def bench_diagnosis(seeds: int, keep: Path | None = None) -> dict[str, Any]:
    """Scores over `seeds` blind trials of each kind with strengths 0.5 to 1.5."""
    with folder_of(keep) as folder:
        return score(run(jobs("blind_trials", 0, seeds * len(TRIALS) - 1), folder))


def bench_detection(seeds: int, keep: Path | None = None) -> dict[str, Any]:
    """The smallest of STRENGTHS at which each effect is likeliest in 9 of 10 blind trials; NaN where none is.

    The weakest is run first, as most effects are found there, then it is bisection. A strength is given up as soon as too
    many are missed.
    """
    rates: dict[str, dict[float, float]] = {kind: {} for kind in EFFECTS}
    with folder_of(keep) as folder:
        while wanted := {kind: s for kind, known in rates.items() if (s := undecided(known)) is not None}:
            hits: dict[str, list[bool]] = {kind: [] for kind in wanted}
            for first in range(0, seeds, BATCH):
                trials = [
                    (kind, FIRST_TRIAL + n, s)
                    for kind, s in wanted.items()
                    if not given_up(hits[kind], seeds)
                    for n in range(first, min(first + BATCH, seeds))
                ]
                pairs = run([Job(f"{k}_{n}_{s:g}", partial(of_trials, k, n, s)) for k, n, s in trials], folder)
                for (kind, _, _), pair in zip(trials, pairs, strict=True):
                    hits[kind].append(top_right(pair))
            for kind, s in wanted.items():
                rates[kind][s] = hits[kind].count(True) / len(hits[kind])
    return {
        "detection_limit": {kind: limit(known) for kind, known in rates.items()},
        "found_share": {kind: {str(s): known[s] for s in sorted(known)} for kind, known in rates.items()},
    }


def given_up(hits: Sequence[bool], seeds: int) -> bool:
    """Whether so many are missed that the rest cannot make it enough."""
    return hits.count(False) > seeds - math.ceil(ENOUGH * seeds)


def limit(known: dict[float, float]) -> float:
    """The smallest strength [1] of those run whose share of hits is enough; NaN if there is none."""
    return min((s for s, hits in known.items() if hits >= ENOUGH), default=float("nan"))


def undecided(known: dict[float, float]) -> float | None:
    """The weakest at first, then the middle of the strengths that may still be the limit; None if there is none left."""
    if not known:
        return STRENGTHS[0]
    low = max((s for s, hits in known.items() if hits < ENOUGH), default=0.0)
    between = [s for s in STRENGTHS if s > low and not s >= limit(known)]
    return between[(len(between) - 1) // 2] if between else None
