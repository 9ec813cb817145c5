"""Hit rate of the diagnosis on datasets in which `blind_trials` hides something."""

import hashlib
import json
import math
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import as_completed
from dataclasses import asdict, dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from tqdm import tqdm

import twintube
from twintube.data import DataError
from twintube.diagnosis.engine import diagnose, known_gain
from twintube.lab import blind_trials
from twintube.lab.blind_trials.hidden import EFFECTS, FAULTS, OUTSIDE
from twintube.lab.blind_trials.trials import trial, write
from twintube.processes import pool

PAIRS = ("valve_wear+gas_spring", "oil_temperature+end_stop", "oil_level_error+valve_wear", "side_load_friction+fluid_lag")
KINDS = (*EFFECTS, *FAULTS, "recalibrate", "none", *PAIRS, *OUTSIDE)
FIRST_SEED = 100
STRENGTHS = (0.0625, 0.125, 0.25, 0.5, 1.0)  # of the typical strength, for the detection limit
ENOUGH = 0.9  # share of the datasets in which an effect must be named first
BATCH = 2  # seeds of all effects between two looks at what is given up
Job = tuple[str, int, float | None]  # what is hidden, the seed, the strength or None for 0.5 to 1.5


@dataclass(frozen=True)
class Outcome:
    """What a dataset was taken for; gains are of the held-out error, NaN where none is known."""

    kind: str
    seed: int
    strength: float
    verdict: str
    named: tuple[str, ...]
    alternatives: tuple[str, ...]
    gain: float
    true_gain: float
    seconds: float

    @property
    def answer(self) -> str:
        """The column of the confusion matrix."""
        return "+".join(sorted(self.named)) if self.named else self.verdict

    @property
    def right(self) -> bool:
        """Whether the verdict is the hidden cause; an ambiguous answer is not."""
        if self.kind in OUTSIDE:
            return self.verdict == "unexplained"
        if self.kind in ("none", "recalibrate"):
            return self.verdict == self.kind
        wanted = "measurement_fault" if self.kind in FAULTS else "cause"
        return self.verdict == wanted and set(self.named) == set(self.kind.split("+"))

    @property
    def named_first(self) -> bool:
        """Whether the hidden effect is the first that is named."""
        return self.verdict in ("cause", "measurement_fault") and self.named[:1] == (self.kind,)


def outcome(kind: str, seed: int, strength: float | None) -> Outcome:
    """Hide, diagnose, compare. A dataset that the data door refuses for its unit or its sign counts as a named fault."""
    with TemporaryDirectory() as folder:
        hidden = trial(kind, seed, strength=strength)
        write(hidden, folder)
        start = time.perf_counter()
        try:
            answer = diagnose(folder)
        except DataError as error:
            refused = kind == "unit_error" and "mixed up" in str(error)
            verdict, named = ("measurement_fault", (kind,)) if refused else ("refused", ())
            return Outcome(kind, seed, hidden.strength, verdict, named, (), np.nan, np.nan, time.perf_counter() - start)
        seconds = time.perf_counter() - start
        effects = [part for part in kind.split("+") if part in EFFECTS]
        return Outcome(
            kind, seed, hidden.strength, answer.verdict, tuple(cause.effect for cause in answer.causes),
            tuple(other.effect for other in answer.alternatives),
            answer.causes[0].gain.heldout if answer.causes else np.nan,
            known_gain(folder, effects) if effects and strength is None else np.nan, seconds,
        )  # fmt: skip


def outcomes(jobs: Sequence[Job], keep: Path | None) -> Iterator[Outcome]:
    """All jobs, shared out to processes, with a progress bar; what `keep` holds of these sources is not run again."""
    known = kept(keep) if keep is not None and keep.is_file() else {}
    bar = tqdm(total=len(jobs), unit="dataset")
    for job in jobs:
        if job in known:
            bar.update()
            yield known[job]
    code = sources()
    with bar, pool() as workers:
        waiting = {workers.submit(outcome, *job): job for job in jobs if job not in known}
        for done in as_completed(waiting):
            if keep is not None:
                line = {"code": code, "job": waiting[done], "outcome": asdict(done.result())}
                with keep.open("a", encoding="utf-8") as file:
                    file.write("\n" + json.dumps(line))  # after whatever a killed run left of its last line
            bar.update()
            yield done.result()


def kept(path: Path) -> dict[Job, Outcome]:
    """The outcomes in a file that are of these sources."""
    known: dict[Job, Outcome] = {}
    code = sources()
    for text in path.read_text(encoding="utf-8").splitlines():
        try:
            line = json.loads(text)
        except json.JSONDecodeError:
            continue  # empty, or the end of a run that was killed
        if line["code"] == code:
            kind, seed, strength = line["job"]
            names = {key: tuple(line["outcome"][key]) for key in ("named", "alternatives")}
            known[kind, seed, strength] = Outcome(**line["outcome"] | names)
    return known


def sources() -> str:
    """Digest of the sources of the diagnosis and of the datasets: outcomes of two states of the code are not mixed."""
    folders = [Path(package.__path__[0]) for package in (twintube, blind_trials)]
    files = sorted(f for folder in folders for f in folder.rglob("*") if f.suffix in (".py", ".toml"))
    return hashlib.sha256(b"".join(f.read_bytes() for f in files)).hexdigest()[:16]


def share(some: list[bool]) -> float:
    """Share of what is true [1]."""
    return float(np.mean(some)) if some else float("nan")


def bench_diagnosis(seeds: int, keep: Path | None = None) -> dict[str, Any]:
    """`seeds` datasets of each kind with strengths 0.5 to 1.5."""
    return shares(list(outcomes([(kind, FIRST_SEED + n, None) for n in range(seeds) for kind in KINDS], keep)))


def shares(results: list[Outcome]) -> dict[str, Any]:
    """The confusion matrix and the shares of the contract."""
    results = sorted(results, key=lambda o: (o.kind, o.seed))
    matrix = {kind: dict(Counter(o.answer for o in results if o.kind == kind).most_common()) for kind in KINDS}
    inside = [o for o in results if o.kind not in OUTSIDE]
    gains = [(o.gain, o.true_gain) for o in results if np.isfinite(o.true_gain) and o.true_gain > 0]
    return {
        "seconds": float(np.mean([o.seconds for o in results])),
        "correct_share": share([o.right for o in inside]),
        "correct_or_ambiguous_share": share(
            [o.right or (o.verdict == "ambiguous" and {*o.kind.split("+")} <= {*o.named, *o.alternatives}) for o in inside]
        ),
        "false_alarm_share": share([o.verdict != "none" for o in results if o.kind == "none"]),
        "outside_named_share": share([o.verdict != "unexplained" for o in results if o.kind in OUTSIDE]),
        "gain_over_true_structure": float(np.median([max(g if np.isfinite(g) else 0.0, 0.0) / t for g, t in gains])),
        "matrix": matrix,
        "outcomes": [asdict(o) for o in results],
    }


def bench_detection(seeds: int, keep: Path | None = None) -> dict[str, Any]:
    """The smallest of STRENGTHS at which each effect is named first in 9 of 10 datasets; NaN where none is.

    The weakest is run first, as most effects are named there, then it is bisection. A strength is given up as soon as too
    many are missed.
    """
    rates: dict[str, dict[float, float]] = {kind: {} for kind in EFFECTS}
    every: list[Outcome] = []
    while wanted := {kind: s for kind, known in rates.items() if (s := undecided(known)) is not None}:
        hits: dict[str, list[bool]] = {kind: [] for kind in wanted}
        for first in range(0, seeds, BATCH):
            numbers = range(first, min(first + BATCH, seeds))
            alive = {kind: s for kind, s in wanted.items() if not given_up(hits[kind], seeds)}
            latest = list(outcomes([(kind, FIRST_SEED + n, s) for kind, s in alive.items() for n in numbers], keep))
            for result in latest:
                hits[result.kind].append(result.named_first)
            every += latest
        for kind, s in wanted.items():
            rates[kind][s] = share(hits[kind])
    return {
        "detection_limit": {kind: limit(known) for kind, known in rates.items()},
        "found_share": {kind: {str(s): known[s] for s in sorted(known)} for kind, known in rates.items()},
        "outcomes": [asdict(o) for o in every],
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
