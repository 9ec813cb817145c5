"""The closed form of the evidence, and of what is left, is that of one large Gaussian."""

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from tests.diagnosis import small
from twintube.common.arrays import Array
from twintube.dampers import load
from twintube.data import LoadedDataset
from twintube.diagnosis.bench import Bench
from twintube.diagnosis.frame import Frame
from twintube.diagnosis.records.prepare import prepare
from twintube.diagnosis.sizes import LARGEST, USUAL, Sizes

SIZES = (USUAL, Sizes(1, 3, 1), LARGEST)


@pytest.fixture(scope="module")
def frame() -> Frame:
    runs = [small.run(speed, turns=1, samples=60) for speed in (0.3, 0.3, 0.6)]
    records = [small.record(r, r.force + 30.0, seed=i) for i, r in enumerate(runs)]
    bench = Bench(
        load("SA8", as_published=True), prepare(LoadedDataset("Small", load("SA8", as_published=True), records, []))
    )
    return Frame(bench, bench.states)


def dense(frame: Frame, sizes: Sizes) -> tuple[Array, Array]:
    """Covariance (n, n) [N2] of all errors, and of the part of it that is noise."""
    n = len(frame.bench.z)
    columns, noise = np.zeros((n, frame.k)), np.zeros((n, n))
    own = np.zeros((n, n))
    for part in frame.parts:
        at = np.ix_(part.rows, part.rows)
        columns[part.rows] = part.columns[:, : frame.k]
        mine = part.columns[:, frame.k :] * np.where(part.fixed, 1.0, sizes.own)
        own[at] = mine @ mine.T
        # Samples of other records share nothing of what lasts: there `kept` is 0.
        several = range(len(part.rows))
        kept = np.array([[np.prod(part.kept[min(i, j) + 1 : max(i, j) + 1]) for j in several] for i in several])
        lasting = sizes.lasting * part.lasts
        noise[at] = np.diag(part.sigma**2) + kept * lasting[:, None] * lasting
    shared = columns * frame.scale(sizes)
    return shared @ shared.T + own + noise, noise


@pytest.mark.parametrize("sizes", SIZES)
def test_the_evidence_is_that_of_a_dense_gaussian(frame: Frame, sizes: Sizes) -> None:
    errors = frame.bench.measured - frame.bench.forces({})
    used = np.sort(np.concatenate([part.rows for part in frame.parts]))
    covariance, noise = (x[np.ix_(used, used)] for x in dense(frame, sizes))
    found = frame.log_z(frame.reduced(frame.whitened(errors[:, None], sizes.lasting_at), sizes), sizes)
    assert found == pytest.approx(multivariate_normal(cov=covariance).logpdf(errors[used]), rel=1e-8)
    left = noise @ np.linalg.solve(covariance, errors[used])
    assert frame.left(errors, sizes)[used] == pytest.approx(left, abs=1e-6 * np.abs(errors).max())


def test_a_column_of_a_hypothesis_is_one_more_contribution(frame: Frame) -> None:
    errors, column = frame.bench.measured - frame.bench.forces({}), np.full(len(frame.bench.z), 25.0)
    used = np.sort(np.concatenate([part.rows for part in frame.parts]))
    covariance = dense(frame, USUAL)[0][np.ix_(used, used)] + 25.0**2
    values = np.column_stack([errors, column])
    found = frame.log_z(frame.reduced(frame.whitened(values, USUAL.lasting_at), USUAL), USUAL)
    assert found == pytest.approx(multivariate_normal(cov=covariance).logpdf(errors[used]), rel=1e-8)


def test_inner_products_are_those_of_the_model(frame: Frame) -> None:
    values = np.column_stack([frame.bench.measured - frame.bench.forces({}), frame.bench.v])
    used = np.sort(np.concatenate([part.rows for part in frame.parts]))
    covariance = dense(frame, USUAL)[0][np.ix_(used, used)]
    assert frame.inner(values, USUAL) == pytest.approx(values[used].T @ np.linalg.solve(covariance, values[used]), rel=1e-7)
