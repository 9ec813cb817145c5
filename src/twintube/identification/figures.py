"""The figures that `twintube identify` reports: as JSON takes them, per split and as a line."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from twintube.common.words import counted
from twintube.core.effects import Parameters
from twintube.data.records.condition import is_intact
from twintube.identification.dataset import Result
from twintube.identification.judgement import judgement, next_step
from twintube.identification.remarks import EQUAL_SPEEDS
from twintube.identification.validation import Validated


def unit(name: str) -> str:
    """Unit of a parameter."""
    return str(Parameters.__dataclass_fields__[name].metadata["unit"])


def summary(result: Result, folder: str = "identified") -> dict[str, Any]:
    """The result as JSON takes it; `folder` is where identified.toml is written."""
    identified = result.identification
    return {
        "dataset": result.dataset.title,
        "damper": identified.damper.name,
        "judgement": judgement(result),
        "next_step": next_step(result, folder),
        "remarks": result.remarks,
        "steps": [
            {
                "title": s.title, "parameters": s.names, "error": s.best.error, "unit": s.unit,
                "evaluations": s.best.evaluations,
            }
            for s in identified.steps
        ],
        "parameters": {
            e.name: {
                "value": e.value, "unit": unit(e.name), "interval": [e.low, e.high], "bounds": e.bounds,
                "determined": e.determined, "at_bound": e.at_bound,
            }
            for e in identified.estimates
        },
        "not_told_apart": [{"parameters": [a, b], "correlation": c} for a, b, c in identified.pairs],
        "force_offset_N": identified.offset,
        "validation": [asdict(row) for row in result.validation],
        "heldout": totals(result.validation, "heldout"),
        "fit": totals(result.validation, "fit"),
    }  # fmt: skip


def totals(rows: Sequence[Validated], split: str) -> dict[str, Any] | None:
    """Errors over the records of a split: force as RMSE, of sines and drives alike, and works of the sines.

    Works are relative to the measured and to the intact work. The latter says more where a degraded damper does little work:
    3 J of 10 J are little against the intact 100 J.
    """
    some = [row for row in rows if row.split == split]
    if not some:
        return None
    shares = [row.force_rmse / row.force_peak for row in some]
    figures: dict[str, Any] = {
        "records": len(some),
        "stochastic": sum(row.measurement == "stochastic" for row in some),
        "force_rmse_N": float(np.sqrt(np.mean([row.force_rmse**2 for row in some]))),
        "force_rmse_of_peak": float(np.mean(shares)),
        "force_rmse_of_peak_worst": max(shares),
        "worst": some[int(np.argmax(shares))].name,
    }
    over_noise = [row.force_rmse_recorded for row in some if row.force_rmse_recorded is not None]
    if over_noise:
        figures["force_rmse_recorded_N"] = float(np.sqrt(np.mean(np.square(over_noise))))
    harmonics = [row for row in some if row.measurement == "harmonic"]
    errors = np.array([
        [abs(s - m) / abs(m) for s, m in zip(row.work_simulated, row.work_measured, strict=True)] for row in harmonics
    ])  # fmt: skip
    for i, which in enumerate(("first", "last")) if harmonics else ():
        figures[f"work_error_{which}"] = float(np.median(errors[:, i]))
        figures[f"work_error_{which}_worst"] = float(errors[:, i].max())
        relative = [of_intact(row, rows, i) for row in harmonics]
        known = [value for value in relative if value is not None]
        figures[f"work_error_{which}_of_intact"] = float(np.median(known)) if known else None
        figures[f"work_error_{which}_of_intact_worst"] = max(known) if known else None
    return figures


def table(result: Result) -> list[str]:
    """The identified parameters for a terminal; nothing where there are none."""
    if not result.identification.estimates:
        return []
    lines = [f"{'parameter':15}{'value':>10} {'unit':6}{'interval (95 % for all together)':34}note"]
    for e in result.identification.estimates:
        doubts = ["not determined"] * (not e.determined) + ["at its bound"] * e.at_bound
        between = f"{e.low:.3g} to {e.high:.3g}"
        lines.append(f"{e.name:15}{e.value:10.3g} {unit(e.name):6}{between:34}{', '.join(doubts)}".rstrip())
    return lines


def headline(part: dict[str, Any]) -> str:
    """A line about the errors of a split."""
    drives = f", {part['stochastic']} of them stochastic" if part["stochastic"] else ""
    text = f"{counted(part['records'], 'record')}{drives}: force {part['force_rmse_N']:.1f} N "
    text += f"({part['force_rmse_of_peak']:.1%} of the peak; worst {part['force_rmse_of_peak_worst']:.1%}, {part['worst']})"
    if "force_rmse_recorded_N" in part:
        text += f", {part['force_rmse_recorded_N']:.1f} N over the noisy strokes as recorded"
    if "work_error_first" in part:
        first, last = (part[f"work_error_{which}"] for which in ("first", "last"))
        text += f", work of the first oscillation {first:.1%} off, of the last {last:.1%}"
    return text


def of_intact(row: Validated, rows: Sequence[Validated], i: int) -> float | None:
    """Error of a record's first or last work relative to that of the intact damper at an equal velocity."""
    for other in rows:
        full = is_intact(other.oil_level, other.gas_preload) and other.measurement == "harmonic"
        if full and row.top_speed / EQUAL_SPEEDS <= other.top_speed <= EQUAL_SPEEDS * row.top_speed:
            return abs(row.work_simulated[i] - row.work_measured[i]) / abs(other.work_measured[i])
    return None
