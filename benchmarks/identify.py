"""How surely and how fast the identification finds what the truth explains: its search and the paper's optimisers."""

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from twintube.dampers import Damper, load
from twintube.engine.simulate import simulate
from twintube.fitting.parameters import DEGRADATION
from twintube.identification import PAPER, Harmonic, Objective, identify_damper
from twintube.identification.optimise import Best
from twintube.identification.together import search, together
from twintube.rig.signals import BLOCKS, harmonic_block

FINER = 16  # steps of the truth per sample: its forces are means over a step, a sensor's are not
NOISE = 0.01  # of the peak force
SEEDS = 2  # unless more are asked for
DAMPERS = ("SA8", "SA1")  # rear and front
EQUAL = (40, 250)  # population and generations of the other optimisers, twice the evaluations of the default
FEW = 2  # most seeds of the other optimisers, which take longer


def records_of(damper: Damper, velocities: Sequence[float], noise: float, seed: int = 0) -> list[Harmonic]:
    """Finely sampled records of the degraded states at `velocities` [m/s], with noise as a share of the peak force."""
    return noisy(clean(damper, velocities), noise, seed)


def clean(damper: Damper, velocities: Sequence[float]) -> list[Harmonic]:
    """The same without noise."""
    records = []
    for level in damper.measured_levels:
        for v in velocities:
            block = harmonic_block(v, dt=4e-4 / FINER)
            fine = simulate(damper.with_(oil_level=level, gas_preload=0), block.stroke, block.velocity).force
            kept = np.unique(np.concatenate([np.arange(0, len(fine), FINER), block.marks]))
            marks = np.searchsorted(kept, block.marks)
            record = Harmonic(level, 0, block.time[kept], block.stroke[kept], block.velocity[kept], fine[kept], marks)
            records.append(record)
    return records


def noisy(records: Sequence[Harmonic], noise: float, seed: int) -> list[Harmonic]:
    """The records with noise as a share of their peak forces."""
    rng = np.random.default_rng(seed)
    return [replace(r, force=r.force + rng.normal(0, noise * np.abs(r.force).max(), len(r.force))) for r in records]


def bench_identify(seeds: int = SEEDS) -> dict[str, Any]:
    """All 14 parameters together from 2 levels at 8 velocities: how often the error of the true parameters is reached.

    The records of each seed have noise of their own. An error below that of the truth is fitted noise. `whole` is an
    identification from these records from end to end, with its intervals. CPU time, as the cores may have other work.
    """
    tables: dict[str, Any] = {}
    methods: dict[str, Callable[..., Best]] = {
        "default": partial(together, size=PAPER.together),
        **{name: partial(search, size=EQUAL, method=name) for name in ("de", "pso")},
    }
    for name in DAMPERS:
        damper = load(name, as_published=True)
        ideal = clean(damper, BLOCKS)
        truth = np.array([[getattr(damper.parameters, key) for key in DEGRADATION]])
        for how, method in methods.items():
            if how != "default" and name != DAMPERS[0]:
                continue
            ends, floors, seconds, evaluations = [], [], [], []
            for seed in range(1, (seeds if how == "default" else min(seeds, FEW)) + 1):
                objective = Objective(damper, DEGRADATION, noisy(ideal, NOISE, seed), with_work=True)
                floors.append(float(objective(truth)[0]))
                begin = time.process_time()
                best = method(objective, seed=seed)
                seconds.append(time.process_time() - begin)
                ends.append(best.error)
                evaluations.append(best.evaluations)
            tables[f"{name}, {how}"] = {
                "seeds": len(ends), "reached the truth's error": sum(e <= f for e, f in zip(ends, floors, strict=True)),
                "truth [N + J]": median(floors), "error [N + J]": median(ends), "worst [N + J]": round(max(ends), 2),
                "evaluations": median(evaluations), "CPU time [s]": median(seconds),
            }  # fmt: skip
    damper = load(DAMPERS[0], as_published=True)
    records = records_of(damper, BLOCKS, NOISE, 1)
    begin = time.process_time()
    identify_damper(damper, None, [], records)
    return {"searches": tables, "whole identification, CPU time [s]": time.process_time() - begin}


def median(values: Sequence[float]) -> float:
    """The median with two decimals."""
    return round(float(np.median(values)), 2)
