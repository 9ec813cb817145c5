"""The figures of the paper by number: the function that draws each, and the records of the virtual rig it needs."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from twintube.report.paper.context import Context
from twintube.report.paper.figures import degraded, drives, intact, loops, mechanism, studies, validation
from twintube.report.paper.records import Job, drive_jobs, harmonic_jobs, slow_jobs
from twintube.report.paper.statement import Plot


def nothing() -> list[Job]:
    """No records: for figures without measurements."""
    return []


def fitting(*names: str) -> list[Job]:
    """The records for the identification of these dampers."""
    return [job for name in names for job in (*harmonic_jobs(name), *slow_jobs(name)[:1])]


@dataclass(frozen=True)
class Entry:
    """A figure of the paper: drawing function and records."""

    draw: Callable[[Context], Plot]
    jobs: Callable[[], list[Job]] = nothing


ALL = tuple(f"SA{i}" for i in range(1, 9))
FIGURES: dict[int, Entry] = {
    3: Entry(intact.figure_3, lambda: [j for n in ALL for j in intact.jobs_3(n)]),
    5: Entry(drives.figure_5),
    6: Entry(drives.figure_6),
    7: Entry(intact.figure_7, lambda: slow_jobs("SA7")),
    8: Entry(degraded.figure_8, lambda: [j for n in ALL for j in degraded.jobs_8(n)]),
    9: Entry(degraded.figure_9),
    10: Entry(degraded.figure_10),
    11: Entry(degraded.figure_11, lambda: [j for n in ALL for j in degraded.jobs_11(n)]),
    12: Entry(intact.figure_12),
    14: Entry(mechanism.figure_14),
    16: Entry(mechanism.figure_16),
    17: Entry(mechanism.figure_17),
    18: Entry(mechanism.figure_18),
    **{18 + i: Entry(partial(validation.work, name=f"SA{i}"), partial(fitting, f"SA{i}")) for i in range(1, 9)},
    27: Entry(loops.figure_27, partial(fitting, "SA7")),
    28: Entry(loops.figure_28, partial(fitting, "SA7")),
    **{n: Entry(partial(drives.bump, name=name), partial(drives.jobs_bump, name)) for n, name in ((29, "SA7"), (30, "SA8"))},
    **{
        n: Entry(partial(drives.bars, name=name), lambda name=name: [*fitting(name), *drive_jobs(name)])  # type: ignore[misc]
        for n, name in ((31, "SA7"), (32, "SA8"))
    },
    33: Entry(studies.figure_33, partial(fitting, "SA8")),
    34: Entry(studies.figure_34),
}
