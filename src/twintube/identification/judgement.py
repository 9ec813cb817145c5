"""What an identified parameter set is good for, in words, and what to do next."""

from collections.abc import Sequence

import numpy as np

from twintube.common.words import counted, listed
from twintube.identification.dataset import Result
from twintube.identification.remarks import reach
from twintube.identification.validation import Validated

# An effect is told from an error of a third of it: three standard deviations, the usual limit of detection.
TOLD = 1 / 3
FULL = 1.0  # oil level
USE = 'copy identified.toml into the dataset\'s folder and set damper = "identified.toml" in its dataset.toml'


def judgement(result: Result) -> list[str]:
    """A sentence on the full damper and one on oil loss, where there are records of it, by those held out if there are."""
    full = [row for row in result.validation if row.oil_level >= FULL]
    less = [row for row in result.validation if row.oil_level < FULL and row.force_rmse_full is not None]
    sentences = []
    if full:
        some, where = judged(full)
        error, size = overall([row.force_rmse for row in some]), overall([row.force_rms for row in some])
        figures = f"error {error:.1f} N of {size:.0f} N ({error / size:.1%}), {where}"
        sentences.append(f"{verdict(error, size)} for the full damper up to {fastest(full):.3g} m/s: {figures}")
    if less:
        some, where = judged(less)
        error, effect = overall([row.force_rmse for row in some]), overall([row.force_rmse_full or 0.0 for row in some])
        lost = FULL - float(np.mean([row.oil_level for row in some]))
        levels = f"{min(row.oil_level for row in less):.0%}"
        text = f"{verdict(error, effect)} for oil levels down to {levels} up to {fastest(less):.3g} m/s: error {error:.1f} N"
        text += f", where the lost oil makes {effect:.1f} N"
        if error < effect:
            text += f"; the error weighs as much as {100 * lost * error / effect:.2g} % of the oil"
        sentences.append(f"{text}, {where}")
    blind = [e.name for e in result.identification.estimates if not e.determined]
    if blind:
        sentences.append(f"not for comparing {listed(blind, 14)} with those of another damper: the records do not tell them")
    return [text[0].upper() + text[1:] + "." for text in sentences]


def verdict(error: float, effect: float) -> str:
    """Usable, rough or not usable: an error against the size of what is to be told [N]."""
    return "usable" if error <= TOLD * effect else "rough, for a trend only," if error < effect else "not usable"


def judged(rows: Sequence[Validated]) -> tuple[list[Validated], str]:
    """The records that a judgement rests on, and which they are."""
    held = [row for row in rows if row.split == "heldout"]
    return (
        (held, f"on {counted(len(held), 'record')} that {'was' if len(held) == 1 else 'were'} not fitted")
        if held
        else (list(rows), "on fitted records")
    )


def next_step(result: Result, folder: str = "identified") -> str:
    """What to do or measure next, the most important first."""
    identified, rows = result.identification, result.validation
    error, effect = (overall([value(row) for row in judged(rows)[0]]) for value in (error_of, scale))
    if error > TOLD * effect:
        worst = max(rows, key=lambda row: row.force_rmse / max(scale(row), 1e-9))
        return f"look at {worst.name} in {folder}/report.html and run twintube check; then twintube diagnose on the dataset"
    if round(identified.offset, 1) > 0.0:
        return (
            f"take the load cell's zero of {identified.offset:.1f} N out (offset in channels, dataset.toml), identify again"
        )
    if all(row.split != "heldout" for row in rows):
        return "measure five velocities or more in each state: some are then not fitted and show whether the set predicts"
    if not identified.steps:
        return "for oil loss, measure one or two oil levels without preload at the same velocities, and identify again"
    if any(not e.determined for e in identified.estimates):
        top = reach([h for h, _ in result.harmonics])
        return f"{USE}; for what is not determined, measure other oil levels or beyond {top:.3g} m/s"
    return f"{USE}; twintube diagnose then looks for what has changed"


def error_of(row: Validated) -> float:
    """Error of a record [N]."""
    return row.force_rmse


def scale(row: Validated) -> float:
    """What an error of this record is measured against [N]: the effect of the lost oil, else the force."""
    return row.force_rms if row.force_rmse_full is None else row.force_rmse_full


def fastest(rows: Sequence[Validated]) -> float:
    """Largest velocity [m/s]."""
    return max(row.top_speed for row in rows)


def overall(values: Sequence[float]) -> float:
    """Root mean square of figures of records."""
    return float(np.sqrt(np.mean(np.square(values))))
