"""Trials: seeds, written files, findings of the data checks."""

import inspect

import numpy as np
import pytest

from twintube.dampers import load
from twintube.data import DataError, check_dataset
from worlds.blind_trials.hidden import EFFECTS, FAULTS, KINDS, OUTSIDE, secret
from worlds.blind_trials.trials import dataset, plans, trial, write

SHORT = (0.524,)


def short_trial(kind, seed=1, **options):
    return trial(kind, seed, **({"blocks": SHORT} | options))


def equal_records(a, b):
    return all(np.array_equal(x.force, y.force) and np.array_equal(x.stroke, y.stroke) for x, y in zip(a, b, strict=True))


def test_the_catalogue_is_the_contract_s():
    assert len(EFFECTS) == 15 and len(FAULTS) == 5 and len(OUTSIDE) >= 4
    assert len(set(KINDS)) == len(KINDS) == len(EFFECTS) + len(FAULTS) + 2 + len(OUTSIDE)


def test_a_whole_dataset_has_all_records():
    names = [
        plan.file for plan in plans(load("SA8", as_published=True), inspect.signature(trial).parameters["blocks"].default)
    ]
    assert len(names) == len(set(names)) == 1 + 8 + 2 * 9
    assert sum(name.endswith("_rest") for name in names) == 2


@pytest.mark.slow
def test_recovery_records_are_added_to_the_others(tmp_path):
    usual, extended = short_trial("none"), short_trial("none", recover=(1.08,), seconds=2.0)
    added = extended.records[len(usual.records) :]
    assert [(record.oil_level, record.gas_preload) for record in added] == [(0.9, False)] * 4 + [(0.5604, False)] * 4
    lengths = {record.file.split("rest_")[1]: record.time[-1] for record in added[:4]}
    assert lengths["180s.parquet"] - lengths["10s.parquet"] == pytest.approx(170.0, abs=0.05)
    assert lengths["10s_slow.parquet"] - lengths["10s.parquet"] == pytest.approx(
        6.1 * 2 * np.pi * 0.045 / 0.05 + 2.0, abs=0.05
    )
    assert not check_dataset(write(extended, tmp_path)).errors


READ = [kind for kind in KINDS if kind not in ("sign_flip", "unit_error")]
SOME = READ[::3]  # by default; the others at night


@pytest.mark.parametrize("kind", [kind if kind in SOME else pytest.param(kind, marks=pytest.mark.slow) for kind in READ])
def test_every_kind_is_read(kind, tmp_path):
    result = check_dataset(write(short_trial(kind), tmp_path))
    assert not result.errors
    warnings = {finding.message.split(":")[0] for finding in result.findings}
    assert warnings - ({"clipped"} if kind == "clipping" else set()) <= {
        "jitter",
        "no full cycle of stroke",
        "velocity explains the stroke but for 5.0%",
    }


def test_a_flipped_sign_is_refused(tmp_path):
    errors = check_dataset(write(short_trial("sign_flip"), tmp_path)).errors
    assert errors and all("force_sign" in error.message for error in errors)
    with pytest.raises(DataError):
        dataset(short_trial("sign_flip"))


def test_a_wrong_unit_is_refused_or_read(tmp_path):
    for seed in range(4):
        wrong = short_trial("unit_error", seed)
        result = check_dataset(write(wrong, tmp_path / str(seed)))
        assert all("mixed up" in error.message for error in result.errors)
        assert bool(result.errors) == (wrong.truth["force_factor"] == 1e-3)


def test_the_seed_decides(tmp_path):
    first, again, other_seed = short_trial("valve_wear"), short_trial("valve_wear"), short_trial("valve_wear", 2)
    assert equal_records(first.records, again.records) and first.truth == again.truth
    assert first.truth != other_seed.truth and not np.array_equal(
        first.records[1].force[:50], other_seed.records[1].force[:50]
    )
    a, b = write(first, tmp_path / "a"), write(again, tmp_path / "b")
    assert sorted(path.name for path in a.iterdir()) == sorted(path.name for path in b.iterdir())
    assert all(path.read_bytes() == (b / path.name).read_bytes() for path in a.iterdir())


def test_strength_is_drawn_about_one_or_given():
    drawn = [secret("end_stop", seed, load("SA8", as_published=True).parameters, None)[1] for seed in range(40)]
    assert 0.5 <= min(drawn) < 0.7 and 1.3 < max(drawn) <= 1.5
    assert short_trial("valve_wear", strength=0.3).strength == 0.3
    half, full = (
        secret("valve_wear", 1, load("SA8", as_published=True).parameters, x)[0].always["wear_re"] for x in (0.5, 1.0)
    )
    assert full == pytest.approx(2 * half)


def test_a_pair_contains_both_kinds_unchanged():
    p = load("SA8", as_published=True).parameters
    pair = secret("end_stop+force_offset", 5, p, None)[0]
    assert pair.always == secret("end_stop", 5, p, None)[0].always
    assert pair.measurement == secret("force_offset", 5, p, None)[0].measurement
    with pytest.raises(ValueError, match="unknown kind 'nothing'"):
        short_trial("end_stop+nothing")


def test_nothing_of_the_truth_is_written(tmp_path):
    text = (write(short_trial("seal_leak"), tmp_path) / "dataset.toml").read_text()
    assert "leak" not in text and "seal" not in text and text.count("[[record]]") == 4


def test_faults_of_the_measurement_act_on_the_channels():
    plain, gain = short_trial("force_gain", strength=0.0), short_trial("force_gain", strength=1.0)
    ratio = gain.records[1].force / plain.records[1].force
    assert np.ptp(ratio) < 1e-9 and 0.08 < abs(ratio[0] - 1) < 0.14
    plain, moved = short_trial("force_offset", strength=0.0), short_trial("force_offset", strength=1.0)
    extra = moved.records[2].force - plain.records[2].force
    assert np.ptp(extra) < 1e-9 and 0.03 < abs(extra[0]) / max(abs(r.force).max() for r in plain.records) < 0.045
    late = short_trial("channel_delay", strength=1.0)
    assert 4e-3 <= max(late.truth.get("force_late", 0), late.truth.get("stroke_late", 0)) <= 5.3e-3
    flat = short_trial("clipping", strength=1.0).records[1].force
    assert np.mean(np.isclose(np.abs(flat), np.abs(flat).max())) > 0.01


def test_a_written_trial_is_read_unchanged():
    original = short_trial("none")
    loaded = dataset(original)
    assert [record.file for record in loaded.records] == [record.file for record in original.records]
    for a, b in zip(loaded.records, original.records, strict=True):
        np.testing.assert_allclose(a.stroke, b.stroke, atol=1e-8)
        np.testing.assert_allclose(a.force, b.force, atol=1e-4)
        assert a.start_temperature == b.start_temperature_degC
