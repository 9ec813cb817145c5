"""The budget of the error: what the difference between measured and simulated forces consists of.

The contributions are what the posterior expects of each that the model integrates out, of the fill, and of the cause. A
contribution is within tolerance where such dampers and benches have as much; what is beyond is a finding (GUM, 8.1).
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.stats import chi2

from twintube.common.arrays import Array
from twintube.diagnosis.changes import headline
from twintube.diagnosis.found import Found
from twintube.diagnosis.frame import STILL, Frame, Part
from twintube.diagnosis.heavy import without as without_columns
from twintube.diagnosis.mechanisms import OPEN
from twintube.diagnosis.memory import lasting
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.records.seen import DELAY
from twintube.diagnosis.search import Search
from twintube.diagnosis.sizes import Sizes, chance_of_more

# Contributions by their columns: of those that all records share, and of those that a record has for itself.
SHARED = {
    "friction": range(3),
    "gas": range(3, 5),
    "oil_loss": range(5, 11),
    "zero": range(11, 12),
    "sampling": range(12, 17),
}
OWN = {"zero": (0, 9, 10, 11), "gain": (1,), "sampling": range(2, 7), "temperature": (7, 8)}
SEEN = (DELAY, *(s.name for s in OPEN))  # open in every hypothesis beside the levels
LAW, LASTING, FILL, NOISE = "law", "lasting", "fill", "noise"
ORDER = (FILL, LAW, "oil_loss", "friction", "gas", "zero", "gain", "sampling", "temperature", LASTING)


@dataclass(frozen=True)
class Line:
    """A contribution: its size (RMS) [N], over what such dampers and benches have, and whether that is usual."""

    name: str
    force: float
    ratio: float | None  # None of a cause and of the noise
    finding: bool


@dataclass(frozen=True)
class Budget:
    """The error (RMS) [N], the largest measured force [N], and what the error consists of, the largest first."""

    error: float
    peak: float
    lines: tuple[Line, ...]
    noise: float

    @property
    def largest(self) -> Line:
        """The first line; the noise where there is no other."""
        return self.lines[0] if self.lines else Line(NOISE, self.noise, None, finding=False)

    def as_json(self) -> dict[str, object]:
        """The entry in diagnosis.json."""
        return {
            "error": self.error,
            "largest_force": self.peak,
            "noise": self.noise,
            "contributions": [
                {"name": x.name, "force": x.force, "times_usual": x.ratio, "finding": x.finding} for x in self.lines
            ],
        }


def budget(stated: Search, search: Search, found: Found) -> Budget:
    """The budget under a hypothesis in its fill, beside the fill `stated`."""
    bench, frame = search.bench, search.frame.weighted(found.weights)
    used = frame.used
    values = search.trial(found.mechanism, found.at, found.exact).values
    errors = without_columns(frame, values, found.sizes)
    of = contributions(frame, errors, found.sizes)
    begun = bench.forces(stated.filled(np.zeros(len(stated.fill.levels))))
    filled = bench.forces({name: value for name, value in found.levels.items() if name not in SEEN})
    known = [s for s in stated.fill.levels if s.name in found.levels and s.name not in SEEN]
    of[FILL] = filled - begun, np.array([s.coordinate(found.levels[s.name]) for s in known])
    delay, parts = of["sampling"]
    late = [s.coordinate(found.levels[s.name]) for s in search.fill.levels if s.name in SEEN]
    of["sampling"] = delay + found.base - filled, np.append(parts, late)
    lines = []
    for name in ORDER:
        force, far = of[name]
        ratio, finding = usual(far)
        if name in (LAW, LASTING):  # their size is sought
            grid, at, scale = size_of(name, found.sizes)
            finding = chance_of_more(grid, at, scale) < 1.0 - numbers().credible
            ratio = grid[at] / scale
        lines.append(Line(name, rms(force[used]), float(ratio), bool(finding)))
    lines = [line for line in lines if line.force > 0.0]
    named = headline(stated, search, found).split("+")
    lines += [Line(name, rms(force[used]), None, finding=name in named) for name, force in causes(search, found, errors)]
    total = rms((bench.measured - begun)[used])
    lines.sort(key=lambda line: -line.force)
    # As of records that were left out: steps of the force, which nobody can place, are not the noise.
    noise = float(np.sqrt(1.0 / np.mean(bench.sigma[used] ** -2.0)))
    return Budget(total, bench.peak, tuple(lines), noise)


def causes(search: Search, found: Found, errors: Array) -> Iterator[tuple[str, Array]]:
    """Each cause with its force (n,) [N]; what they are off their law belongs to the largest."""
    k, begin = len(found.mechanism.strengths), 0
    left = search.bench.measured - found.base - errors
    forces: dict[str, Array] = {}
    for part in found.mechanism.parts or (found.mechanism,) if k else ():
        end = begin + len(part.strengths)
        without, with_it = search.forces(part, np.concatenate([found.at[begin:end], found.at[k:]]))
        forces[part.effect] = forces.get(part.effect, 0.0) + with_it - without
        begin = end
    if forces:
        first = max(forces, key=lambda name: rms(forces[name]))
        forces[first] = left - sum((force for name, force in forces.items() if name != first), np.zeros(len(left)))
    yield from forces.items()


def size_of(name: str, sizes: Sizes) -> tuple[tuple[float, ...], int, float]:
    """Sizes tried of an own error of the model, which is the best, and what is usual."""
    n = numbers()
    if name == LAW:
        return n.law_sizes, sizes.law_at, n.law_usual
    return n.lasting_sizes, sizes.lasting_at, n.lasting_usual


def contributions(frame: Frame, errors: Array, sizes: Sizes) -> dict[str, tuple[Array, Array]]:
    """Force (n,) [N] of each contribution, and its parts (k,) in standard deviations of their priors."""
    _, a, own = frame.explained(errors[:, None], sizes)
    out = {name: np.zeros(len(errors)) for name in ORDER}
    sizes_seen: dict[str, list[Array]] = {name: [] for name in ORDER}
    first = frame.still - STILL
    for name, at in named_shared(first, frame):
        sizes_seen[name].append(a[at, 0])
    for part, b in zip(frame.parts, own, strict=True):
        expected = frame.expected(part, a, b, sizes)[:, 0]
        for name, at in columns_of(frame, part, first):
            out[name][part.rows] += part.columns[:, at] @ expected[at]
            mine = at[at >= frame.k] - frame.k
            if len(mine) and name != LAW:
                sizes_seen[name].append(b[mine, 0])
        left = errors[part.rows] - part.columns @ expected
        size = numbers().lasting_sizes[sizes.lasting_at]
        if size > 0.0:
            out[LASTING][part.rows] = lasting(left, part.sigma, size * part.lasts, part.kept)
    return {name: (force, np.concatenate([np.zeros(0), *sizes_seen[name]])) for name, force in out.items()}


def usual(parts: Array) -> tuple[float, bool]:
    """Root mean square of parts (k,) in standard deviations, and whether they are more than nine of ten have."""
    if not len(parts):
        return 0.0, False
    return rms(parts), bool(parts @ parts > chi2.ppf(numbers().credible, len(parts)))


def named_shared(first: int, frame: Frame) -> Iterator[tuple[str, Array]]:
    """Contributions that all records share with their columns."""
    for name, some in SHARED.items():
        yield name, first + np.array(some)
    yield LAW, np.r_[0:first, frame.still : frame.k]


def columns_of(frame: Frame, part: Part, first: int) -> Iterator[tuple[str, Array]]:
    """All contributions to a part with their columns."""
    yield from named_shared(first, frame)
    starts = np.flatnonzero(np.diff(part.fixed.astype(int), prepend=0) == 1)  # of the bench of each record
    fixed = np.zeros(len(part.fixed), dtype=bool)
    for name, some in OWN.items():
        at = np.concatenate([begin + np.array(some) for begin in starts]) if len(starts) else np.zeros(0, int)
        fixed[at] = True
        yield name, frame.k + at
    yield LAW, frame.k + np.flatnonzero(~fixed)


def rms(values: Array) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(np.square(values)))) if len(values) else 0.0
