"""Friction and gas spring of noisy strokes: values, intervals, what the validation and the remarks say."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.identification.test_workflow import measured
from twintube.core.kernel import stribeck
from twintube.dampers import Damper, load, to_toml
from twintube.data import Record, load_dataset
from twintube.engine.simulate import InputError, simulate
from twintube.fitting.oscillations import harmonic
from twintube.identification import headline, identify_dataset
from twintube.identification.figures import totals
from twintube.identification.intact_intervals import INTACT
from twintube.identification.remarks import noisy
from twintube.identification.sines import SineFit, identify_sines, saturation
from twintube.identification.validation import validate_drives, validate_harmonic
from twintube.rig.signals import harmonic_block

STROKE_NOISE = 2e-5  # [m]
SPEEDS = (0.05, 0.131, 0.262)


def little_friction() -> Damper:
    """Friction builds up over 45 um, as in a racing damper."""
    return load("SA1", as_published=True).with_(F_FrS=18.2, sigma_0=401e3)


def record(damper: Damper, v: float, seed: int, stroke_noise: float, amplitude: float = 0.03) -> Record:
    rng = np.random.default_rng(seed)
    block = harmonic_block(v, amplitude, dt=2e-3)
    force = simulate(damper, block.stroke, block.velocity, block.time).force
    force = force + rng.normal(0.0, 0.005 * np.abs(force).max(), len(force))
    stroke = block.stroke + rng.normal(0.0, stroke_noise, len(force))
    return replace(measured(block.time, stroke, force, f"v{v}"), oil_level=1.0, gas_preload=True, velocity_source="gradient")


def fitted(stroke_noise: float) -> tuple[list[Record], SineFit]:
    records = [record(little_friction(), v, i, stroke_noise) for i, v in enumerate(SPEEDS)]
    return records, identify_sines(load("SA1", as_published=True), [harmonic(r) for r in records])


@pytest.fixture(scope="module")
def noisy_fit() -> tuple[list[Record], SineFit]:
    return fitted(STROKE_NOISE)


def test_friction_does_not_count_noise_as_reversals(noisy_fit: tuple[list[Record], SineFit]) -> None:
    clean, p = fitted(0.0)[1].damper.parameters, noisy_fit[1].damper.parameters
    assert pytest.approx(clean.F_FrS, rel=0.05) == p.F_FrS
    assert pytest.approx(clean.F_0, rel=0.02) == p.F_0
    assert p.sigma_0 == pytest.approx(clean.sigma_0, rel=0.15)


def test_intervals_hold_the_truth_and_say_something(noisy_fit: tuple[list[Record], SineFit]) -> None:
    estimates = noisy_fit[1].estimates
    assert tuple(e.name for e in estimates) == INTACT
    for e in estimates:
        truth = getattr(little_friction().parameters, e.name)
        assert e.low <= truth <= e.high
        assert e.high > e.low
    assert all(e.determined for e in estimates if e.name != "sigma_0")


def test_validation_shows_what_the_noise_does(noisy_fit: tuple[list[Record], SineFit]) -> None:
    records, fit = noisy_fit
    row = validate_harmonic(fit.damper, harmonic(records[0]), "fit", fit.offset)
    assert row.stroke_noise == pytest.approx(STROKE_NOISE, rel=0.1)
    assert row.force_rmse_recorded is not None and row.force_rmse_recorded > 1.05 * row.force_rmse
    assert "was taken out" in noisy(fit.damper, [harmonic(r) for r in records])[0]
    clean = validate_harmonic(fit.damper, harmonic(record(little_friction(), 0.262, 0, 0.0)), "fit", fit.offset)
    assert clean.stroke_noise == 0.0 and clean.force_rmse_recorded is None


def test_drives_count_in_the_headline_and_take_the_zero_of_the_load_cell() -> None:
    damper, offset = load("SA1", as_published=True), 50.0
    drive = replace(record(damper, 0.131, 0, 0.0), measurement="stochastic")
    drive = replace(drive, force=drive.force + offset)
    (without,), (right,) = validate_drives(damper, [drive]), validate_drives(damper, [drive], offset)
    assert right.force_rmse < 0.2 * without.force_rmse
    sine = validate_harmonic(damper, harmonic(record(damper, 0.131, 0, 0.0)), "heldout")
    both = totals([sine, without], "heldout")
    assert both is not None and both["worst"] == without.name
    assert both["force_rmse_N"] > sine.force_rmse
    assert "2 records, 1 of them stochastic" in headline(both)
    alone = totals([without], "heldout")
    assert alone is not None and "work" not in headline(alone)


def test_samples_that_say_nothing_do_not_count() -> None:
    clean = [record(load("SA1", as_published=True), v, i, 0.0) for i, v in enumerate(SPEEDS[1:])]
    usable = np.ones(len(clean[0].time), dtype=bool)
    usable[-4000:-3700] = False
    wrong = replace(clean[0], force=np.where(usable, clean[0].force, 5e3))
    excluded = [harmonic(replace(wrong, usable=usable)), harmonic(clean[1])]
    fit, truth = identify_sines(load("SA1", as_published=True), excluded), load("SA1", as_published=True).parameters
    assert pytest.approx(truth.F_FrS, rel=0.05) == fit.damper.parameters.F_FrS
    assert validate_harmonic(fit.damper, excluded[0], "fit").force_rmse < 0.1 * 5e3
    assert validate_harmonic(fit.damper, harmonic(wrong), "fit").force_rmse > 0.1 * 5e3


def test_a_friction_damper_is_refused_before_the_search(monkeypatch: pytest.MonkeyPatch) -> None:
    def search(*_: object, **__: object) -> None:
        raise AssertionError("searched")

    monkeypatch.setattr("twintube.identification.sines.minimize_scalar", search)
    block = harmonic(record(load("SA1", as_published=True), 0.131, 0, 0.0))
    p = load("SA1", as_published=True).parameters
    scale = np.array([stribeck(p, float(v)) for v in block.velocity])
    rubbing = replace(block, force=10_800.0 * scale * saturation(block.stroke, 2e-4))
    with pytest.raises(InputError, match=r"friction of about \d{4,5} N, friction.F_FrS must be from 0 to 2000 N"):
        identify_sines(load("SA1", as_published=True), [rubbing])


@pytest.mark.parametrize(("kind", "message"), [("stochastic", "only stochastic"), ("quasi-static", "only quasi-static")])
def test_a_single_record_of_another_kind_is_refused(tmp_path: Path, kind: str, message: str) -> None:
    with pytest.raises(InputError, match=f"no harmonic record to identify from, {message}"):
        identify_dataset(load_dataset(folder(tmp_path, kind)))


def test_a_single_sine_says_what_it_cannot_tell(tmp_path: Path) -> None:
    result = identify_dataset(load_dataset(folder(tmp_path, "harmonic")))
    assert any(remark.startswith("a single harmonic record: ") for remark in result.remarks)


def folder(path: Path, kind: str) -> Path:
    """A dataset of a single record."""
    r = record(load("SA1", as_published=True), 0.131, 0, 0.0)
    (path / "damper.toml").write_text(to_toml(load("SA1", as_published=True)))
    table = np.column_stack([r.time, 1e3 * r.stroke, r.force])
    np.savetxt(path / "a.csv", table, "%.9g", ",", header="time [s],stroke [mm],force [N]", comments="")
    toml = 'title = "Single"\ndamper = "damper.toml"\n[[record]]\nfile = "a.csv"\noil_level = 1.0\ngas_preload = true\n'
    (path / "dataset.toml").write_text(f'{toml}measurement = "{kind}"\n')
    return path
