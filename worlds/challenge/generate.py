"""A dataset with a hidden cause from a seed, and its truth: strengths by the noise, or of practice."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import brentq

from twintube.common.arrays import Array
from worlds.bench.files import LAYOUTS, in_milliseconds, told, write_dataset, write_truth
from worlds.bench.plan import RNG, rms, span
from worlds.bench.sampler import Recorder, coloured, converted, step_of
from worlds.challenge import practice
from worlds.challenge.catalogue import CAUSES, PAIRS, Cause, Formulation
from worlds.challenge.plan import FORMATS, Bench, bench_for, motion
from worlds.model.run import Run, Step, begun, copied, finished, sampled

WEAKEST, STRONGEST = 0.2, 10.0  # effect over noise
COARSER = 6.0  # steps of the search for the strength
TRIES = 5  # strengths within the range
ATTEMPTS = 6  # campaigns drawn until the cause shows
SEARCHED = 6  # records that it looks at where each strength needs a march
ACTING = 0.02  # of the largest effect: a record on which the cause does not act
# Causes by seed: each block of this many seeds holds all of them, in an order of its own.
SINGLES = tuple(name for name in CAUSES if not name.startswith("none"))
CYCLE = (*SINGLES, *("none",) * 8, *("none_history",) * 3, *("pair",) * 3)


def cause_of(seed: int) -> str:
    """The cause that a seed hides."""
    block, place = divmod(seed, len(CYCLE))
    return str(np.random.default_rng([block, 77]).permutation(np.array(CYCLE))[place])


@dataclass(frozen=True)
class Hidden:
    """A formulation at its strength."""

    item: Formulation
    strength: float
    constants: Mapping[str, Any]

    @property
    def step(self) -> Step:
        """What acts."""
        return Step(self.item.stage, lambda run: self.item.apply(run, self.strength, self.constants))


Size = Callable[[Formulation, Bench, float], Hidden]  # at the noise [N]


@dataclass(frozen=True)
class Attempt:
    """A campaign with its hidden cause, before the noise."""

    bench: Bench
    causes: list[Hidden]
    plain: list[Run]  # nothing hidden
    runs: list[Run]
    changes: list[Array]  # [N] by record
    sigmas: list[float]  # [N] noise by record
    noise: float  # [N] RMS of all samples
    force: float  # [N] RMS


def write(seed: int, folder: str | Path, cause: str | None = None) -> dict[str, Any]:
    """Write FOLDER/dataset and FOLDER/truth.json of a seed of the challenge, and return the truth.

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
    several = [CAUSES[part].formulations for part in names]
    chosen = [choice[int(rng.integers(len(choice)))] for choice in several if choice]
    cut = True if name == "none_history" else False if name == "none" else None

    def by_noise(item: Formulation, bench: Bench, noise: float) -> Hidden:
        return sized_by_noise(item, bench, noise, rng, len(chosen))

    def campaign() -> Attempt:
        return attempt(chosen, bench_for(needs(chosen), cut, rng), by_noise)

    return written("challenge", seed, names, drawn(campaign), rng=rng, folder=Path(folder))


def workshop(seed: int, folder: str | Path) -> dict[str, Any]:
    """As `write`, of a seed of the workshop from 1 on: strengths of practice, and every file format."""
    rng, case = np.random.default_rng([seed, 20261]), practice.case_of(seed)
    names = {practice.formulation(*part): part for part in case}

    def as_in_practice(item: Formulation, bench: Bench, noise: float) -> Hidden:
        return Hidden(item, practice.strength(rng, bench, *names[item]), item.draw(rng, bench))

    def campaign() -> Attempt:
        return attempt(list(names), bench_for(needs(names), False, rng, tuple(LAYOUTS)), as_in_practice)

    return written("workshop", seed, [cause for cause, _ in case] or ["none"], drawn(campaign), rng=rng, folder=Path(folder))


def needs(chosen: Iterable[Formulation]) -> frozenset[str]:
    """What a campaign must have for all of them."""
    return frozenset().union(*(item.needs for item in chosen))


def drawn(campaign: Callable[[], Attempt]) -> Attempt:
    """A campaign in which the causes show: in one without foam a collapse of foam does not."""
    for _ in range(ATTEMPTS):
        trial = campaign()
        if not trial.causes or rms(trial.changes) >= 0.5 * WEAKEST * trial.noise:
            break
    return trial


def written(world: str, seed: int, names: list[str], trial: Attempt, *, rng: RNG, folder: Path) -> dict[str, Any]:
    """Write dataset and truth."""
    save(seed, trial, folder / "dataset", rng)
    truth = truth_of(world, seed, names, trial)
    write_truth(folder, truth)
    return truth


def attempt(chosen: Sequence[Formulation], bench: Bench, size: Size) -> Attempt:
    """A campaign with the causes at their strengths; in it a cause may not show at all, as foam where there is none."""
    plain = list(map(finished, runs_of(bench, 1.0)))
    forces = [sampled(run, bench.recorder)[2] for run in plain]
    bench = replace(bench, largest=max(float(np.abs(F).max()) for F in forces))
    whole = rms(forces)
    sigmas = [bench.noise * (rms([F]) if bench.by_record else whole) for F in forces]
    noise = math.sqrt(sum(s**2 * len(F) for s, F in zip(sigmas, forces, strict=True)) / sum(map(len, forces)))
    causes = [size(item, bench, noise) for item in chosen]
    runs = with_hidden(plain, [cause.step for cause in causes], bench)
    return Attempt(bench, causes, plain, runs, effects(runs, plain, bench), sigmas, noise, whole)


def with_hidden(plain: list[Run], steps: list[Step], bench: Bench) -> list[Run]:
    """Runs with something hidden, from those with nothing."""
    setup = any(step.stage == "setup" for step in steps)
    return [finished(begun(r.record, r.motion, bench.damper) if setup else copied(r), steps) for r in plain]


def effects(runs: Sequence[Run], plain: Sequence[Run], bench: Bench) -> list[Array]:
    """What a cause changes [N], sample by sample; a wrong stroke or rate counts as the force it would ask for."""
    return [difference(run, base, bench) for run, base in zip(runs, plain, strict=True)]


def difference(run: Run, base: Run, bench: Bench) -> Array:
    """As `effects`, of a record; without the recorder's filters."""
    points = Recorder(bench.recorder.fs, "point")
    plain = sampled(base, points)[2]
    change = run.unit[0] * sampled(run, points)[2] - plain
    if run.unit[1] != 1.0 or run.stroke is not base.stroke or run.stretch != 1.0:
        stroke = run.unit[1] * run.stroke
        speed = np.gradient(stroke, np.maximum.accumulate(run.time + 1e-12 * np.arange(len(run.time)))) / run.stretch
        moved = replace(run.motion, stroke=stroke, velocity=np.clip(speed, -5.0, 5.0))
        change = change - (sampled(finished(begun(run.record, moved, bench.damper)), points)[2] - plain)
    return change


def runs_of(bench: Bench, coarser: float) -> list[Run]:
    """The runs of all records before the march; above 1 in coarser steps."""
    longest = min(2e-3, 0.25 / bench.recorder.fs) * min(coarser, 3.0)
    return [begun(r, motion(o, longest, coarser), bench.damper) for r, o in zip(bench.records, bench.orders, strict=True)]


def sized_by_noise(item: Formulation, bench: Bench, noise: float, rng: RNG, causes: int) -> Hidden:
    """The formulation at a strength whose effect over the noise is drawn; as near to it as its range allows."""
    constants = item.draw(rng, bench)
    goal = span(rng, 0.5 if causes > 1 else WEAKEST, STRONGEST) * noise
    if item.lowest == item.highest:
        return Hidden(item, item.highest, constants)
    some = runs_of(bench, COARSER)
    if item.stage == "setup":  # slow: some of the records, from all states
        some = [some[i] for i in sorted({round(i) for i in np.linspace(0, len(some) - 1, SEARCHED)})]
    plain = list(map(finished, some))

    def size(x: float) -> float:
        return acting(effects(with_hidden(plain, [Hidden(item, x, constants).step], bench), plain, bench))

    return Hidden(item, sought(size, goal, item.lowest, item.highest), constants)


def acting(changes: list[Array]) -> float:
    """RMS over the records on which a cause acts."""
    sizes = [rms([change]) for change in changes]
    return rms([c for c, s in zip(changes, sizes, strict=True) if s > ACTING * max(sizes)] or changes)


def sought(size: Callable[[float], float], goal: float, low: float, high: float) -> float:
    """The strength in [low, high] whose size is nearest to `goal` by its logarithm, of some that Brent's method tries."""
    tried: dict[float, float] = {}

    def off(x: float) -> float:
        return tried.setdefault(x, math.log(max(size(math.exp(x)), 1e-12) / goal))

    a, b = math.log(low), math.log(high)
    if off(a) < 0.0 < off(b):
        brentq(off, a, b, xtol=0.02, maxiter=TRIES, disp=False)
    return math.exp(min(tried, key=lambda x: abs(tried[x])))


def save(seed: int, trial: Attempt, folder: Path, rng: RNG) -> None:
    """Sampling, noise, scatter of the zeros and converter, and the files."""
    bench, noise_rng = trial.bench, np.random.default_rng([seed, 20241])
    samples = [sampled(run, bench.recorder, rng) for run in trial.runs]
    step = step_of(max(bench.largest, *(float(np.abs(s[2]).max()) for s in samples)), bench.bits)
    records = [
        (run.record.name, entries_of(bench, run), logged(s, run, bench, sigma=sigma, step=step, rng=noise_rng))
        for s, run, sigma in zip(samples, trial.runs, trial.sigmas, strict=True)
    ]
    layout, title = LAYOUTS[bench.format], f"Bench {bench.damper.name}, campaign {seed}"
    named = not bench.milliseconds or layout.names  # by its logger
    write_dataset(folder, title, bench.damper, layout if named else in_milliseconds(layout), records)


def logged(samples: list[Array], run: Run, bench: Bench, *, sigma: float, step: float, rng: RNG) -> dict[str, Array]:
    """The columns of a record: samples with noise of `sigma` [N], a zero, and steps of the converter (force: `step` [N])."""
    time, stroke, force, velocity, *warm = samples
    n = len(time)
    force = force + sigma * coloured(rng, n, bench.colour) + bench.zero * float(np.abs(force).max()) * rng.uniform(-1, 1)
    stroke = stroke + bench.stroke_noise * rng.standard_normal(n)
    columns = {
        "time [s]": run.stretch * time, "force [N]": run.unit[0] * converted(force, step),
        "stroke [mm]": 1e3 * run.unit[1] * converted(stroke, step_of(1.2 * bench.reach, bench.bits)),
    }  # fmt: skip
    if bench.velocity_column and bench.format in FORMATS:
        noisy = velocity + 0.002 * float(np.abs(velocity).max()) * rng.standard_normal(n)
        columns["velocity [mm/s]"] = 1e3 * run.unit[1] * noisy
    if warm:
        columns["temperature [degC]"] = warm[0] + 0.1 * rng.standard_normal(n)
    return columns


def entries_of(bench: Bench, run: Run) -> dict[str, Any]:
    """What dataset.toml says about a record."""
    record, volume = run.record, bench.damper.parameters.V_oil
    level = {"oil_volume_mL": round(1e6 * volume * record.level, 3)} if bench.volumes else {"oil_level": record.level}
    warm = {"start_temperature_degC": record.temperature} if bench.temperatures else {}
    return {"measurement": record.measurement, **level, "gas_preload": record.preload, **warm}


def known(name: str) -> Cause:
    """A cause of either table."""
    return CAUSES[name] if name in CAUSES else practice.MORE[name]


def truth_of(world: str, seed: int, names: list[str], trial: Attempt) -> dict[str, Any]:
    """What was hidden, with the values that a diagnosis may be compared with."""
    bench, noise = trial.bench, trial.noise
    causes = [known(name).label or name for name in names]
    comparable: dict[str, float] = {}
    for cause in trial.causes:
        comparable |= {key: float(value) for key, value in cause.item.truth(cause.strength, cause.constants).items()}
    more: dict[str, Any] = {
        "hidden": "+".join(names), "formulation": "+".join(cause.item.name for cause in trial.causes),
        "strength": [cause.strength for cause in trial.causes],
        "constants": [dict(cause.constants) for cause in trial.causes],
        "values": comparable, "effect_over_noise": rms(trial.changes) / noise, "noise_N": noise,
        "effect_over_noise_acting": acting(trial.changes) / noise, "effect_over_force": rms(trial.changes) / trial.force,
        "recorder": vars(bench.recorder), "excitation": bench.style, "history": bench.history, "format": bench.format,
    }  # fmt: skip
    if names[0] == "odd_record":
        more["file"] = bench.records[trial.causes[0].constants["file"]].name
    return told(world, seed, bench.damper.name, causes, kind=known(names[0]).kind, more=more)
