"""A force channel smoothed over the same share of every oscillation is recognised, and nothing else is taken for it."""

from dataclasses import replace
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from scipy.ndimage import uniform_filter1d

from tests.diagnosis.test_signature import AMPLITUDE, bench, changed
from twintube.dampers import load
from twintube.data import Record, load_dataset
from twintube.diagnosis.measurement.signature import oscillating
from twintube.fitting.averaging import averaged, averaged_means, averaging, period, through
from twintube.identification import Harmonic
from twintube.identification.sines import identify_sines
from twintube.identification.validation import validate_harmonic

EXAMPLES = Path(str(files("twintube.examples")))
SMALL = 0.02  # [m] amplitude


def blocks(records: list[Record]) -> list[Harmonic]:
    return [block for _, block in oscillating(records)]


def smoothed(records: list[Record], share: float = 0.0, samples: int = 0) -> list[Record]:
    """The records after a moving mean by whole samples, as a script would make it."""
    lengths = {
        b.name: max(1, round(share * float(np.median(np.diff(b.marks))))) if share else samples for b in blocks(records)
    }
    return changed(records, lambda r: uniform_filter1d(r.force, lengths[r.name], mode="nearest"))


@pytest.mark.parametrize("noise", [0.002, 0.01])
@pytest.mark.parametrize("share", [0.07, 0.1, 0.15])
def test_the_share_is_recognised(noise: float, share: float) -> None:
    seen = averaging(blocks(smoothed(bench(noise, 1, slow=SMALL), share)))
    assert seen is not None
    assert seen.share == pytest.approx(share, rel=0.04)
    assert "smoothed after the measurement" in seen.text


@pytest.mark.parametrize("noise", [0.0, 0.005, 0.03])
def test_a_good_measurement_was_not_smoothed(noise: float) -> None:
    for seed in range(3):
        assert averaging(blocks(bench(noise, seed))) is None


def test_a_filter_of_the_amplifier_is_something_else() -> None:
    """It is as long at every velocity, so its zeros lie at other harmonics in each record."""
    records = smoothed(bench(0.002, 1, rate=1000.0, slow=SMALL), samples=15)
    assert averaging(blocks(records)) is None


def test_records_of_a_single_velocity_do_not_show_it() -> None:
    """A knee of the F-v curve is at the same phase in all of them."""
    records = [replace(r, name=f"{r.name}_{i}") for i, r in enumerate([bench(0.002, 1)[2]] * 4)]
    assert averaging(blocks(smoothed(records, 0.1))) is None


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_spring_that_touches_at_a_fixed_phase_is_not_taken_for_it(side: float) -> None:
    """At one amplitude a stop makes zeros at the same harmonics at every velocity; at two it does not touch at one phase."""
    for slow, onset in ((AMPLITUDE, 0.8 * AMPLITUDE), (SMALL, 0.8 * SMALL)):
        some = changed(
            bench(0.005, 1, slow=slow), lambda r, o=onset: r.force + side * 1.5e5 * np.maximum(side * r.stroke - o, 0.0)
        )
        assert averaging(blocks(some)) is None


def test_physics_is_not_taken_for_it() -> None:
    """Records of equations that are not the model's, whose oil gets warm."""
    assert averaging(blocks(list(load_dataset(EXAMPLES / "bench_SA8").records))) is None


def test_the_mean_of_a_ramp_and_of_a_wave() -> None:
    time = np.linspace(0.0, 2.0, 4001)
    inner = slice(200, -200)
    np.testing.assert_allclose(averaged(time, 3.0 * time, 0.1)[inner], 3.0 * time[inner], rtol=1e-6)
    wave = averaged(time, np.column_stack([np.sin(20 * time), np.cos(20 * time)]), 0.1)
    np.testing.assert_allclose(wave[inner, 0], np.sin(20 * time[inner]) * np.sinc(1 / np.pi), rtol=0, atol=1e-4)
    assert np.array_equal(averaged(time, time, 0.0), time)


def test_means_of_intervals_are_those_of_the_mean() -> None:
    """Against the moving mean of densely sampled steps."""
    rng = np.random.default_rng(2)
    time = np.cumsum(rng.uniform(0.01, 0.04, 40))
    force, window = rng.normal(0.0, 100.0, 40), 0.07

    fine = np.linspace(time[0], time[-1], 200_001)
    mean = averaged(fine, force[np.clip(np.searchsorted(time, fine), 1, 39)], window)
    for i in range(6, 34):
        inside = (fine >= time[i - 1]) & (fine <= time[i])
        assert averaged_means(time, force, window)[i] == pytest.approx(mean[inside].mean(), abs=0.2)


def test_a_damper_identified_through_the_mean_predicts_records_that_were_not_smoothed() -> None:
    """Of the model's own damper: on real ones other errors may be larger, see docs/diagnosis.md."""
    measured = [r for r in bench(0.002, 1, slow=SMALL) if r.gas_preload]
    raw, plain = blocks(measured), blocks(smoothed(measured, 0.1))
    errors = []
    for records in (plain, [replace(r, averaged=0.1 * period(r)) for r in plain]):
        fit = identify_sines(load("SA8", as_published=True), records)
        errors.append([validate_harmonic(fit.damper, r, "heldout", fit.offset).force_rmse for r in raw])
    assert np.mean(errors[1]) < 0.7 * np.mean(errors[0])


def test_every_record_gets_its_own_length() -> None:
    some = blocks(smoothed(bench(0.002, 1, slow=SMALL), 0.1))
    seen = averaging(some)
    assert seen is not None
    for block in through(some, seen):
        assert block.averaged == pytest.approx(seen.share * period(block))
