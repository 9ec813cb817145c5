"""The zero of the load cell, which differs from record to record: how much, and whether a cause hides in the zeros.

A model that is wrong errs by means that change smoothly with the velocity, or that differ between the states of filling as
those of a preload do; zeros do neither.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from twintube.common.arrays import Array
from twintube.diagnosis.measurement.faults import Fault
from twintube.diagnosis.problem import Problem
from twintube.diagnosis.records.noise import BEND, SCATTER
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.rules import RULES

EVENLY, RUNNING = 0, -1  # a zero moves from record to record, or with the time that is recorded


def zero_drift(problem: Problem) -> tuple[Problem, list[str]]:
    """The problem with the scatter of the records' zeros in it, and a remark where a good load cell has less."""
    means = problem.means(problem.errors({}) * problem.weight)
    drift = max(scatter(problem.records, means), RULES.least_zero * largest(problem.records))
    drift = max(drift, own_zero(problem, means, RULES.usual_zeros * drift) / RULES.usual_zeros)
    share = drift / largest(problem.records)
    size = f"about {drift:.2g} N, {100 * share:.2g} % of the largest force"
    text = f"the zero of the force channel differs from record to record by {size}: read it before each record"
    return problem.with_drift(drift), [text] if share > RULES.small_zero else []


@dataclass(frozen=True)
class Courses:
    """Ways in which the zeros may move over the records, by EVENLY, RUNNING or the record from which on they differ."""

    fits: dict[int, Array]  # (r,) [N] about their mean
    left: dict[int, float]  # [N2] that a fit leaves of the squares of the means
    likeliest: int

    @property
    def size(self) -> float:
        """By how much [N] the zero moves; errors are simulated less measured forces."""
        fit = self.fits[self.likeliest]
        return float(fit[0] - fit[-1])


def zero_change(problem: Problem) -> tuple[Fault | None, Problem]:
    """A zero that moves in the order of the records, at once, evenly or with the time, and the problem without it.

    What begins with the loss of oil is no zero, but maybe the force of gas, unless it pulls the rod in.
    """
    means = problem.means(problem.errors({}) * problem.weight)
    found = courses(problem, means)
    if found is None or not same_everywhere(problem, means, found.fits[found.likeliest]):
        return None, problem
    cut = found.likeliest
    keys_alike = (EVENLY, RUNNING) if cut in (EVENLY, RUNNING) else (cut,)
    # What drifts all along has no zero of its own to begin with: the constant goes with it.
    level = -found.fits[cut][0] if cut > 0 else float(means.mean())
    several = {key: without(problem, found.fits[key] + level, key == RUNNING) for key in keys_alike}
    cut = min(several, key=lambda key: float(apart_from_means(several[key][0]).sum()))
    still, rate = several[cut]
    if begins_with_a_cause(problem, still, cut) or not better(problem, still):
        return None, problem
    value, unit = (rate, "N/s") if cut == RUNNING else (found.size, "N")
    spread = scattered(found.fits[cut], found.left[cut], value)
    if cut > 0:
        names = tuple(record.name for record in problem.records[cut:])
        text = f"From {names[0]} on the force channel reads a constant that the records before do not have."
        return Fault("force_offset", "Zero of the load cell", text, value, "force_offset", unit, names, spread=spread), still
    name, how = ("zero_drift", "drifts all along,") if cut == RUNNING else ("zero_moved", "moves evenly")
    text = f"The zero of the force channel {how} from the first record to the last."
    return Fault("zero_drift", "Drifting zero of the load cell", text, value, name, unit, spread=spread), still


def courses(problem: Problem, means: Array) -> Courses | None:
    """How the zeros may move by the mean errors (r,) [N]; None with few records, or where nothing fits and matters."""
    count = len(means)
    if count < RULES.order_least:
        return None
    rest = float(np.sum((means - means.mean()) ** 2))
    running = np.array([record.before + np.ptp(record.time) / 2 for record in problem.records])
    fits = {}
    for key, at in ((EVENLY, np.arange(count)), (RUNNING, running)):
        apart = at - at.mean()
        fits[key] = apart * float(apart @ means) / float(apart @ apart)
    keys = fills(problem)
    cuts = range(RULES.order_side, count - RULES.order_side + 1) if count > RULES.order_least else ()
    for cut in cuts:
        same = keys[cut] == keys[cut - 1]
        if same or not (problem.records[cut].intact or problem.records[cut - 1].intact) or pulled_in(problem, means):
            side = np.arange(count) >= cut
            fits[cut] = np.where(side, means[side].mean(), means[~side].mean()) - means.mean()
    left = {cut: float(np.sum((means - means.mean() - fit) ** 2)) for cut, fit in fits.items()}
    found = Courses(fits, left, min(left, key=lambda cut: left[cut]))
    most = RULES.order_left if cuts else RULES.half * RULES.order_left  # as rare by chance with fewer records
    if left[found.likeliest] > most * rest or abs(found.size) < RULES.small_force * largest(problem.records):
        return None
    return found


def fills(problem: Problem) -> list[tuple[float, float]]:
    """Oil level and preload of each record."""
    return [(record.oil_level, record.gas_preload) for record in problem.records]


def same_everywhere(problem: Problem, means: Array, fit: Array) -> bool:
    """Whether the zero moves by `fit` (r,) [N] in each state of several records and in both directions."""
    for some in states(problem.records):
        course, own = (x[some] - x[some].mean() for x in (fit, means))
        if np.ptp(fit[some]) > 0.0 and np.sum((own - course) ** 2) > RULES.order_state * np.sum(own**2):
            return False
    # A zero is the same in rebound and compression; a damper that is weaker in one more than in the other has a mean, too.
    both = by_direction(problem)
    apart = both - both.mean(axis=0)
    return not np.sum((apart - fit[:, None]) ** 2) > RULES.order_state * np.sum(apart**2)


def begins_with_a_cause(problem: Problem, still: Problem, cut: int) -> bool:
    """Whether a zero from a record on begins with another filling, as a cause does, which leaves more than noise."""
    keys = fills(problem)
    near = range(max(1, cut - 1), min(len(keys), cut + 2)) if cut > 0 else range(0)
    if not any(keys[i] != keys[i - 1] for i in near):
        return False
    left = apart_from_means(still)[cut:] / np.maximum(still.counts[cut:], 1)
    return bool(np.median(left) > RULES.odd_right)


def better(problem: Problem, still: Problem) -> bool:
    """Whether the errors of most records that changed fall: not the means of a weaker damper, or of what hardly counts."""
    before, after = (np.add.reduceat(some.residual({}) ** 2, some.starts[:-1]) for some in (problem, still))
    moved = [not np.array_equal(a.force, b.force) for a, b in zip(problem.records, still.records, strict=True)]
    return not np.median((before - after)[moved]) <= 0.0


def scattered(zeros: Array, left: float, value: float) -> float:
    """Half the width of the 90 % interval of the `value` that zeros (r,) [N] stand for, where they leave squares [N2]."""
    apart = zeros - zeros.mean()
    relative = np.sqrt(left / max(1, len(zeros) - 2) / float(apart @ apart))
    return float(abs(value) * max(RULES.interval * relative, RULES.channel_width))


def without(problem: Problem, zeros: Array, running: bool) -> tuple[Problem, float]:
    """The problem without zeros (r,) [N] of its records, and their rate [N/s] where they do within records."""
    lasting = np.array([float(np.ptp(record.time)) for record in problem.records])
    elapsed = problem.records[-1].before + (lasting[-1] - lasting[0]) / 2
    rate = (zeros[0] - zeros[-1]) / elapsed if running else 0.0
    each = [x - rate * (r.time - r.time[0] - T / 2) for r, x, T in zip(problem.records, zeros, lasting, strict=True)]
    pairs = zip(problem.records, each, strict=True)
    return problem.with_records([replace(r, force=r.force + x) for r, x in pairs]), float(rate)


def pulled_in(problem: Problem, means: Array) -> bool:
    """Whether the model is right while intact, and a constant pulls the rod in without preload: no gas does that."""
    intact = np.array([record.intact for record in problem.records])
    if not 0 < intact.sum() < len(intact):
        return False
    right = float(means[intact].mean())
    return abs(right) < RULES.order_intact * (right - float(means[~intact].mean()))


def by_direction(problem: Problem) -> Array:
    """Mean errors (r, 2) [N] of the model as given in rebound and compression."""
    errors, columns = problem.errors({}), []
    rising = np.concatenate([record.velocity > 0.0 for record in problem.records])
    for some in (rising, ~rising):
        power = np.where(some, problem.weight**2, 0.0)
        pulled, sums = (np.add.reduceat(x, problem.starts[:-1]) for x in (power * errors, power))
        columns.append(pulled / np.maximum(sums, np.finfo(float).tiny))
    return np.column_stack(columns)


def largest(records: Sequence[PreparedRecord]) -> float:
    """Largest force [N] of all records."""
    return max(record.peak for record in records)


def states(records: Sequence[PreparedRecord]) -> list[list[int]]:
    """The numbers of the records of each state of filling, by velocity."""
    numbers: dict[tuple[float, float], list[int]] = {}
    for i in sorted(range(len(records)), key=lambda i: records[i].top_speed):
        numbers.setdefault((records[i].oil_level, records[i].gas_preload), []).append(i)
    return list(numbers.values())


def apart_from_means(problem: Problem) -> Array:
    """Squared weighted errors (r,) of the model as given, apart from each record's mean."""
    errors = problem.errors({})
    squares = (problem.weight * (errors - problem.spread(problem.means(errors * problem.weight)))) ** 2
    return np.asarray(np.add.reduceat(squares, problem.starts[:-1]))


def own_zero(problem: Problem, means: Array, usual: float) -> float:
    """Size [N] of a zero beyond the `usual` that a single record of its state has; 0 where there is none.

    A good load cell may have it, and apart from it the record is explained.
    """
    left = apart_from_means(problem) / np.maximum(problem.counts, 1)
    far = np.flatnonzero(np.abs(means) > usual)
    if len(far) != 1 or abs(means[far[0]]) > RULES.small_zero * largest(problem.records) or left[far[0]] > RULES.odd_right:
        return 0.0
    like = next(some for some in states(problem.records) if far[0] in some)
    return float(abs(means[far[0]])) if len(like) >= RULES.repeats else 0.0


def scatter(records: Sequence[PreparedRecord], means: Array) -> float:
    """Standard deviation [N] of the zeros from the mean errors (r,) [N] of the records; 0 where there are too few.

    A single record far from all others, say of another damper, does not make their zeros scatter. Whether it is far is not
    told by the median of few bends, which is small by chance without some record.
    """
    if len(means) < 3:
        return scatter_of(records, means)
    fewer = [([r for k, r in enumerate(records) if k != i], np.delete(means, i)) for i in range(len(means))]
    sizes = [root_mean_square(bends(*some)) for some in fewer]
    i = int(np.argmin(sizes))
    far = sizes[i] < RULES.odd_zero * root_mean_square(bends(records, means))
    return scatter_of(*(fewer[i] if far else (records, means)))


def scatter_of(records: Sequence[PreparedRecord], means: Array) -> float:
    """The like, whichever records there are."""
    bent = bends(records, means)
    if triples(records) >= RULES.least_bends:
        return SCATTER * float(np.median(np.abs(bent)))
    # Few records tell zeros from a smooth error no better than by their scatter, of which a good load cell has little.
    return min(RULES.small_zero * largest(records), root_mean_square(bent))


def bends(records: Sequence[PreparedRecord], means: Array) -> Array:
    """How far mean errors (r,) [N] are from those of neighbouring velocities, or from all where these are few.

    In units of a standard deviation of the zeros.
    """
    several = states(records)
    if triples(records) >= RULES.least_bends:
        return np.concatenate([np.diff(means[some], 2) for some in several]) / BEND
    apart = np.concatenate([means[some] - means[some].mean() for some in several])
    return np.asarray(apart * np.sqrt(len(means) / max(1, len(means) - len(several))))


def triples(records: Sequence[PreparedRecord]) -> int:
    """Number of triples of neighbouring velocities."""
    return sum(max(0, len(some) - 2) for some in states(records))


def root_mean_square(values: Array) -> float:
    """Root mean square; 0 of nothing."""
    return float(np.sqrt(np.mean(values**2))) if len(values) else 0.0
