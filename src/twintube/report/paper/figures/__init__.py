"""The figures of the paper by number: the function that draws each, and the records of the virtual rig it needs."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from twintube.claims.table3_drives import BUMP
from twintube.report.common import style
from twintube.report.paper.context import Context
from twintube.report.paper.figures import drives, measurements, mechanism, studies, validation
from twintube.report.paper.records import Job, drive_jobs, harmonic_jobs, slow_jobs
from twintube.report.paper.statement import Plot

ALL = tuple(f"SA{i}" for i in range(1, 9))


def fitting(*names: str) -> list[Job]:
    """The records for the identification of these dampers."""
    return [job for name in names for job in (*harmonic_jobs(name), *slow_jobs(name)[:1])]


@dataclass(frozen=True)
class Entry:
    """A figure of the paper: how it is made, and from which records."""

    make: Callable[[Context], Plot]
    jobs: Callable[[], list[Job]] = list

    def draw(self, context: Context) -> Plot:
        """The figure with its notes: stand-ins and assumed values stand in the picture itself."""
        plot = self.make(context)
        style.notes(plot.figure, plot.notes)
        return plot


FIGURES: dict[int, Entry] = {
    3: Entry(measurements.figure_3, lambda: [j for n in ALL for j in measurements.jobs_3(n)]),
    5: Entry(partial(drives.strokes, number=5, first=3, last=7)),
    6: Entry(partial(drives.strokes, number=6, first=8, last=12)),
    7: Entry(measurements.figure_7, lambda: slow_jobs("SA7")),
    8: Entry(measurements.figure_8, lambda: [j for n in ALL for j in measurements.jobs_8(n)]),
    9: Entry(measurements.figure_9),
    10: Entry(measurements.figure_10),
    11: Entry(measurements.figure_11, lambda: [j for n in ALL for j in measurements.jobs_11(n)]),
    12: Entry(mechanism.figure_12),
    14: Entry(mechanism.figure_14),
    16: Entry(mechanism.figure_16),
    17: Entry(mechanism.figure_17),
    18: Entry(mechanism.figure_18),
    **{18 + i: Entry(partial(validation.work, name=f"SA{i}"), partial(fitting, f"SA{i}")) for i in range(1, 9)},
    27: Entry(validation.figure_27, partial(fitting, "SA7")),
    28: Entry(validation.figure_28, partial(fitting, "SA7")),
    29: Entry(partial(drives.bump, name="SA7"), lambda: [*fitting("SA7"), *drive_jobs("SA7", (BUMP,))]),
    30: Entry(partial(drives.bump, name="SA8"), lambda: [*fitting("SA8"), *drive_jobs("SA8", (BUMP,))]),
    31: Entry(partial(drives.bars, name="SA7"), lambda: [*fitting("SA7"), *drive_jobs("SA7")]),
    32: Entry(partial(drives.bars, name="SA8"), lambda: [*fitting("SA8"), *drive_jobs("SA8")]),
    33: Entry(studies.figure_33, partial(fitting, "SA8")),
    34: Entry(studies.figure_34),
}
