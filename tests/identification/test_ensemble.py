"""The ensemble sampler on densities whose moments are known."""

import numpy as np
import pytest

from twintube.common.arrays import Array
from twintube.identification.ensemble import STRETCH, moves, sampled

MEAN = np.array([1.0, -2.0, 30.0])
SCALES = np.array([1.0, 0.1, 20.0])
RELATED = np.array([[1.0, 0.9, 0.0], [0.9, 1.0, -0.3], [0.0, -0.3, 1.0]])


def normal(X: Array) -> Array:
    """A correlated normal density, its scales far apart."""
    u = (X - MEAN) / SCALES
    return -0.5 * np.einsum("ni,ij,nj->n", u, np.linalg.inv(RELATED), u)  # type: ignore[no-any-return]


def test_a_normal_density_has_its_moments() -> None:
    rng = np.random.default_rng(1)
    start = MEAN + SCALES * rng.standard_normal((40, 3))
    chain = sampled(normal, start, 6000, rng)[1000:].reshape(-1, 3)
    # Autocorrelation leaves about 200000 / 40 independent points.
    assert (chain.mean(axis=0) - MEAN) / SCALES == pytest.approx(0.0, abs=4 / np.sqrt(5000))
    assert chain.std(axis=0) / SCALES == pytest.approx(1.0, abs=4 / np.sqrt(2 * 5000))
    assert np.corrcoef(chain.T) == pytest.approx(RELATED, abs=4 / np.sqrt(5000))


def test_the_sample_does_not_depend_on_scales() -> None:
    """The property it is named after: parameters in other units give the same sample in those units."""
    chains = []
    for factor in (1.0, 1024.0):  # exact in binary
        rng = np.random.default_rng(2)
        start = rng.standard_normal((10, 2))
        chains.append(sampled(lambda X, f=factor: -0.5 * np.sum((X / f) ** 2, axis=1), start * factor, 200, rng) / factor)
    assert np.array_equal(*chains)


def test_what_is_impossible_is_never_visited() -> None:
    def half(X: Array) -> Array:
        return np.where(X[:, 0] > 0.0, -X[:, 0], -np.inf)

    rng = np.random.default_rng(3)
    chain = sampled(half, rng.exponential(size=(20, 1)), 5000, rng)[500:]
    assert (chain > 0.0).all()
    assert chain.mean() == pytest.approx(1.0, abs=0.05)


def test_a_move_stays_on_the_line_through_another_walker() -> None:
    rng = np.random.default_rng(4)
    walkers, others = rng.standard_normal((2000, 2)), np.array([[5.0, 5.0]])
    proposed, factor = moves(walkers, others, rng)
    z = (proposed - others)[:, 0] / (walkers - others)[:, 0]
    assert np.allclose(proposed, others + z[:, None] * (walkers - others))
    assert z.min() >= 1 / STRETCH - 1e-12 and z.max() <= STRETCH + 1e-12
    assert np.allclose(factor, np.log(z))  # (k - 1) log z
    # The density of z is in proportion to 1/sqrt(z): half of them lie below the square of the mean of the ends' roots.
    assert np.mean(z < ((STRETCH**0.5 + STRETCH**-0.5) / 2) ** 2) == pytest.approx(0.5, abs=0.04)
