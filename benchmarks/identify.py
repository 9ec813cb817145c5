"""Speed of the identification, and its optimisers on an equal budget."""

import time
from collections.abc import Sequence

import numpy as np

from benchmarks.kernel import bench_kernel
from twintube.dampers import Damper, load
from twintube.dampers.variants import NO_CAVITATION, NO_FOAM
from twintube.engine.simulate import simulate
from twintube.fitting.parameters import DEGRADATION, TABLE_6, TABLES_7_8
from twintube.identification import METHODS, Harmonic, Objective, minimise
from twintube.rig.signals import BLOCKS, harmonic_block

FINER = 16  # steps of the truth per sample: its forces are means over a step, a sensor's are not
NOISE = 0.01  # of the peak force
SEEDS = (1, 2)  # of the comparison of the optimisers


def records_of(damper: Damper, velocities: Sequence[float], noise: float, seed: int = 0) -> list[Harmonic]:
    """Finely sampled records of the degraded states at `velocities` [m/s], with noise as a share of the peak force."""
    rng = np.random.default_rng(seed)
    records = []
    for level in damper.measured_levels:
        for v in velocities:
            block = harmonic_block(v, dt=4e-4 / FINER)
            fine = simulate(damper.with_(oil_level=level, gas_preload=0), block.stroke, block.velocity).force
            kept = np.unique(np.concatenate([np.arange(0, len(fine), FINER), block.marks]))
            force = fine[kept] + rng.normal(0, noise * np.abs(fine).max(), len(kept))
            marks = np.searchsorted(kept, block.marks)
            records.append(Harmonic(level, 0, block.time[kept], block.stroke[kept], block.velocity[kept], force, marks))
    return records


def bench_identify() -> dict[str, float]:
    """The paper's identification, and the optimisers on an equal budget.

    The paper's: 2 levels, 8 velocities, 48 x 100 for Table 6, 120 x 500 for Tables 7 and 8. The optimisers: all 14
    parameters together, 40 x 250, error of equation 43 as mean over the seeds, and that of the true parameters.
    """
    damper = load("SA8", as_published=True)
    records = records_of(damper, BLOCKS, NOISE)
    basic = damper.with_(**NO_FOAM, **NO_CAVITATION)
    slow = Objective(basic, TABLE_6, [r for r in records if r.top_speed <= 0.53], with_work=False)
    full = Objective(damper, TABLES_7_8, records, with_work=True)
    slow(slow.bounds[:, 0][None])
    start = time.perf_counter()
    third = minimise(slow, slow.bounds, population=48, generations=100)
    fourth = minimise(full, full.bounds, population=120, generations=500)
    seconds = time.perf_counter() - start
    steps = third.evaluations * len(slow.z) + fourth.evaluations * len(full.z)
    slow_step = bench_kernel()["interpreted_ns_per_step"] * 1e-9
    figures = {
        "seconds": seconds,
        "evaluations": float(third.evaluations + fourth.evaluations),
        "speed_up_over_interpreted": steps * slow_step / seconds,
    }
    every = Objective(damper, DEGRADATION, records, with_work=True)
    for method in METHODS:
        ends = [
            minimise(every, every.bounds, method=method, population=40, generations=250, seed=seed).error for seed in SEEDS
        ]
        figures[f"error_{method}"] = float(np.mean(ends))
    truth = np.array([[getattr(damper.parameters, name) for name in DEGRADATION]])
    return figures | {"error_at_truth": float(every(truth)[0])}
