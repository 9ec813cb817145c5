"""Folders: the same from the same seed, readable, the truth beside them; every cause in every block of seeds."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from twintube.data import check_dataset
from worlds.challenge import CAUSES, cause_of, write
from worlds.challenge.generate import CYCLE, logged, runs_of
from worlds.challenge.plan import bench_for
from worlds.model.run import finished, sampled
from worlds.scoring.truth import read_truths


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def test_a_seed_is_a_dataset(tmp_path: Path) -> None:
    truths = [write(2, tmp_path / name, "heat_run") for name in "ab"]
    assert truths[0] == truths[1]
    assert contents(tmp_path / "a") == contents(tmp_path / "b")
    truth = read_truths(tmp_path / "a" / "truth.json")[""]
    assert truth.causes == ("oil_temperature",) and (truth.effect_over_noise or 0.0) > 0.0
    dataset = check_dataset(tmp_path / "a" / "dataset")
    assert not dataset.errors and dataset.records[0].temperature is not None


def test_none_is_the_kernel_within_the_noise() -> None:
    bench = bench_for(frozenset({"sine"}), False, np.random.default_rng(5))
    run = finished(runs_of(bench, 10.0)[0])
    exact = sampled(run, bench.recorder)
    quiet = replace(bench, zero=0.0, colour=0.0)
    noise = logged(exact, run, quiet, sigma=20.0, step=0.1, rng=np.random.default_rng(1))["force [N]"] - exact[2]
    assert np.std(noise) == pytest.approx(20.0, rel=0.1)
    assert abs(np.mean(noise)) < 100.0 / np.sqrt(len(noise))


def test_a_wrong_unit_is_in_the_file_alone() -> None:
    bench = replace(bench_for(frozenset({"sine"}), False, np.random.default_rng(5)), stroke_noise=0.0)
    plain = finished(runs_of(bench, 10.0)[0])
    wrong = replace(plain, unit=(0.1, 1.0))
    told = [
        logged(sampled(r, bench.recorder), r, bench, sigma=20.0, step=0.1, rng=np.random.default_rng(1))
        for r in (plain, wrong)
    ]
    assert told[1]["force [N]"] == pytest.approx(0.1 * told[0]["force [N]"])
    assert np.array_equal(told[1]["stroke [mm]"], told[0]["stroke [mm]"])


def test_every_block_of_seeds_hides_everything() -> None:
    drawn = [cause_of(seed) for seed in range(len(CYCLE))]
    assert set(CAUSES) <= set(drawn) and drawn != sorted(drawn)
    assert drawn.count("none") + drawn.count("none_history") >= 10


def test_each_effect_has_two_formulations() -> None:
    for name, cause in CAUSES.items():
        if cause.kind in ("effect", "fault") and not cause.label:
            assert len(cause.formulations) >= 2, name


def test_an_unknown_cause_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="unknown cause rust"):
        write(1, tmp_path / "d", "rust")
