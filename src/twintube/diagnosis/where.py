"""Where the simulation is wrong: the residual over stroke, velocity, time and more, and whether it is more than noise."""

from collections.abc import Sequence

import numpy as np
from scipy.stats import norm

from twintube.arrays import Array
from twintube.diagnosis.result import Map, RecordResult

BINS = 16
FEW = 10  # samples a bin must hold
FALSE_ALARM = 0.01  # chance that the white noise of all records together shows structure in any
STRIKING = 1.5  # a bin stands out if its error is this much above the usual one


def coordinates(record: RecordResult) -> dict[str, tuple[str, Array]]:
    """Unit and values (n,) of every quantity over which the residual is shown."""
    c = record.case
    work = np.concatenate([[0.0], np.cumsum(np.abs(record.measured[1:] * np.diff(c.stroke)))])
    dt = np.maximum(np.gradient(c.time), 1e-6)
    half = max(float(np.ptp(c.stroke)) / 2, 1e-9)
    every = np.ones(len(c.time))
    return {
        "stroke": ("m", c.stroke),
        "velocity": ("m/s", c.velocity),
        "acceleration": ("m/s2", np.gradient(c.velocity) / dt),
        "time": ("s", c.time - c.time[0]),
        "cycle": ("", c.cycle.astype(float)),
        "dissipated energy": ("J", work),
        "oil level": ("1", c.oil_level * every),
        "frequency": ("Hz", c.top_speed / (2 * np.pi * half) * every),
    }


def maps(records: Sequence[RecordResult]) -> list[Map]:
    """The maps of all records together; residuals are measured less simulated."""
    found = []
    tables = [coordinates(r) for r in records]
    base = np.concatenate([(r.measured - r.base)[1:] for r in records])
    extended = np.concatenate([(r.measured - r.extended)[1:] for r in records])
    noise = np.concatenate([r.case.noise[1:] for r in records])
    for quantity in tables[0]:
        unit = tables[0][quantity][0]
        x = np.concatenate([table[quantity][1][1:] for table in tables])
        levels = np.unique(np.round(x, 4))
        few = len(levels) <= BINS
        edges = (
            np.quantile(x, np.linspace(0, 1, BINS + 1))
            if quantity == "acceleration"
            else np.linspace(x.min(), x.max(), BINS + 1)
        )
        place = (
            np.searchsorted(levels, np.round(x, 4))
            if few
            else np.clip(np.searchsorted(edges, x, side="right") - 1, 0, BINS - 1)
        )
        count = len(levels) if few else BINS
        rows = np.full((4, count), np.nan)
        for k in range(count):
            inside = place == k
            if inside.sum() >= FEW:
                rows[:, k] = (
                    np.sqrt(np.mean(base[inside] ** 2)), np.sqrt(np.mean(extended[inside] ** 2)),
                    np.sqrt(np.mean(noise[inside] ** 2)), np.mean(base[inside]),
                )  # fmt: skip
        centres = levels if few else (edges[1:] + edges[:-1]) / 2
        found.append(Map(quantity, unit, centres, rows[0], rows[1], rows[2], rows[3]))
    return found


def describe(found: Sequence[Map], left: bool = False) -> str:
    """The regions that stand out, of the base model or of what is left, the most striking first."""
    told = []
    for m in found:
        error = m.extended if left else m.base
        known = np.isfinite(error) & (m.noise > 0)
        if known.sum() < 2:
            continue
        excess = np.sqrt(np.maximum(error[known] ** 2 - m.noise[known] ** 2, 0.0))
        usual = float(np.median(excess))
        worst = int(np.argmax(excess))
        if excess[worst] > STRIKING * max(usual, 1e-9) and excess[worst] > m.noise[known][worst]:
            place = float(m.centres[known][worst])
            side = "above" if m.mean[known][worst] > 0 else "below"
            contrast = float(excess[worst] / max(usual, 1e-9))
            about = f"{m.quantity} {place:.3g} {m.unit}".strip()
            told.append((contrast, f"{about} ({error[known][worst]:.0f} N, measured {side} simulated)"))
    told.sort(reverse=True)
    return "largest at " + "; ".join(text for _, text in told[:3]) if told else "nowhere in particular"


def structured(records: Sequence[RecordResult], model: str) -> list[str]:
    """Names of the records in which the residual of a model (base, recalibrated, extended) is no white noise.

    The signs of neighbouring intervals agree in half of the cases then (Wald and Wolfowitz 1940); signs, as few intervals at
    force jumps would else decide.
    """
    limit = float(norm.isf(FALSE_ALARM / 2 / max(1, len(records))))
    found = []
    for r in records:
        signs = np.sign(r.measured - getattr(r, model))[1:]
        pairs = (signs[1:] * signs[:-1])[np.diff(r.case.stretch[1:]) == 0]
        if len(pairs) and abs(float(pairs.sum())) > limit * np.sqrt(len(pairs)):
            found.append(r.case.name)
    return found
