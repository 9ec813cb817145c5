"""How well the inspection study uses two processes."""

import os
import time
from typing import Any

from twintube.dampers import load
from twintube.inspection import conditions, study
from twintube.vehicle.cars import load_car

FEW, MANY = 20, 60  # samples: the difference of their times is free of what each run needs to begin
ROUNDS = 3


def seconds(count: int, processes: int) -> tuple[float, float]:
    """Time and processor time, of workers too, of a study of SA8 at four oil levels; start-up included."""
    levels = conditions((0.8, 0.6, 0.5, 0.4), gas_preload=0.0)
    begin, before = time.perf_counter(), os.times()
    study([load("SA8")], load_car(), levels, count=count, processes=processes)
    now = os.times()
    return time.perf_counter() - begin, sum(now[:4]) - sum(before[:4])


def bench_inspect() -> dict[str, Any]:
    """Seconds of work on one and two processes, of which start-up is not part, and the efficiency: their ratio over two.

    One and two are measured in turn, round by round. Where other work runs on the machine, the efficiency is that of what is
    left: `processor` is the share of the processors' time of two processes that one process would have needed too, which
    others do not disturb.
    """
    seconds(FEW, 1)
    rounds: dict[str, dict[str, float]] = {}
    for i in range(ROUNDS):
        times = {(n, p): seconds(n, p) for p in (1, 2) for n in (FEW, MANY)}
        (one, work_one), (two, work_two) = (
            [many - few for many, few in zip(times[MANY, p], times[FEW, p], strict=True)] for p in (1, 2)
        )
        rounds[f"round {i + 1}"] = {
            "seconds_on_one": one,
            "seconds_on_two": two,
            "start_up_of_two": times[FEW, 2][0] - two * FEW / (MANY - FEW),
            "efficiency": one / two / 2,
            "processor": work_one / work_two,
            "load_average": os.getloadavg()[0],
        }
    by_rank = sorted(found["efficiency"] for found in rounds.values())
    return {
        "samples": float(MANY - FEW),
        "rounds": rounds,
        "efficiency_least": by_rank[0],
        "efficiency_median": by_rank[len(by_rank) // 2],
        "efficiency_most": by_rank[-1],
    }
