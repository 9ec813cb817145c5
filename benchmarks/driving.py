"""How long the study of drives takes, and how well it uses two processes."""

import tempfile
import time
from pathlib import Path
from typing import Any

from twintube.driving.study import Plan, run

FEW, MANY = 10, 50  # drives: the difference of their times is free of what each run needs to begin
MINUTES = 5.0
WHOLE = 1000  # drives that the time is said for


def seconds(drives: int, processes: int) -> float:
    """Time of a study, start-up included."""
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        run(Plan(drives, MINUTES), Path(folder) / "drives.parquet", processes=processes)
        return time.perf_counter() - begin


def bench_driving() -> dict[str, Any]:
    """Seconds of work on one and two processes, of which start-up is not part, and the efficiency: their ratio over two."""
    seconds(1, 1)
    one, two = (seconds(MANY, processes) - seconds(FEW, processes) for processes in (1, 2))
    each = (MANY - FEW) * MINUTES
    return {
        "minutes_of_a_drive": MINUTES,
        "seconds_per_minute_on_one": one / each,
        "seconds_per_minute_on_two": two / each,
        f"hours_for_{WHOLE}_drives_on_two": two / each * MINUTES * WHOLE / 3600.0,
        "efficiency": one / two / 2.0,
    }
