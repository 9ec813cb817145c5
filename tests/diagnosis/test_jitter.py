"""Jitter of the samples, which no file holds, is part of the noise floor; what else makes the force late is not."""

from dataclasses import replace

import numpy as np
import pytest

from tests.diagnosis import small
from twintube.data import Record
from twintube.diagnosis.measurement.edges import with_edges, with_noise
from twintube.diagnosis.measurement.jitter import jitter, jittered, with_jitter
from twintube.diagnosis.measurement.sampling import with_sampling
from twintube.diagnosis.problem import Problem
from twintube.diagnosis.rules import RULES

RATE = 128.0  # [Hz] of the logger


def logged(r: small.Run, jitter: float = 0.0, seed: int = 0, delay: float = 0.0) -> Record:
    """The run as points, each taken at another time than it states by a share of a sample period; the force is late [s]."""
    rng = np.random.default_rng(seed)
    time = np.arange(0.0, r.time[-1], 1.0 / RATE)
    at = np.clip(time + jitter / RATE * rng.standard_normal(len(time)), r.time[0], r.time[-1])
    force = r.at(r.force, at - delay)
    force += 0.002 * np.abs(force).max() * rng.standard_normal(len(time))
    usable = np.ones(len(time), dtype=bool)
    whole = small.record(r)
    return replace(whole, time=time, stroke=r.at(r.stroke, at), velocity=r.at(r.velocity, time), force=force, usable=usable)


@pytest.fixture(scope="module")
def runs() -> list[small.Run]:
    return [small.run(v, slow=3, turns=12, samples=400) for v in (0.1, 0.5, 1.0)]


def weighted(problem: Problem) -> Problem:
    return with_edges(with_noise(with_sampling(problem)))


def edges(problem: Problem) -> np.ndarray:
    return np.concatenate([record.edges for record in problem.records])


@pytest.mark.parametrize("size", [0.003, 0.006])
def test_jitter_is_seen_by_its_size(runs: list[small.Run], size: float) -> None:
    """A part of it passes for other noise, the more the smaller it is."""
    problem = weighted(small.problem([logged(r, size, i) for i, r in enumerate(runs)]))
    base = problem.simulated(problem.damping({}))[1]
    again = [jittered(problem, seed).simulate(problem.damping({}))[1] - base for seed in range(3)]
    assert 0.5 * size < jitter(problem, again) < 1.2 * size
    more = np.hypot(edges(problem), jitter(problem, again) / RULES.jitter_tried * np.sqrt(np.mean(np.square(again), axis=0)))
    assert np.allclose(edges(with_jitter(problem)), more)


def test_samples_at_their_times_have_none(runs: list[small.Run]) -> None:
    problem = weighted(small.problem([logged(r, 0.0, i) for i, r in enumerate(runs)]))
    assert np.array_equal(edges(with_jitter(problem)), edges(problem))


@pytest.mark.parametrize("delay", [0.003, 0.01])
def test_a_force_that_is_late_is_no_jitter(runs: list[small.Run], delay: float) -> None:
    """Several samples late in the fastest record: its errors are large, alike in every oscillation, and not white."""
    records = [logged(r, seed=i, delay=delay) for i, r in enumerate(runs)]
    problem = weighted(small.problem(records))
    assert np.array_equal(edges(with_jitter(problem)), edges(problem))
