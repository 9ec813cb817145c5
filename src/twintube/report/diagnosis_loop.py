"""The picture of the answer: measured and simulated loops of the held-out record that shows the cause best."""

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from twintube.diagnosis.result import Diagnosis, RecordResult
from twintube.report import style
from twintube.report.diagnosis_records import (
    BASE,
    KINDS,
    broken,
    closed,
    compared,
    drawn,
    format_of,
    middle,
    name_of,
    oscillations,
    parts,
)

WIDE, NARROW = (9.6, 3.9), (4.3, 6.0)  # [inch], for a page of 1200 and of 400 pixels


OPEN = 0.05  # of the range of the stroke: an oscillation that ends farther from its beginning is not a loop


def telling(d: Diagnosis) -> RecordResult:
    """The record, held out if any is, in which the error falls most relative to its largest force.

    Where nothing is named it is the record whose error stands out most from its noise; where records do not belong to the
    others, the one that is off most.
    """
    if d.left_out:
        return max(d.left_out, key=lambda r: r.rms(r.base) / r.record.peak)
    best = compared(d)[1:]

    def worth(r: RecordResult) -> tuple[bool, bool, float]:
        error = r.rms(r.base)
        size = (error - r.rms(best[0].force(r))) / r.record.peak if best else error / r.noise
        return r.split == "heldout", bool(oscillations(r.record)), size

    return max(d.records, key=worth)


def typical(d: Diagnosis, result: RecordResult) -> tuple[str, NDArray[np.int64]]:
    """The whole oscillation in which base model and best model, or else measurement, differ most; without any the record."""
    record, block = result.record, oscillations(result.record)
    if not block:
        return parts(record)[0]
    best = compared(d)[1:]
    apart = (result.weight * (result.base - (best[0].force(result) if best else result.measured))) ** 2
    reach = max(float(np.ptp(record.stroke[ends])) for ends in block)

    def whole(ends: NDArray[np.int64]) -> bool:
        gap = abs(float(record.stroke[ends[-1]] - record.stroke[ends[0] - 1]))
        full = float(np.ptp(record.stroke[ends])) > (1 - OPEN) * reach
        return full and gap < OPEN * reach and bool((result.weight[ends] > 0).all())

    at = max(range(len(block)), key=lambda i: (whole(block[i]), float(apart[block[i]].mean())))
    return f"oscillation {at + 1} of {len(block)}", closed(record, block[at])


def answer_loop(d: Diagnosis, narrow: bool = False) -> Figure:
    """Force over stroke and over velocity, side by side or one below the other."""
    result = telling(d)
    record = result.record
    _, ends = typical(d, result)
    figure, axes = style.canvas(*((2, 1) if narrow else (1, 2)), NARROW if narrow else WIDE, sharey=True)
    for ax, signal, factor, label in zip(
        axes.flat, (record.stroke, record.velocity), (1e3, 1.0), ("stroke [mm]", "velocity [m/s]"), strict=True
    ):
        at = middle(signal, ends) * factor
        ax.plot(at, result.measured[ends], "o", color=style.INK, ms=3, mew=0, zorder=3, label="measured")
        for model in [BASE] if d.left_out else drawn(result, compared(d)):
            force = broken(result, model.force(result), ends)
            ax.plot(at, force, format_of(model, record), color=model.colour, lw=1.7, ms=8, label=model.label)
        ax.set_xlabel(label)
    for ax in axes.flat if narrow else axes[0, :1]:
        ax.set_ylabel("force [N]")
    style.legend_above(figure, axes[0, 0], columns=2 if narrow else 6)
    return figure


def caption(d: Diagnosis) -> str:
    """What the picture shows."""
    result = telling(d)
    unknown = "the models do not know it" if result.record.tenth is None else "every second tenth of it in turn"
    held = KINDS[result.split] + (f": {unknown}" if result.split == "heldout" else "")
    which, _ = typical(d, result)
    return f"Record {result.record.name} ({name_of(result)}; {held}), {which}."
