"""How times are taken."""

import time
from collections.abc import Callable

REPEATS = 5


def best(job: Callable[[], object]) -> float:
    """Shortest of several times [s]: the one least disturbed by the rest of the machine."""
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        job()
        times.append(time.perf_counter() - start)
    return min(times)
