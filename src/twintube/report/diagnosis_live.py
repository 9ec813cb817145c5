"""The records of a diagnosis to look into: measured, and as the models have them."""

import numpy as np

from twintube.diagnosis.result import Diagnosis, RecordResult
from twintube.readable import amount
from twintube.report import style
from twintube.report.diagnosis_records import KINDS, broken, middle, models, name_of, oscillations, ranked
from twintube.report.live import Curve, Look, live

MOST = 12  # records, those of the largest base error first


def curves(d: Diagnosis) -> list[Curve]:
    """Measured force and the models that differ; a recalibration beside an extended model is off at first."""
    several = models(d)
    middle_ones = several[1:-1]
    return [
        Curve("measured", "measured", style.INK),
        *(Curve(m.name, m.label, m.colour, (6, 4) if m.dash == "--" else (), m not in middle_ones) for m in several),
    ]


def look(d: Diagnosis, result: RecordResult) -> Look:
    """A record, or its main block where it has one, at the middles of the compared intervals."""
    record, block = result.record, oscillations(result.record)
    ends = np.concatenate(block) if block else np.flatnonzero(record.stretch[1:] == record.stretch[:-1]) + 1
    marks = np.cumsum([0, *map(len, block)]).tolist() if block else []
    forces = {m.name: broken(result, m.force(result), ends) for m in models(d)}
    errors = ", ".join(f"{m.label} {amount(result.rms(m.force(result)), 'N')}" for m in models(d))
    where = KINDS[result.split]
    return Look(
        f"{record.name}: {name_of(result)}",
        f"{where[0].upper()}{where[1:]} record; root mean square error: {errors}; noise floor {amount(result.noise, 'N')}.",
        middle(record.time, ends),
        middle(record.stroke, ends),
        middle(record.velocity, ends),
        {"measured": broken(result, record.force, ends), **forces},
        marks,
    )


def live_part(d: Diagnosis) -> str:
    """The part of the page; empty without records."""
    return live(curves(d), [look(d, result) for result in ranked(d)[:MOST]])
