"""Where the simulation is wrong: the residual over stroke, velocity, time and more, and whether it is more than noise."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

from twintube.arrays import Array
from twintube.diagnosis.result import Map, RecordResult
from twintube.diagnosis.rules import RULES
from twintube.readable import unit_of


def coordinates(result: RecordResult) -> dict[str, tuple[str, Array]]:
    """Unit and values (n,) of every quantity over which the residual is shown."""
    c = result.record
    work = np.concatenate([[0.0], np.cumsum(np.abs(result.measured[1:] * np.diff(c.stroke)))])
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
    """The maps of all intervals that are compared; residuals are measured less simulated."""
    tables = [coordinates(r) for r in records]
    compared = np.concatenate([r.weight[1:] > 0.0 for r in records])
    base = np.concatenate([(r.measured - r.base)[1:] for r in records])[compared]
    extended = np.concatenate([(r.measured - r.extended)[1:] for r in records])[compared]
    noise = np.concatenate([r.record.noise[1:] for r in records])[compared]
    drawn = []
    for quantity, (unit, _) in tables[0].items():
        x = np.concatenate([table[quantity][1][1:] for table in tables])[compared]
        centres, place = binned(quantity, x)
        rows = np.full((4, len(centres)), np.nan)
        for k in range(len(centres)):
            inside = place == k
            if inside.sum() >= RULES.bin_samples:
                rows[:, k] = (
                    np.sqrt(np.mean(base[inside] ** 2)), np.sqrt(np.mean(extended[inside] ** 2)),
                    np.sqrt(np.mean(noise[inside] ** 2)), np.mean(base[inside]),
                )  # fmt: skip
        drawn.append(Map(quantity, unit, centres, rows[0], rows[1], rows[2], rows[3]))
    return drawn


def binned(quantity: str, x: Array) -> tuple[Array, NDArray[np.int64]]:
    """Centres (b,) of the bins of a quantity and the bin of each value (n,); few values are bins of their own."""
    levels = np.unique(np.round(x, 4))
    if len(levels) <= RULES.bins:
        return levels, np.searchsorted(levels, np.round(x, 4))
    if quantity == "acceleration":  # its ends are those of few samples
        edges = np.quantile(x, np.linspace(0, 1, RULES.bins + 1))
    else:
        edges = np.linspace(x.min(), x.max(), RULES.bins + 1)
    place = np.clip(np.searchsorted(edges, x, side="right") - 1, 0, RULES.bins - 1)
    return (edges[1:] + edges[:-1]) / 2, place


def describe(several: Sequence[Map], left: bool = False) -> str:
    """The regions that stand out, of the base model or of what is left, the most striking first; or a constant."""
    regions: list[tuple[float, str]] = []
    everywhere = "" if left else constant(several)
    if everywhere:
        return everywhere
    for m in several:
        error = m.extended if left else m.base
        known = np.isfinite(error) & (m.noise > 0)
        if known.sum() < 2:
            continue
        excess = np.sqrt(np.maximum(error[known] ** 2 - m.noise[known] ** 2, 0.0))
        usual = float(np.median(excess))
        worst = int(np.argmax(excess))
        if excess[worst] > RULES.striking * max(usual, 1e-9) and excess[worst] > m.noise[known][worst]:
            side = "above" if m.mean[known][worst] > 0 else "below"
            about = f"{m.quantity} {readable(float(m.centres[known][worst]), m.unit)}"
            contrast = float(excess[worst] / max(usual, 1e-9))
            regions.append((contrast, f"{about} ({error[known][worst]:.0f} N, measured {side} simulated)"))
    regions.sort(reverse=True)
    return "largest at " + "; ".join(text for _, text in regions[: RULES.regions]) if regions else "nowhere in particular"


def constant(several: Sequence[Map]) -> str:
    """An error that is the same in all bins of all quantities; empty where it is not."""
    means, sizes = (np.concatenate([getattr(m, name) for m in several]) for name in ("mean", "base"))
    known = np.isfinite(means)
    means, sizes = means[known], sizes[known]
    if not len(means) or abs(float(means.sum())) < RULES.constant * float(sizes.sum()) or np.ptp(np.sign(means)) > 0:
        return ""
    level = float(np.median(means))
    side, gas = ("above", "less") if level > 0 else ("below", "more")
    return (
        f"everywhere by {abs(level):.0f} N (measured {side} simulated), as with a zero of the load cell, {gas} gas pressure "
        "than the parameter set has, or stroke and force both of the other sign"
    )


def readable(value: float, unit: str) -> str:
    """A value in the unit that engineers use, such as mm or kJ."""
    name, factor = unit_of(unit, value)
    x = value * factor
    return f"{x:.3g} {name}".strip() if abs(x) < 999.5 else f"{x:.0f} {name}".strip()


def structured(results: Sequence[RecordResult], model: str) -> list[str]:
    """Names of the records in which the residual of a model (base, recalibrated, extended) is more than white noise.

    Of white noise the signs of neighbouring intervals agree in half of the cases (Wald and Wolfowitz 1940). Sizes would let
    the few intervals at force jumps decide.
    """
    limit = float(norm.isf(RULES.structure_alarm / 2 / max(1, len(results))))
    names = []
    for r in results:
        signs = np.where(r.weight > 0.0, np.sign(r.measured - getattr(r, model)), 0.0)[1:]
        pairs = (signs[1:] * signs[:-1])[np.diff(r.record.stretch[1:]) == 0]
        pairs = pairs[pairs != 0.0]  # both intervals are compared
        if len(pairs) and abs(float(pairs.sum())) > limit * np.sqrt(len(pairs)):
            names.append(r.record.name)
    return names
