"""Identification: known parameters come back, seeds reproduce, a killed run resumes, thinning does not matter."""

from pathlib import Path

import numpy as np
import pytest

from benchmarks.identify import records_of
from twintube.common.arrays import Array
from twintube.dampers import Damper, load
from twintube.dampers.variants import NO_CAVITATION, NO_FOAM
from twintube.engine.simulate import InputError
from twintube.fitting.parameters import TABLE_6
from twintube.identification import METHODS, Harmonic, Objective, minimise
from twintube.rig.signals import BLOCKS


@pytest.fixture(scope="module")
def basic() -> Damper:
    """SA3 as variant 2: without foam and cavitation."""
    return load("SA3", as_published=True).with_(**NO_FOAM, **NO_CAVITATION)


@pytest.fixture(scope="module")
def records(basic: Damper) -> list[Harmonic]:
    return records_of(basic, [v for v in BLOCKS if 0.2 <= v <= 0.53], noise=0.01)


def test_truth_is_at_the_noise_floor(basic: Damper, records: list[Harmonic]) -> None:
    objective = Objective(basic, TABLE_6, records, with_work=False)
    truth = np.array([[getattr(basic.parameters, n) for n in TABLE_6]])
    floor = np.sqrt(np.mean([(0.01 * np.abs(r.force).max()) ** 2 for r in records]))
    assert objective(truth)[0] < 1.5 * floor


def test_swarm_of_the_paper_recovers_table_6(basic: Damper, records: list[Harmonic]) -> None:
    """Equation 42 with 48 particles and 100 iterations: what the data determine comes back."""
    objective = Objective(basic.with_(X_Re=0.5, X_Co1=0.5, X_Co2=0.5, G_PV=0.5), TABLE_6, records, with_work=False)
    best = minimise(objective, objective.bounds, method="pso", population=48, generations=100, seed=1)
    values = dict(zip(TABLE_6, best.x, strict=True))
    p = basic.parameters
    assert best.evaluations == 4800
    assert values["X_Re"] == pytest.approx(p.X_Re, abs=0.02)
    assert values["X_Co1"] == pytest.approx(p.X_Co1, abs=0.02)
    # Equation 29 shows only X_Co2 + G_PV (1 - X_Co2) in the force; the flow tells the two apart less sharply.
    k = p.X_Co2 + p.G_PV * (1 - p.X_Co2)
    assert values["X_Co2"] + values["G_PV"] * (1 - values["X_Co2"]) == pytest.approx(k, abs=0.02)
    assert np.all(np.diff(best.trace) <= 0)


def test_thinner_sampling_does_not_move_the_optimum(basic: Damper, records: list[Harmonic]) -> None:
    optima = []
    for samples in (64, 256):
        objective = Objective(basic, TABLE_6, records, with_work=False, samples=samples)
        optima.append(minimise(objective, objective.bounds, population=20, generations=60, seed=1).x)
    k = [x[4] + x[2] * (1 - x[4]) for x in optima]
    assert optima[0][0] == pytest.approx(optima[1][0], abs=0.02)
    assert k[0] == pytest.approx(k[1], abs=0.02)


def bowl(X: Array) -> Array:
    return np.sum((X - 0.3) ** 2, axis=1)  # type: ignore[no-any-return]


BOUNDS = np.array([[0.0, 1.0]] * 3)


@pytest.mark.parametrize("method", METHODS)
def test_methods_are_seeded_and_share_a_budget(method: str) -> None:
    a, b, c = (minimise(bowl, BOUNDS, method=method, population=20, generations=40, seed=s) for s in (3, 3, 4))
    assert np.array_equal(a.x, b.x)
    assert not np.array_equal(a.trace, c.trace)
    assert a.evaluations == 800
    assert a.error < 1e-3


@pytest.mark.parametrize("method", METHODS)
def test_a_killed_run_resumes_to_the_same_result(method: str, tmp_path: Path) -> None:
    whole = minimise(bowl, BOUNDS, method=method, population=20, generations=30, seed=5)
    calls = 0

    def dies(X: Array) -> Array:
        nonlocal calls
        calls += 1
        if calls > 12:
            raise KeyboardInterrupt
        return bowl(X)

    journal = tmp_path / "journal.jsonl"
    with pytest.raises(KeyboardInterrupt):
        minimise(dies, BOUNDS, method=method, population=20, generations=30, seed=5, journal=journal)
    with journal.open("a") as file:
        file.write('{"x": "half a li')  # killed while writing
    counted = 0

    def counts(X: Array) -> Array:
        nonlocal counted
        counted += 1
        return bowl(X)

    again = minimise(counts, BOUNDS, method=method, population=20, generations=30, seed=5, journal=journal)
    assert np.array_equal(again.x, whole.x)
    assert np.array_equal(again.trace, whole.trace)
    assert counted == 18


def test_journal_of_another_run_is_not_used(tmp_path: Path) -> None:
    journal = tmp_path / "journal.jsonl"
    minimise(bowl, BOUNDS, population=10, generations=5, seed=1, journal=journal)
    fresh = minimise(bowl, BOUNDS, population=10, generations=5, seed=2)
    again = minimise(bowl, BOUNDS, population=10, generations=5, seed=2, journal=journal)
    assert np.array_equal(fresh.x, again.x)


def test_thinning_keeps_oscillations_and_works(records: list[Harmonic]) -> None:
    record = records[-1]
    thin = record.thinned(64)
    assert len(thin.marks) == len(record.marks)
    assert np.array_equal(thin.time[thin.marks], record.time[record.marks])
    assert len(thin.time) == thin.marks[0] + 19 * 64 + 1
    assert record.works() == pytest.approx(thin.works(), rel=0.1)


def test_bad_records_are_refused(basic: Damper, records: list[Harmonic]) -> None:
    with pytest.raises(InputError, match="no records"):
        Objective(basic, TABLE_6, [], with_work=True)
    r = records[0]
    bad = Harmonic(r.oil_level, 0, r.time, r.stroke * 10, r.velocity, r.force, r.marks)
    with pytest.raises(InputError, match="stroke"):
        Objective(basic, TABLE_6, [bad], with_work=True)
