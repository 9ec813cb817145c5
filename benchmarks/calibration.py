"""Simulation-based calibration of the diagnosis (Talts et al. 2018): of what it calls 90 %, nine in ten are true.

Everything is drawn from the priors of the written-down model: state, cause, strengths, the damper's own law, bench, noise.
The forces are those of the intervals that records are thinned to: what recorder and thinning do is not part of it.
"""

import json
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np
from threadpoolctl import threadpool_limits

from benchmarks.calibration_figures import figures
from benchmarks.folders import folder_of
from twintube.common.arrays import Array
from twintube.dampers import Damper, load
from twintube.data import MEASURED, LoadedDataset, Record
from twintube.diagnosis import changes as method
from twintube.diagnosis.base import set_up
from twintube.diagnosis.bench import Bench
from twintube.diagnosis.changes import NONE, UNKNOWN, changes, mechanisms
from twintube.diagnosis.found import Fill
from twintube.diagnosis.frame import Frame
from twintube.diagnosis.mechanisms import Mechanism
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.posterior import NOTHING, log_prior
from twintube.diagnosis.records.noise import averaging_noise, noise
from twintube.diagnosis.records.prepare import prepare
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.search import off_its_law
from twintube.diagnosis.shares import SHARES
from twintube.diagnosis.sizes import Sizes, log_weights
from twintube.diagnosis.state import state
from twintube.engine.simulate import simulate
from twintube.rig.signals import AMPLITUDE
from worlds.bench.plan import chance

RNG = np.random.Generator
DAMPER = "SA8"
SPEEDS = (0.262, 1.048)  # [m/s] a plan of two sines, the faster above the speed of cavitation without preload
OSCILLATIONS = 5
RATE = 500.0  # [Hz]
NOISES = (1.0, 8.0)  # [N] RMS of a sample: load cells of 10 to 25 kN, class 0.1 to 0.5
EFFECTS = ("gas_spring", "side_load_friction", "valve_wear")  # that may have begun to act, or always act
CAUSES = {"one": 1, "two": 2}  # at once
DRAWS = 60  # of a state, unless more are asked for; half as many of changes
FIRST = 1000  # seed


def sine(damper: Damper, speed: float, name: str, *, reference: bool) -> Record:
    """A sine of the full damper."""
    omega = speed / AMPLITUDE
    t = np.arange(0.0, 2.0 * np.pi * OSCILLATIONS / omega, 1.0 / RATE)
    z, v = -AMPLITUDE * np.cos(omega * t), speed * np.sin(omega * t)
    force = simulate(damper, z, v, t).force
    whole = Record(name, f"{name}.csv", "harmonic", 1.0, True, None, None, t, z, force, v, MEASURED, None, ())
    return replace(whole, reference=reference, state=name.partition("_")[0])


def planned(rng: RNG, names: Sequence[str]) -> tuple[Bench, Array]:
    """A bench with the plan once for each of some names, and the noise (n,) [N] of its mean forces."""
    damper = load(DAMPER, as_published=True)
    records = [sine(damper, v, f"{name}_{1000 * v:.0f}", reference=name == "before") for name in names for v in SPEEDS]
    bench = Bench(damper, prepare(LoadedDataset("calibration", damper, records, [])))
    sample = np.exp(rng.uniform(*np.log(NOISES)))
    return bench, sample * np.concatenate([averaging_noise(np.maximum(r.samples, 1)) for r in bench.records])


def drawn_sizes(rng: RNG) -> Sizes:
    """Sizes of the model's own errors, from their priors."""
    n = numbers()
    grids = ((n.law_sizes, n.law_usual), (n.own_sizes, n.own_usual), (n.lasting_sizes, n.lasting_usual))
    return Sizes(*(int(rng.choice(len(grid), p=np.exp(log_weights(grid, scale)))) for grid, scale in grids))


def drawn_errors(bench: Bench, frame: Frame, sizes: Sizes, rng: RNG) -> Array:
    """What damper and bench add to the forces (n,) [N] beyond the model, where they are compared."""
    out = np.zeros(len(bench.z))
    a = frame.scale(sizes) * rng.standard_normal(frame.k)
    for part in frame.parts:
        own = np.where(part.fixed, 1.0, sizes.own) * rng.standard_normal(len(part.fixed))
        lasting = np.empty(len(part.rows))
        now = 0.0
        for i, (kept, new) in enumerate(zip(part.kept, rng.standard_normal(len(part.rows)), strict=True)):
            now = kept * now + np.sqrt(1.0 - kept**2) * new
            lasting[i] = now
        out[part.rows] = part.columns @ np.concatenate([a, own]) + sizes.lasting * part.lasts * lasting
        out[part.rows] += part.sigma * rng.standard_normal(len(part.rows))
    return out


def measured(bench: Bench, force: Array) -> list[PreparedRecord]:
    """The records with mean forces (n,) [N], their noise read from them as from those of a file."""
    records = [replace(r, force=force[at]) for r, at in zip(bench.records, bench.slices, strict=True)]
    return [replace(r, noise=noise(r, r.force)) for r in records]


def of_state(seed: int) -> dict[str, Any]:
    """A state that nobody knows: where the truth lies in its posterior."""
    rng = np.random.default_rng([seed, 1])
    bench, white = planned(rng, ["now"])
    levels = np.arange(numbers().level_low, 1.0 + 1e-9, 0.0025)
    prior = np.exp(log_prior(levels, NOTHING))
    j, i = divmod(int(rng.choice(prior.size, p=prior.ravel() / prior.sum())), len(levels))
    gas = float(SHARES[j])
    read = float(np.clip(levels[i] + rng.normal(0.0, numbers().level_tolerance), 0.0, 1.0))
    states = bench.states.copy()
    states[:, 0], states[:, 1] = read, gas
    bench.noisy(np.hypot(white, numbers().degraded * bench.peak))
    sizes = drawn_sizes(rng)
    force = bench.with_states(states) + drawn_errors(bench, Frame(bench, states), sizes, rng)
    seen = Bench(bench.given, measured(bench, force))
    began = time.monotonic()
    found = state(seen, range(len(seen.records)))
    mass = found.probability.sum(axis=(0, 1))
    low, high = found.interval()
    for some in (bench, seen):
        some.threads.shutdown()
    return {
        "seed": seed, "oil_level": float(levels[i]), "gas_preload": gas, "sizes": [sizes.law, sizes.own, sizes.lasting],
        "rank": float(mass[:i].sum() + rng.random() * mass[i]), "gas_lost": found.gas_lost, "interval": [low, high],
        "inside": bool(low - 1e-9 <= levels[i] <= high + 1e-9), "best": list(found.best),
        "found": [found.sizes.law, found.sizes.own, found.sizes.lasting],
        "seconds": round(time.monotonic() - began, 1),
    }  # fmt: skip


@dataclass(frozen=True)
class Hidden:
    """A mechanism that acts."""

    mechanism: Mechanism
    at: Array
    change: Array  # [N]


def drawn(several: Sequence[Mechanism], bench: Bench, base: dict[str, float], where: Array, rng: RNG) -> Hidden:
    """One of some mechanisms: of each effect as likely, its strengths from their priors, its law exact or off."""
    effect = rng.choice(sorted({m.effect for m in several}))
    own = [m for m in several if m.effect == effect]
    m = own[int(rng.integers(len(own)))].about(base)
    u = rng.standard_normal(len(m.strengths))
    u = np.clip(np.where([s.kind == "half" for s in m.strengths], np.abs(u), u), *m.ends)
    change = where * (bench.forces(base | m.values(u)) - bench.forces(base))
    if chance(rng, 0.5):
        columns = off_its_law(bench, change)
        change = change + columns @ rng.standard_normal(columns.shape[1])
    return Hidden(m, u, change)


def drawn_kind(rng: RNG) -> str:
    """Nothing, something unknown, one cause or two; another fill is not asked for."""
    n = numbers()
    any_cause = 1.0 - n.unchanged - n.other - n.misstated
    odds = np.array([n.unchanged, n.other, (1.0 - n.two) * any_cause, n.two * any_cause])
    return str(rng.choice([NONE, UNKNOWN, *CAUSES], p=odds / odds.sum()))


def of_changes(seed: int) -> dict[str, Any]:
    """What has happened since a reference: the probability of every hypothesis, and which is true."""
    rng = np.random.default_rng([seed, 2])
    bench, white = planned(rng, ["before", "after"])
    bench.noisy(white)
    acting = np.concatenate([np.full(len(r.time), r.name.startswith("after")) for r in bench.records])
    several = [m for m in mechanisms(bench) if m.effect in EFFECTS]
    n, always, force = numbers(), {}, bench.forces({})
    if rng.random() < n.lacking:
        hidden = drawn(several, bench, {}, np.ones(len(acting)), rng)
        always, force = hidden.mechanism.values(hidden.at), force + hidden.change
    kind = drawn_kind(rng)
    causes: list[Hidden] = []
    while len(causes) < CAUSES.get(kind, 0):
        left = [m for m in several if m.effect not in {c.mechanism.effect for c in causes}]
        causes.append(drawn(left, bench, always, acting, rng))
    force = force + sum((c.change for c in causes), np.zeros(len(force)))
    frame = Frame(bench, bench.states)
    if kind == UNKNOWN:
        shared = np.vstack([s for s, _, _ in bench.contributions(bench.states)])
        scale = np.where(frame.fixed_shared(shared.shape[1]), 1.0, rng.choice(n.change_sizes))
        force += acting * (shared @ (scale * rng.standard_normal(len(scale))))
    day, sizes = set_up(bench, acting), drawn_sizes(rng)
    force += day @ rng.standard_normal(day.shape[1]) + drawn_errors(bench, frame, sizes, rng)
    seen = Bench(bench.given, measured(bench, force))
    began = time.monotonic()
    with patch.object(method, "mechanisms", lambda *_: several):
        found = changes(seen, acting, [Fill()])
    truth = UNKNOWN if kind == UNKNOWN else named(bench, causes)
    for some in (bench, seen):
        some.threads.shutdown()
    return {
        "seed": seed, "truth": truth, "drawn": [c.mechanism.way for c in causes], "always": sorted(always),
        "base": [m.way for m in found.base], "sizes": [sizes.law, sizes.own, sizes.lasting],
        "probabilities": {h.name: h.probability for h in found.hypotheses}, "credible": list(found.credible),
        "seconds": round(time.monotonic() - began, 1),
    }  # fmt: skip


def named(bench: Bench, causes: Sequence[Hidden]) -> str:
    """What is true: what changes forces by less than the zero of a load cell is nothing."""
    least = numbers().zero * bench.peak
    return "+".join(sorted(c.mechanism.effect for c in causes if float(np.sqrt(np.mean(c.change**2))) > least)) or NONE


def bench_calibration(draws: int, keep: Path | None = None) -> dict[str, Any]:
    """Ranks and probabilities of `draws` states, and of half as many changes; those in `keep` count again."""
    parts: dict[str, tuple[Callable[[int], dict[str, Any]], int]] = {
        "state": (of_state, draws), "changes": (of_changes, (draws + 1) // 2),
    }  # fmt: skip
    with folder_of(keep) as folder, threadpool_limits(1):
        return figures(**{name: rows(one, count, folder / f"{name}.jsonl") for name, (one, count) in parts.items()})


def rows(one: Callable[[int], dict[str, Any]], count: int, path: Path) -> list[dict[str, Any]]:
    """The rows of the first seeds, of which those in a file are not drawn again."""
    path.parent.mkdir(parents=True, exist_ok=True)
    known = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()] if path.is_file() else []
    out = {row["seed"]: row for row in known}
    for seed in range(FIRST, FIRST + count):
        if seed not in out:
            out[seed] = one(seed)
            with path.open("a", encoding="utf-8") as file:
                file.write(json.dumps(out[seed]) + "\n")
    return [out[seed] for seed in range(FIRST, FIRST + count)]
