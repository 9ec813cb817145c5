"""A dataset with a hidden cause from a seed, with its truth."""

import json
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from twintube.arrays import Array
from twintube.files import write_text
from twintube.lab.challenge.catalogue import CAUSES, PAIRS, Formulation, label_of
from twintube.lab.challenge.changes import effects, rms
from twintube.lab.challenge.excitation import motion
from twintube.lab.challenge.files import write_dataset
from twintube.lab.challenge.plan import Bench, bench_for
from twintube.lab.challenge.run import Run, Step, begun, copied, finished, marched
from twintube.lab.challenge.sampling import logged, sampled
from twintube.lab.challenge.tolerance import beyond, late_samples, tolerances

WEAKEST, STRONGEST = 0.2, 10.0  # effect over noise
COARSER = 6.0  # steps of the search for the strength
ATTEMPTS = 6  # campaigns drawn until the cause shows
SEARCHED = 6  # records that it looks at where each strength needs a march
ACTING = 0.02  # of the largest effect: a record on which the cause does not act
LATE = ("channel_delay", "fluid_lag", "mount_compliance", "smooth_transition")  # make the force late
# Causes by seed: each block of this many seeds holds all of them, in an order of its own.
SINGLES = tuple(name for name in CAUSES if not name.startswith("none"))
CYCLE = (*SINGLES, *("none",) * 8, *("none_history",) * 3, *("pair",) * 3)


def cause_of(seed: int) -> str:
    """The cause that a seed hides."""
    block, place = divmod(seed, len(CYCLE))
    return str(np.random.default_rng([block, 77]).permutation(np.array(CYCLE))[place])


def write(seed: int, folder: str | Path, cause: str | None = None) -> dict[str, Any]:
    """Write the dataset of a seed and return its truth, which is written beside the folder as `<folder>.truth.json`.

    `cause` is one of CAUSES, two of them joined by `+`, or drawn from the seed. Raises ValueError for an unknown one.
    """
    rng = np.random.default_rng([seed, 20240])
    name = cause or cause_of(seed)
    if name == "pair":
        name = "+".join(PAIRS[int(rng.integers(len(PAIRS)))])
    names = name.split("+")
    for part in names:
        if part not in CAUSES:
            raise ValueError(f"unknown cause {part}: must be one of {', '.join(CAUSES)}")
    chosen = [pick(CAUSES[part].formulations, rng) for part in names]
    cut = True if name == "none_history" else False if name == "none" else None
    for _ in range(ATTEMPTS):
        trial = attempt(chosen, cut, rng)
        if not trial.steps or rms(trial.changes) >= 0.5 * WEAKEST * trial.noise:
            break
    bench, steps, noise, runs = trial.bench, trial.steps, trial.noise, trial.runs
    samples = [sampled(r, bench.fs, bench.sampling, rng) for r in runs]
    noise_rng = np.random.default_rng([seed, 20241])
    peak = max(bench.largest, *(float(np.abs(s.force).max()) for s in samples))
    written = [
        logged(s, bench, sigma, peak, 1.2 * bench.reach, noise_rng) for s, sigma in zip(samples, trial.sigmas, strict=True)
    ]
    folder = Path(folder)
    title = f"Bench {bench.damper.name}, campaign {seed}"
    write_dataset(folder, bench, title, [(s, r.unit) for s, r in zip(written, runs, strict=True)])
    truth = truth_of(seed, names, chosen, steps, bench, noise, trial.changes, trial.force)
    if steps:
        truth["effect_beyond_bench"] = beyond_bench(trial) / noise
    delays = [late_samples(with_hidden(trial.plain, [step], bench), trial.plain, bench)
              for cause, step in zip(truth["causes"], steps, strict=False) if cause in LATE]  # fmt: skip
    if delays:
        truth["late_samples"] = min(delays)
    write_text(folder.with_name(folder.name + ".truth.json"), json.dumps(truth, indent=1) + "\n")
    return truth


@dataclass(frozen=True)
class Attempt:
    """A campaign with its hidden cause, before the noise."""

    bench: Bench
    steps: list[Step]
    plain: list[Run]  # nothing hidden
    runs: list[Run]
    changes: list[Array]  # [N] by record
    sigmas: list[float]  # [N] noise by record
    noise: float  # [N] RMS of all samples
    force: float  # [N] RMS


def attempt(chosen: list[Formulation | None], cut: bool | None, rng: np.random.Generator) -> Attempt:
    """One draw of a campaign and of the strengths; in it a cause may not show at all, as foam where there is none."""
    needs = frozenset().union(*(item.needs for item in chosen if item))
    bench = bench_for(needs, cut, rng)
    plain = [finished(marched(r), []) for r in runs_of(bench, 1.0)]
    forces = [sampled(r, bench.fs, bench.sampling, None).force for r in plain]
    bench = replace(bench, largest=max(float(np.abs(F).max()) for F in forces))
    share, whole = bench.sampling.noise, rms(forces)
    sigmas = [share * (rms([F]) if bench.sampling.by_record else whole) for F in forces]
    noise = math.sqrt(sum(s**2 * len(F) for s, F in zip(sigmas, forces, strict=True)) / sum(map(len, forces)))
    steps = [hidden(item, bench, noise, rng, len(chosen)) for item in chosen if item]
    runs = with_hidden(plain, steps, bench)
    return Attempt(bench, steps, plain, runs, effects(runs, plain, bench), sigmas, noise, whole)


def with_hidden(plain: list[Run], steps: list[Step], bench: Bench) -> list[Run]:
    """Runs with something hidden, from those with nothing."""
    setup = any(step.stage == "setup" for step in steps)
    return [finished(begun(r.record, r.motion, bench.damper) if setup else copied(r), steps) for r in plain]


def beyond_bench(trial: Attempt) -> float:
    """What no careful bench can be blamed for [N], RMS; of two causes the lesser by itself, as both are to be named."""
    steps, bench, open_ = trial.steps, trial.bench, tolerances(trial.plain, trial.bench)
    several = [trial.changes]
    if len(steps) > 1:
        several = [effects(with_hidden(trial.plain, [step], bench), trial.plain, bench) for step in steps]
    return min(rms(beyond(changes, open_)) for changes in several)


def pick(formulations: tuple[Formulation, ...], rng: np.random.Generator) -> Formulation | None:
    """One of the formulations, None where there are none."""
    return formulations[int(rng.integers(len(formulations)))] if formulations else None


def runs_of(bench: Bench, scale: float) -> list[Run]:
    """The runs of all records before the march; `scale` above 1 makes coarser steps."""
    longest = min(2e-3, 0.25 / bench.fs) * min(scale, 3.0)
    return [begun(r, motion(o, longest, scale), bench.damper) for r, o in zip(bench.records, bench.orders, strict=True)]


def hidden(item: Formulation, bench: Bench, noise: float, rng: np.random.Generator, causes: int) -> Step:
    """The formulation at a strength whose effect over the noise is drawn; as near to it as its range allows."""
    constants = item.draw(rng, bench)
    weakest = 0.5 if causes > 1 else WEAKEST
    goal = float(np.exp(rng.uniform(np.log(weakest), np.log(STRONGEST)))) * noise
    if item.lowest == item.highest:
        return Step(item.stage, item.apply, item.highest, constants)
    some = runs_of(bench, COARSER)
    if item.stage == "setup":  # slow: some of the records, from all states
        some = [some[i] for i in sorted({round(i) for i in np.linspace(0, len(some) - 1, SEARCHED)})]
    plain = [finished(marched(r), []) for r in some]

    def size(x: float) -> float:
        step = [Step(item.stage, item.apply, x, constants)]
        fresh = [begun(r.record, r.motion, bench.damper) if item.stage == "setup" else copied(r) for r in plain]
        changes = effects([finished(r, step) for r in fresh], plain, bench)
        sizes = [float(np.sqrt(np.mean(change**2))) for change in changes]
        return rms([c for c, s in zip(changes, sizes, strict=True) if s > ACTING * max(sizes)] or changes)

    return Step(item.stage, item.apply, sought(size, goal, item.lowest, item.highest), constants)


def sought(size: Callable[[float], float], goal: float, low: float, high: float, most: int = 5) -> float:
    """The strength in [low, high] whose size is nearest to `goal` by its logarithm: secants of the logarithms."""
    a, b = math.log(low), math.log(high)
    seen = {x: math.log(max(size(math.exp(x)), 1e-12) / goal) for x in (b, a)}
    for _ in range(most):
        if not seen[a] < 0.0 < seen[b] or b - a < 0.02:
            break
        share = -seen[a] / (seen[b] - seen[a])
        x = a + (b - a) * min(max(share, 0.15), 0.85)
        seen[x] = math.log(max(size(math.exp(x)), 1e-12) / goal)
        if abs(seen[x]) < 0.1:
            break
        a, b = (x, b) if seen[x] < 0.0 else (a, x)
    return math.exp(min(seen, key=lambda x: abs(seen[x])))


def truth_of(
    seed: int,
    names: list[str],
    chosen: list[Formulation | None],
    steps: list[Step],
    bench: Bench,
    noise: float,
    changes: list[Array],
    force: float,
) -> dict[str, Any]:
    """What was hidden, with the values that a diagnosis may be compared with."""
    sizes = [float(np.sqrt(np.mean(change**2))) for change in changes]
    acting = [c for c, s in zip(changes, sizes, strict=True) if s > ACTING * max(*sizes, 1e-9)]
    items = [item for item in chosen if item]
    comparable: dict[str, float] = {}
    for item, step in zip(items, steps, strict=True):
        comparable |= {key: float(value) for key, value in item.truth(step.strength, step.constants).items()}
    causes = [label_of(name) for name in names]
    truth: dict[str, Any] = {
        "cause": "+".join(causes),
        "causes": causes,
        "hidden": "+".join(names),
        "kind": "pair" if len(names) > 1 else CAUSES[names[0]].kind,
        "formulation": "+".join(item.name for item in items),
        "strength": [step.strength for step in steps],
        "constants": [dict(step.constants) for step in steps],
        "values": comparable,
        "effect_over_noise": rms(changes) / noise,
        "effect_over_noise_acting": rms(acting or changes) / noise,
        "effect_over_force": rms(changes) / force,
        "noise_N": noise,
        "fs": bench.fs,
        "sampling": vars(bench.sampling),
        "excitation": bench.style,
        "history": bench.history,
        "format": bench.format,
        "seed": seed,
        "damper": bench.damper.name,
        "records": [record.name for record in bench.records],
    }
    if names[0] == "odd_record":
        truth["file"] = bench.records[steps[0].constants["file"]].name
    return truth
