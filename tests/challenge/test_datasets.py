"""Folders: the same from the same seed, readable in every format, the truth beside them."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from twintube.data import check_dataset
from twintube.lab.challenge import CAUSES, cause_of, write
from twintube.lab.challenge.files import write_dataset
from twintube.lab.challenge.generate import CYCLE, runs_of
from twintube.lab.challenge.plan import FORMATS, bench_for
from twintube.lab.challenge.run import finished, marched
from twintube.lab.challenge.sampling import logged, sampled


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir())}


def test_a_seed_is_a_dataset(tmp_path: Path) -> None:
    truths = [write(2, tmp_path / name / "data", "heat_run") for name in "ab"]
    assert truths[0] == truths[1]
    assert contents(tmp_path / "a" / "data") == contents(tmp_path / "b" / "data")
    kept = json.loads((tmp_path / "a" / "data.truth.json").read_text(encoding="utf-8"))
    assert kept["cause"] == "oil_temperature" and kept["effect_over_noise"] > 0.0
    assert "truth" not in " ".join(contents(tmp_path / "a" / "data"))
    dataset = check_dataset(tmp_path / "a" / "data")
    assert not dataset.errors and dataset.records[0].temperature is not None


def test_none_is_the_kernel_within_the_noise() -> None:
    bench = bench_for(frozenset({"sine"}), False, np.random.default_rng(5))
    run = finished(marched(runs_of(bench, 10.0)[0]), [])
    exact = sampled(run, bench.fs, bench.sampling, None)
    sampling = replace(bench.sampling, zero=0.0, colour=0.0)
    noisy = logged(exact, replace(bench, sampling=sampling), 20.0, 5e3, 0.06, np.random.default_rng(1))
    assert np.std(noisy.force - exact.force) == pytest.approx(20.0, rel=0.1)
    assert abs(np.mean(noisy.force - exact.force)) < 100.0 / np.sqrt(len(exact.time))


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("milliseconds", [True, False])
def test_formats_are_read_as_written(form: str, milliseconds: bool, tmp_path: Path) -> None:
    bench = bench_for(frozenset({"sine"}), False, np.random.default_rng(8))
    bench = replace(bench, orders=bench.orders[:1], records=bench.records[:1], format=form, milliseconds=milliseconds)
    run = finished(marched(runs_of(bench, 10.0)[0]), [])
    samples = sampled(run, bench.fs, bench.sampling, None)
    write_dataset(tmp_path, bench, "title", [(samples, (1.0, 1.0))])
    dataset = check_dataset(tmp_path)
    assert not dataset.errors
    (record,) = dataset.records
    assert record.force == pytest.approx(samples.force, abs=1e-3)
    assert record.stroke == pytest.approx(samples.stroke, abs=1e-6)
    assert record.time == pytest.approx(samples.time, abs=1e-6)
    assert record.oil_level == pytest.approx(bench.records[0].level, abs=1e-4)


def test_every_block_of_seeds_hides_everything() -> None:
    drawn = [cause_of(seed) for seed in range(len(CYCLE))]
    assert set(CAUSES) <= set(drawn) and drawn != sorted(drawn)
    assert drawn.count("none") + drawn.count("none_history") >= 10


def test_each_effect_has_two_formulations() -> None:
    for name, cause in CAUSES.items():
        if cause.kind in ("effect", "fault", "recalibrate") and not cause.label:
            assert len(cause.formulations) >= 2, name


def test_an_unknown_cause_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="unknown cause rust"):
        write(1, tmp_path / "d", "rust")
