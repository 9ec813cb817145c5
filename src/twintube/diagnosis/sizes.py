"""How large the model's own errors are: D, a record's own error, one that lasts; integrated over a grid."""

from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy.stats import halfnorm, norm

from twintube.diagnosis.numbers import numbers


@dataclass(frozen=True)
class Sizes:
    """Positions in the grids of sizes, all shares of the fluid force."""

    law_at: int
    own_at: int
    lasting_at: int

    @property
    def law(self) -> float:
        """Of D, which all records share."""
        return numbers().law_sizes[self.law_at]

    @property
    def own(self) -> float:
        """Of what a record has for itself."""
        return numbers().own_sizes[self.own_at]

    @property
    def lasting(self) -> float:
        """Of what lasts for a part of an oscillation and does not come again."""
        return numbers().lasting_sizes[self.lasting_at]

    @property
    def log_prior(self) -> float:
        """Logarithm of its prior probability."""
        n = numbers()
        return float(
            log_weights(n.law_sizes, n.law_usual)[self.law_at]
            + log_weights(n.own_sizes, n.own_usual)[self.own_at]
            + log_weights(n.lasting_sizes, n.lasting_usual)[self.lasting_at]
        )

    def beside(self, most: "Sizes") -> list["Sizes"]:
        """The sizes one step away in one direction, up to `most`, and itself."""
        at, last = ((s.law_at, s.own_at, s.lasting_at) for s in (self, most))
        out = [self]
        for i, n in enumerate(last):
            out += [Sizes(*(x + by * (i == j) for j, x in enumerate(at))) for by in (-1, 1) if 0 <= at[i] + by <= n]
        return out


@cache
def log_weights(grid: tuple[float, ...], scale: float) -> tuple[float, ...]:
    """Logarithms of the prior weights of a grid of sizes: a half-normal of `scale` on its cells."""
    middles = 0.5 * (np.array(grid[1:]) + np.array(grid[:-1]))
    mass = np.diff(halfnorm.cdf(np.concatenate([[0.0], middles, [np.inf]]), scale=scale))
    return tuple(np.log(np.maximum(mass, 1e-300)).tolist())


def chance_of_more(grid: tuple[float, ...], at: int, scale: float) -> float:
    """Prior probability of a size as large as that of a cell of the grid, or larger."""
    return float(2.0 * norm.sf(0.5 * (grid[at - 1] + grid[at]), scale=scale)) if at > 0 else 1.0


USUAL = Sizes(2, 2, 3)
LARGEST = Sizes(len(numbers().law_sizes) - 1, len(numbers().own_sizes) - 1, len(numbers().lasting_sizes) - 1)
