"""All figures of some answers, each with a 95 % interval: of shares after Clopper and Pearson, of scores by resampling."""

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.stats import binomtest

from worlds.scoring import marks
from worlds.scoring.answer import contradictions
from worlds.scoring.pairs import Pair

Array = NDArray[np.float64]
Rows = Sequence[Pair]
RESAMPLES: Final = 2000
BINS: Final = 10  # of the largest probability
CLEAR, SMALL = 2.0, 0.5  # effect over noise


@dataclass(frozen=True)
class Figure:
    """A value with its interval, of how many datasets; a share also has their number."""

    value: float
    low: float
    high: float
    of: int
    count: int | None = None


Figures = dict[str, Figure]


def share(rows: Rows, test: Callable[[Pair], bool]) -> Figure | None:
    """Share of the datasets that pass; None of none."""
    if not rows:
        return None
    count = sum(map(test, rows))
    interval = binomtest(count, len(rows)).proportion_ci()
    return Figure(count / len(rows), float(interval.low), float(interval.high), len(rows), count)


def resampled(values: Sequence[Any], statistic: Callable[[Array], float]) -> Figure | None:
    """A statistic over rows (n,) or (n, k) with its interval by resampling the rows; None of none."""
    if not values:
        return None
    rows = np.array(values, dtype=float)
    rng = np.random.default_rng(0)  # equal answers have equal figures
    drawn = [statistic(rows[rng.integers(len(rows), size=len(rows))]) for _ in range(RESAMPLES)]
    low, high = np.percentile(drawn, [2.5, 97.5])
    return Figure(statistic(rows), float(low), float(high), len(rows))


def calibration_error(rows: Array) -> float:
    """Expected calibration error of rows (n, 2): largest probability, and 1 where its name is right."""
    bins = np.minimum((rows[:, 0] * BINS).astype(int), BINS - 1)
    gaps = np.bincount(bins, rows[:, 1] - rows[:, 0], BINS)
    return float(np.abs(gaps).sum() / len(rows))


def by_chance(rows: Array) -> Figure:
    """The calibration error that answers have which are right as often as they say; few datasets have much of it."""
    rng = np.random.default_rng(0)
    drawn = [calibration_error(np.column_stack([rows[:, 0], rng.random(len(rows)) < rows[:, 0]])) for _ in range(RESAMPLES)]
    low, high = np.percentile(drawn, [2.5, 97.5])
    return Figure(float(np.mean(drawn)), float(low), float(high), len(rows))


def kept(figures: dict[str, Figure | None]) -> Figures:
    """Those that there is something to count for."""
    return {name: figure for name, figure in figures.items() if figure is not None}


def of_fill(rows: Rows) -> Figures:
    """Oil level and preload, where nothing but these is hidden."""
    told = [p for p in rows if p.truth.kind in ("none", "state") and p.truth.oil_level is not None]
    scores = [s for p in told if (s := marks.level_log_score(p)) is not None]
    return kept({
        "preload right": share([p for p in told if p.truth.gas_preload is not None], marks.preload_right),
        "level inside its 90 % interval": share(told, marks.level_inside),
        "interval at most 0.1 wide, where the force tells the level": share(
            [p for p in told if p.truth.level_seen], marks.level_narrow
        ),
        "log score of the level's density": resampled(scores, np.mean),
    })  # fmt: skip


def of_nothing(rows: Rows) -> Figures:
    """What is said of a damper with which nothing is wrong."""
    nothing = [p for p in rows if p.truth.kind == "none"]
    return kept({"accused": share(nothing, marks.accused), "none": share(nothing, marks.right_alone)})


def of_causes(rows: Rows) -> Figures:
    """What is said where something is hidden."""
    return kept({
        "truth in the 90 % set": share(rows, lambda p: marks.holds(p.answer.credible, p)),
        "named alone and right": share(rows, marks.right_alone),
        "wrong name alone": share(rows, marks.wrong_alone),
        "none": share(rows, marks.missed),
    })  # fmt: skip


def of_probabilities(rows: Rows) -> Figures:
    """Proper scores, sets and time.

    Where there is no answer the truth has no probability; calibration and the size of the set are of given answers.
    """
    stated = [p for p in rows if p.answer.probabilities]
    tops = [marks.top(p) for p in stated]
    seconds = [p.answer.seconds for p in rows if p.answer.seconds is not None]
    worst = Figure(max(seconds), max(seconds), max(seconds), len(seconds)) if seconds else None
    return kept({
        "log score": resampled([marks.log_score(p) for p in rows], np.mean),
        "Brier score": resampled([marks.brier(p) for p in rows], np.mean),
        "expected calibration error": resampled(tops, calibration_error),
        "the same by chance alone": by_chance(np.array(tops, dtype=float)) if tops else None,
        "named alone and right": share(rows, marks.right_alone),
        "wrong name alone": share(rows, marks.wrong_alone),
        "top-1": share(rows, marks.top_right),
        "truth in the 90 % set": share(rows, lambda p: marks.holds(p.answer.credible, p)),
        "size of the set": resampled([len(p.answer.credible) for p in stated], np.mean),
        "contradictions": share(rows, lambda p: bool(contradictions(p.answer))),
        "no answer": share(rows, lambda p: not p.answer.given),
        "seconds, median": resampled(seconds, np.median),
        "seconds, worst": worst,
    })  # fmt: skip


def groups(rows: Rows) -> dict[str, Figures]:
    """The figures of some datasets, under what they are of."""
    told = [p for p in rows if not marks.fill_alone(p)]  # of causes
    hidden = [p for p in told if p.truth.kind != "none" and p.truth.effect_over_noise is not None]
    sizes = [(p, p.truth.effect_over_noise or 0.0) for p in hidden]
    found = {
        "unknown fill": of_fill(rows),
        "nothing hidden": of_nothing(told),
        f"effect of {CLEAR:g} of the noise or more": of_causes([p for p, size in sizes if size >= CLEAR]),
        f"effect of {SMALL:g} of the noise or more": of_causes([p for p, size in sizes if size >= SMALL]),
        f"effect below {SMALL:g} of the noise": of_causes([p for p, size in sizes if size < SMALL]),
        "all": of_probabilities(told),
    }
    return {name: figures for name, figures in found.items() if figures}


def row_of(pair: Pair) -> dict[str, Any]:
    """One dataset for the file of figures."""
    truth, answer = pair.truth, pair.answer
    return {
        "dataset": pair.name, "world": truth.world, "seed": truth.seed, "kind": truth.kind, "hidden": list(truth.causes),
        "also_fits": list(truth.also_fits), "effect_over_noise": truth.effect_over_noise, "verdict": answer.verdict,
        "named": sorted(answer.named), "credible_set": list(answer.credible), "right": marks.right_alone(pair),
        "truth_probability": marks.truth_probability(pair), "contradictions": contradictions(answer),
        "seconds": answer.seconds, "reason": answer.reason,
    }  # fmt: skip


def score(pairs: Rows) -> dict[str, Any]:
    """The figures by world and group, and a row for each dataset; ready for JSON."""
    worlds = list(dict.fromkeys(p.truth.world for p in pairs))
    selected = {world: [p for p in pairs if p.truth.world == world] for world in worlds}
    if len(worlds) > 1:
        selected["all worlds"] = list(pairs)
    found = {world: groups(rows) for world, rows in selected.items()}
    return {
        "worlds": {
            world: {name: {key: asdict(figure) for key, figure in figures.items()} for name, figures in by_group.items()}
            for world, by_group in found.items()
        },
        "datasets": [row_of(pair) for pair in pairs],
    }
