"""Step one: the intact damper from its records."""

from dataclasses import replace

import numpy as np
import pytest

from twintube.dampers import Damper, load, names
from twintube.engine.simulate import InputError, simulate
from twintube.fitting.harmonic import Harmonic
from twintube.identification import identify_damper
from twintube.identification.intact import identify_intact, quasi_static
from twintube.rig.plan import quasi_static as ramp
from twintube.rig.signals import BLOCKS, harmonic_block


def intact_records(damper: Damper, noise: float) -> list[Harmonic]:
    rng = np.random.default_rng(1)
    blocks = []
    for v in BLOCKS:
        block = harmonic_block(v, dt=4e-4)
        force = simulate(damper, block.stroke, block.velocity).force
        force = force + rng.normal(0, noise * np.abs(force).max(), len(force))
        blocks.append(Harmonic(1.0, 1, block.time, block.stroke, block.velocity, force, block.marks))
    return blocks


@pytest.mark.parametrize("name", names())
def test_curve_friction_and_gas_spring_come_back(name: str) -> None:
    truth = load(name, as_published=True)
    signal = ramp(truth)
    slow = (signal.stroke, simulate(truth, signal.stroke, signal.velocity).force)
    records = intact_records(truth, noise=0.01)
    other = {"F_FrS": 10.0, "F_0": 1.0, "c_gas": 1.0, "sigma_0": 1e4, "v_re": load("SA1", as_published=True).parameters.v_re,
             "F_re": [2 * F for F in load("SA1", as_published=True).parameters.F_re]}  # fmt: skip
    damper, estimates = identify_intact(truth.with_(**other), slow, records)
    identified = damper.parameters
    p = truth.parameters
    for e in estimates:
        assert e.low <= getattr(identified, e.name) <= e.high
    assert identified.F_FrS == pytest.approx(p.F_FrS, rel=0.03)
    assert pytest.approx(p.F_0, abs=2.0) == identified.F_0
    assert identified.c_gas == pytest.approx(p.c_gas, rel=0.02)
    assert identified.sigma_0 == pytest.approx(p.sigma_0, rel=0.15)
    for v in BLOCKS:
        for speeds, forces, true_speeds, true_forces in (
            (identified.v_re, identified.F_re, p.v_re, p.F_re), (identified.v_co, identified.F_co, p.v_co, p.F_co)
        ):  # fmt: skip
            expected = np.interp(v, [0, *true_speeds], [0, *true_forces])
            assert np.interp(v, [0, *speeds], [0, *forces]) == pytest.approx(expected, rel=0.02, abs=5.0)


def test_a_single_slow_oscillation_from_the_middle_is_enough() -> None:
    """Upwards it has no stroke from end to end, but two halves."""
    truth = load("SA8", as_published=True)
    angle = np.linspace(0.0, 2 * np.pi, 2001)
    stroke = 0.045 * np.sin(angle)
    time = angle * 0.045 / 1e-4  # so slow that the valves hardly act
    force = simulate(truth, stroke, 1e-4 * np.cos(angle), time).force
    seen = quasi_static(stroke, force + np.random.default_rng(3).normal(0.0, 0.5, len(force)))
    for name in ("F_FrS", "F_0", "c_gas", "sigma_0"):
        expected, (spread, freedom) = getattr(truth.parameters, name), seen.errors[name]
        assert getattr(seen, name) == pytest.approx(expected, rel=0.15 if name == "sigma_0" else 0.03)
        assert freedom >= 1 and 0.0 < spread < 0.2 * expected
    with pytest.raises(InputError, match="no full stroke in both directions"):
        quasi_static(stroke[:1200], force[:1200])


def test_intact_identification_predicts_a_held_out_block() -> None:
    truth = load("SA7", as_published=True)
    records = intact_records(truth, noise=0.01)
    held_out = records.pop(4)
    damper, _ = identify_intact(truth, None, records)
    predicted = simulate(damper, held_out.stroke, held_out.velocity).force
    rmse = np.sqrt(np.mean((predicted - held_out.force) ** 2))
    assert rmse < 0.06 * np.abs(held_out.force).max()


def test_both_signs_turned_are_remarked_beside_a_slow_record() -> None:
    truth = load("SA8", as_published=True)
    signal = ramp(truth)
    slow = (signal.stroke, simulate(truth, signal.stroke, signal.velocity).force)
    records = intact_records(truth, noise=0.01)[:3]
    assert not any("pulls the rod in" in remark for remark in identify_damper(truth, slow, records, []).remarks)
    turned = [replace(r, stroke=-r.stroke, velocity=-r.velocity, force=-r.force) for r in records]
    remarks = identify_damper(truth, (-slow[0], -slow[1]), turned, []).remarks
    assert any("pulls the rod in" in remark and "force_sign = -1" in remark for remark in remarks)


def test_bad_records_are_refused() -> None:
    z = np.linspace(-0.04, 0.04, 200)
    with pytest.raises(InputError, match="no full stroke in both directions"):
        quasi_static(z, 10 + 100 * z)
    there_and_back = np.concatenate([z, z[::-1]])
    with pytest.raises(InputError, match="check the signs"):
        quasi_static(there_and_back, np.where(np.arange(400) < 200, -30.0, 30.0))
    with pytest.raises(InputError, match="1 intact harmonic records"):
        identify_intact(load("SA1", as_published=True), None, intact_records(load("SA1", as_published=True), 0.0)[:1])
    beside = [
        replace(record, stroke=record.stroke + 0.2) for record in intact_records(load("SA1", as_published=True), 0.0)[:2]
    ]
    with pytest.raises(InputError, match=r"never crosses 0, the middle position; set stroke_offset"):
        identify_intact(load("SA1", as_published=True), None, beside)
