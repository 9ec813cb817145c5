"""`python -m benchmarks NAME --json FILE`: kernel, fmu_step, quarter_car, identify, diagnosis, detection."""

import json
import os
import platform
import time
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from benchmarks.diagnosis import bench_detection, bench_diagnosis
from benchmarks.fmu import bench_fmu_step, bench_quarter_car
from benchmarks.timing import best
from twintube import compiled, effects, model
from twintube.identify import METHODS, Harmonic, Objective, minimise
from twintube.identify.objective import TABLE_6, TABLES_7_8
from twintube.parameters import Damper, load
from twintube.rig import BLOCKS, harmonic_block
from twintube.simulate import simulate, work_between
from twintube.variables import Derived, Flow, blank
from twintube.variants import NO_CAVITATION, NO_FOAM

FINER = 16  # steps of the truth per sample of a record
NOISE = 0.01  # of the peak force
SEEDS = (1, 2)  # of the comparison of the optimisers


def bench_kernel() -> dict[str, float]:
    """Time per step of the compiled and the interpreted kernel on one signal, SA8 at 60 % oil, 1.048 m/s."""
    damper = load("SA8").with_(oil_level=0.6, gas_preload=0)
    block = harmonic_block(1.048)
    n = len(block.stroke)
    work_between(damper, block.stroke, block.velocity, block.marks)
    fast = best(lambda: work_between(damper, block.stroke, block.velocity, block.marks))
    stroke, velocity = block.stroke.tolist(), block.velocity.tolist()

    def interpreted() -> None:
        p, d, s, f = damper.parameters, blank(Derived), blank(effects.State), blank(Flow)
        model.set_up(p, d)
        model.start(p, d, s, 0.0)
        before = velocity[0]
        for z, v in zip(stroke, velocity, strict=True):
            model.advance(p, d, s, f, z, before, v, 0.0)
            before = v

    slow = best(interpreted)
    return {"ns_per_step": fast / n * 1e9, "interpreted_ns_per_step": slow / n * 1e9, "speed_up": slow / fast}


def measured(damper: Damper, noise: float) -> list[Harmonic]:
    """The damper's own records of its degraded states, forces of a 16 times finer run with `noise` as share of the peak."""
    rng = np.random.default_rng(0)
    found = []
    for level in damper.measured_levels:
        for v in BLOCKS:
            block = harmonic_block(v, dt=4e-4 / FINER)
            fine = simulate(damper.with_(oil_level=level, gas_preload=0), block.stroke, block.velocity).force
            kept = np.unique(np.concatenate([np.arange(0, len(fine), FINER), block.marks]))
            force = fine[kept] + rng.normal(0, noise * np.abs(fine).max(), len(kept))
            marks = np.searchsorted(kept, block.marks)
            found.append(Harmonic(level, 0, block.time[kept], block.stroke[kept], block.velocity[kept], force, marks))
    return found


def bench_identify() -> dict[str, float]:
    """The paper's identification and the optimisers on one budget.

    The paper's: 2 levels, 8 velocities, 48 x 100 for Table 6, 120 x 500 for Tables 7 and 8. The optimisers: all 14
    parameters together, 40 x 250, error of equation 43 as mean over the seeds, beside that of the true parameters.
    """
    damper = load("SA8")
    records = measured(damper, NOISE)
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
    names = (*TABLE_6, *TABLES_7_8)
    every = Objective(damper, names, records, with_work=True)
    for method in METHODS:
        ends = [
            minimise(every, every.bounds, method=method, population=40, generations=250, seed=seed).error for seed in SEEDS
        ]
        figures[f"error_{method}"] = float(np.mean(ends))
    truth = np.array([[getattr(damper.parameters, name) for name in names]])
    return figures | {"error_at_truth": float(every(truth)[0])}


BENCHMARKS = {
    "kernel": bench_kernel,
    "fmu_step": bench_fmu_step,
    "quarter_car": bench_quarter_car,
    "identify": bench_identify,
}
SEEDED: dict[str, Callable[[int, Path | None], dict[str, Any]]] = {
    "diagnosis": bench_diagnosis,
    "detection": bench_detection,
}
NAMES = ", ".join((*BENCHMARKS, *SEEDED))
app = typer.Typer(add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)


@app.command(epilog="Example: python -m benchmarks kernel --json kernel.json")
def main(
    name: Annotated[str, typer.Argument(help=f"One of {NAMES}.")],
    json_file: Annotated[Path | None, typer.Option("--json", help="Write the figures to this file.")] = None,
    seeds: Annotated[int, typer.Option(min=1, help="Datasets of each kind, for diagnosis and detection.")] = 10,
    keep: Annotated[
        Path | None,
        typer.Option(help="File that outcomes of diagnosis or detection are added to; those in it are not run again."),
    ] = None,
) -> None:
    """Measure speed and print a table; short jobs are run several times, the shortest time counts.

    diagnosis and detection measure hit rates on hidden causes and take hours with 10 seeds.
    """
    if name not in (*BENCHMARKS, *SEEDED):
        typer.echo(f"error: unknown benchmark {name}: must be one of {NAMES}", err=True)
        raise typer.Exit(2)
    compiled.module()
    figures: dict[str, Any] = BENCHMARKS[name]() if name in BENCHMARKS else SEEDED[name](seeds, keep)
    typer.echo(f"{platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}")
    for key, value in figures.items():
        if isinstance(value, float):
            typer.echo(f"{key:32}{value:12.3f}")
        elif isinstance(value, dict):
            typer.echo(f"{key}:")
            for row, cells in value.items():
                told = ", ".join(f"{what} {n:g}" for what, n in cells.items()) if isinstance(cells, dict) else f"{cells:g}"
                typer.echo(f"  {row:34}{told}")
    if json_file is not None:
        json_file.write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    app()
