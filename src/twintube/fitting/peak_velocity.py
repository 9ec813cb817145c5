"""Force over velocity as dynamometers tell it: at the largest velocity, about it, and where the stroke is midway."""

import csv
import io
import itertools
from collections.abc import Sequence
from dataclasses import astuple, dataclass
from datetime import datetime

import numpy as np

from twintube.fitting.harmonic import Harmonic

WINDOW = 0.1  # of the largest velocity: the usual width
SAME_TIME = datetime(1980, 1, 1)  # as zip files without a time have it, so that equal sheets are equal files
COLUMNS = ("record", "direction", "oscillations", "velocity_m_s", "force_peak_N", "force_window_N", "force_crossing_N")


@dataclass(frozen=True)
class PeakVelocity:
    """One direction of a record; medians over its oscillations, signs as of velocity and force."""

    record: str
    direction: str  # rebound | compression
    oscillations: int
    velocity: float  # the largest [m/s]
    at_peak: float  # force [N] then
    window: float  # mean force [N] while the velocity is within WINDOW of the largest
    crossing: float  # force [N] where the stroke passes the middle of its oscillation


def peak_velocities(records: Sequence[Harmonic]) -> list[PeakVelocity]:
    """Both directions of all records, by rising velocity; without oscillations whose force says nothing at the peak."""
    rows = []
    for record in records:
        for direction, sign in (("rebound", 1.0), ("compression", -1.0)):
            found = [
                one
                for a, b in itertools.pairwise(record.marks.tolist())
                if (one := evaluated(record, slice(a, b + 1), sign))
            ]
            if found:
                rows.append(PeakVelocity(record.name, direction, len(found), *np.median(found, axis=0).tolist()))
    return sorted(rows, key=lambda row: (row.direction == "compression", abs(row.velocity)))


def evaluated(record: Harmonic, span: slice, sign: float) -> tuple[float, float, float, float] | None:
    """Velocity [m/s] and the three forces [N] of a direction of one oscillation; None where a force says nothing."""
    stroke, velocity, force = record.stroke[span], sign * record.velocity[span], record.force[span]
    top = int(np.argmax(velocity))
    near = velocity >= (1.0 - WINDOW) * velocity[top]
    middle = sign * (stroke - 0.5 * (stroke.max() + stroke.min()))
    passed = np.flatnonzero((middle[:-1] < 0) & (middle[1:] >= 0))
    if not record.counts(span)[near].all() or len(passed) == 0:
        return None
    i = int(passed[0])
    share = -middle[i] / (middle[i + 1] - middle[i])
    at_middle = force[i] + share * (force[i + 1] - force[i])
    return float(sign * velocity[top]), float(force[top]), float(force[near].mean()), float(at_middle)


def as_csv(rows: Sequence[PeakVelocity]) -> str:
    """The rows with a head, as a table of comma-separated values."""
    text = io.StringIO()
    lines = csv.writer(text, lineterminator="\n")
    lines.writerow(COLUMNS)
    for row in rows:
        numbers = (f"{x:.6g}" for x in (row.velocity, row.at_peak, row.window, row.crossing))
        lines.writerow([row.record, row.direction, row.oscillations, *numbers])
    return text.getvalue()


def as_xlsx(rows: Sequence[PeakVelocity]) -> bytes:
    """The same rows as a sheet; needs the package xlsxwriter."""
    import xlsxwriter

    file = io.BytesIO()
    # The names of records are words, whatever they begin with.
    with xlsxwriter.Workbook(file, {"in_memory": True, "strings_to_formulas": False, "strings_to_urls": False}) as book:
        book.set_properties({"created": SAME_TIME})
        sheet = book.add_worksheet("force over velocity")
        for i, line in enumerate([COLUMNS, *map(astuple, rows)]):
            sheet.write_row(i, 0, line)
        sheet.freeze_panes(1, 0)
        sheet.autofit()
    return file.getvalue()
