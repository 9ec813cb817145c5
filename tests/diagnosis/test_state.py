"""Oil loss that nobody tells is found in dampers that are off the model; what the records do not hold stays open."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib import pyplot
from scipy.stats import multivariate_normal
from typer.testing import CliRunner

from tests.diagnosis import small
from tests.diagnosis.specimen import own_law
from twintube.cli import app
from twintube.dampers import load
from twintube.data import LoadedDataset, UnknownFillError, load_dataset
from twintube.diagnosis import Answer, StateAnswer, states
from twintube.diagnosis.memory import innovations, lagged
from twintube.diagnosis.numbers import listed, numbers
from twintube.diagnosis.sizes import LARGEST, Sizes, log_weights
from twintube.identification import identify_dataset


def found(*runs: tuple[float, float], oil_level: float | None = None, gas_preload: bool | None = None) -> StateAnswer:
    """The answer to records of (speed, oil level) of which no more is stated than given."""
    records = []
    for i, (speed, level) in enumerate(runs):
        run = small.run(speed, level)
        seen = small.record(run, own_law(run), seed=i)
        records.append(replace(seen, oil_level=oil_level, gas_preload=gas_preload, state="1"))
    return states(LoadedDataset("small", load("SA8", as_published=True), records, []))[0]


@pytest.fixture(scope="module")
def worn() -> StateAnswer:
    return found((0.3, small.DEGRADED), (0.6, small.DEGRADED))


def test_oil_and_gas_that_are_missing_are_found(worn: StateAnswer) -> None:
    low, high = worn.posterior.interval()
    assert low <= small.DEGRADED <= high
    assert high - low <= 0.1
    assert worn.posterior.gas_lost > 0.95
    found = Answer("small", load("SA8"), (), (worn,), None, (), False, None, 0.0)
    row = found.to_dataframe().loc["1"]
    assert row["low"] <= row["oil_level"] <= row["high"] and row["gas_lost"] > 0.95
    assert row["gas_low"] <= row["gas_preload"] <= row["gas_high"]
    assert found.plot().axes[0].get_xlabel() == "oil level [% of the intact volume]"
    pyplot.close("all")


def test_what_the_force_does_not_hold_stays_open() -> None:
    """An intact damper below its speed of cavitation is the same at every level above that of collapse."""
    answer = found((0.3, small.INTACT))
    low, high = answer.posterior.interval()
    assert answer.posterior.gas_lost < 0.05
    assert high == 1.0
    assert high - low > 0.2


def test_a_stated_preload_is_believed_unless_the_records_contradict() -> None:
    answer = found((0.3, small.DEGRADED), gas_preload=False)
    low, high = answer.posterior.interval()
    assert answer.posterior.as_stated > 0.9
    assert low <= small.DEGRADED <= high


def test_a_statement_that_is_wrong_does_not_stand() -> None:
    """The records of a damper that has lost oil and gas, of which a file says the level of a full one."""
    answer = found((0.3, small.DEGRADED), (0.6, small.DEGRADED), oil_level=1.0)
    low, high = answer.posterior.interval()
    assert answer.posterior.as_stated < 0.01
    assert low <= small.DEGRADED <= high


def test_probabilities(worn: StateAnswer) -> None:
    p = worn.posterior
    assert p.probability.sum() == pytest.approx(1.0)
    assert np.all(p.probability >= 0.0)
    inner, outer = p.interval(0.5), p.interval(0.99)
    assert outer[0] <= inner[0] <= p.level <= inner[1] <= outer[1]


def test_known_states_are_not_answered() -> None:
    run = small.run(0.3)
    data = LoadedDataset("small", load("SA8", as_published=True), [small.record(run)], [])
    assert states(data) == []


def test_command(tmp_path: Path) -> None:
    """The page and its JSON; an identification asks for the fill."""
    run = small.run(0.6, small.DEGRADED)
    folder = tmp_path / "bench"
    folder.mkdir()
    seen = small.record(run, own_law(run))
    rows = np.column_stack([seen.time, 1e3 * seen.stroke, seen.force])
    np.savetxt(folder / "a.csv", rows, delimiter=",", header="time [s],stroke [mm],force [N]", comments="")
    fill = 'oil_level = "unknown"\ngas_preload = "unknown"\n'
    text = f'damper = "SA8"\n[[record]]\nfile = "a.csv"\nmeasurement = "harmonic"\n{fill}'
    (folder / "dataset.toml").write_text(text, encoding="utf-8")
    done = CliRunner().invoke(app, ["diagnose", str(folder), "--output", str(tmp_path / "out")])
    assert done.exit_code == 0, done.output
    assert "% of its oil" in done.output
    content = json.loads((tmp_path / "out/diagnosis.json").read_text())
    assert content["verdict"] == "state"
    (entry,) = content["state"]
    assert set(entry) == {"records", "stated", "as_stated", "oil_level", "gas_preload", "gas_lost", "tared_cell"}
    low, high = entry["oil_level"]["interval"]
    assert low <= entry["oil_level"]["value"] <= high
    assert "% of its oil" in (tmp_path / "out/report.html").read_text(encoding="utf-8")
    assert (tmp_path / "out/state.png").stat().st_size > 0
    with pytest.raises(UnknownFillError, match=r"a\.csv: oil_level and gas_preload are unknown"):
        identify_dataset(load_dataset(folder))


def test_innovations_are_the_density_of_noise_with_memory() -> None:
    rng = np.random.default_rng(3)
    n, kept = 30, 0.8
    sigma, size = rng.uniform(0.5, 2.0, n), rng.uniform(0.0, 3.0, n)
    shares = np.full(n, kept)
    y = rng.normal(size=(n, 1))
    out = np.empty_like(y)
    half = innovations(y, sigma, size, shares, out)
    apart = np.abs(np.arange(n)[:, None] - np.arange(n))
    covariance = np.diag(sigma**2) + size[:, None] * kept**apart * size
    expected = multivariate_normal(np.zeros(n), covariance).logpdf(y[:, 0])
    assert -0.5 * float(np.sum(out**2)) - half == pytest.approx(expected)


def test_a_lag_keeps_what_is_steady() -> None:
    assert lagged(np.full(20, 3.0), np.full(20, 0.7)) == pytest.approx(np.full(20, 3.0))
    step = lagged(np.concatenate([np.zeros(1), np.ones(20)]), np.full(21, 0.5))
    assert step[-1] == pytest.approx(1.0, abs=1e-5)
    assert np.all(np.diff(step) >= 0.0)


def test_prior_weights_of_the_sizes_sum_to_one() -> None:
    n = numbers()
    for grid, scale in ((n.law_sizes, n.law_usual), (n.own_sizes, n.own_usual), (n.lasting_sizes, n.lasting_usual)):
        assert np.exp(log_weights(grid, scale)).sum() == pytest.approx(1.0)
    assert len(Sizes(0, 0, 0).beside(LARGEST)) == 4


def test_every_number_has_a_unit_a_meaning_and_a_source() -> None:
    assert len(listed()) <= 45
    assert all(entry[key] for entry in listed() for key in ("unit", "meaning", "source"))
