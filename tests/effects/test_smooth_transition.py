"""Exponential build-up over the stroke."""

import math

import numpy as np
import pytest

from twintube.core import model
from twintube.core.effects import State
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import Damper, load
from twintube.engine.simulate import simulate
from twintube.rig.signals import harmonic_block


@pytest.mark.parametrize("steps", [1, 7])
def test_step_becomes_an_exponential(steps: int) -> None:
    """As tests/kernel/test_limits.py: with X_Re = 0 k_degr steps from 0 to 1 when V1 has no gas left."""
    p = load("SA7", as_published=True).with_(dead_length=0.13, oil_level=0.35, gas_preload=0, build_up=0.01).parameters
    d, s, f = blank(Derived), blank(State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    edge = s.V1_gas / d.A_1 * (1 - 1e-9)
    model.advance(p, d, s, f, edge, 0.04, 0.04, 0.0)
    assert s.k_degr == 0.0
    work = s.work
    for i in range(1, steps + 1):
        model.advance(p, d, s, f, edge + 0.005 * i / steps, 0.04, 0.04, 0.0)
    assert f.k_degr == pytest.approx(1 - math.exp(-0.5))
    # The mean over the stroke is in the work, whatever the step.
    force = s.F_fluid / s.k_degr
    mean = 1 - (1 - math.exp(-0.5)) / 0.5
    assert s.work - work - s.F_friction * 0.005 == pytest.approx(force * mean * 0.005, rel=1e-3)
    # Back in compression the branch starts at its own value.
    model.advance(p, d, s, f, s.z, -0.04, -0.04, 0.0)
    assert s.k_degr == s.k_flow


def test_a_short_length_changes_nothing(sa8: Damper) -> None:
    block = harmonic_block(1.048)
    plain, smooth = (simulate(x, block.stroke, block.velocity) for x in (sa8, sa8.with_(build_up=1e-7)))
    assert np.abs(smooth.force - plain.force).max() < 2.0
    assert smooth.work[-1] == pytest.approx(plain.work[-1], rel=1e-4)


def test_k_stays_between_its_values(sa8: Damper) -> None:
    block = harmonic_block(1.572)
    result = simulate(sa8.with_(build_up=0.03), block.stroke, block.velocity)
    assert result.k_degr.min() >= 0.0
    assert result.k_degr.max() <= 1.0


def test_part_of_the_rise_comes_before_the_gas_has_run_out() -> None:
    p = (
        load("SA7", as_published=True)
        .with_(dead_length=0.13, oil_level=0.35, gas_preload=0, build_up=0.01, early_share=0.5)
        .parameters
    )
    d, s, f = blank(Derived), blank(State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    edge = s.V1_gas / d.A_1
    found = []
    for i in range(1, 2001):
        model.advance(p, d, s, f, (edge + 0.03) * i / 2000, 0.04, 0.04, 0.0)
        found.append((s.z - edge, f.k_degr, s.k_degr))
    for x, k, mean in found[1:]:
        exact = 0.5 * max(0.0, 1 + x / 0.02) ** 2 if x < 0 else 1 - 0.5 * math.exp(-x / 0.01)
        assert k == pytest.approx(exact, abs=0.01)
        assert mean == pytest.approx(k, abs=0.01)


def test_a_time_instead_of_a_length() -> None:
    """What is missing after the gas has run out fades with the time, whatever the velocity."""
    for velocity in (0.02, 0.05):
        p = load("SA7", as_published=True).with_(dead_length=0.13, oil_level=0.35, gas_preload=0, tau_build=0.01).parameters
        d, s, f = blank(Derived), blank(State), blank(Flow)
        model.set_up(p, d)
        model.start(p, d, s, 0.0)
        edge = s.V1_gas / d.A_1 * (1 - 1e-9)
        model.advance(p, d, s, f, edge, velocity, velocity, 0.0)
        for i in range(1, 11):
            model.advance(p, d, s, f, edge + velocity * 0.001 * i, velocity, velocity, 0.0)
            assert f.k_degr == pytest.approx(1 - math.exp(-0.1 * i), rel=1e-5)


@pytest.mark.parametrize("share", [0.0, 0.4, 1.0])
def test_what_lasts_from_rebound_to_rebound_fades_over_the_same_length(share: float) -> None:
    """In the first rebound all force, then gas again, where the paper has none."""
    p = (
        load("SA7", as_published=True)
        .with_(dead_length=0.13, oil_level=0.35, gas_preload=0, build_up=0.01, carry_turn=share)
        .parameters
    )
    d, s, f = blank(Derived), blank(State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    edge = s.V1_gas / d.A_1
    for i in range(1, 101):
        model.advance(p, d, s, f, (edge + 0.03) * i / 100, 0.04, 0.04, 0.0)
    top, ended = s.z, f.k_degr
    assert ended > 0.9
    for i in range(1, 41):
        model.advance(p, d, s, f, top - 0.001 * i, -0.04, -0.04, 0.0)
    bottom = s.z
    for i in range(1, 11):
        model.advance(p, d, s, f, bottom + 0.001 * i, 0.04, 0.04, 0.0)
        assert s.k_flow == 0.0
        assert f.k_degr == pytest.approx(share * ended * math.exp(-0.1 * i), abs=1e-6)


def test_with_all_that_lasts_each_direction_is_a_filter_of_first_order() -> None:
    """A mixing length, with a memory of each direction: dk/ds = (k_flow - k) / L, whatever makes k_flow change."""
    length = 0.005
    damper = load("SA1", as_published=True).with_(
        oil_level=0.37, gas_preload=0, build_up=length, carry_over=1.0, carry_turn=1.0
    )
    block = harmonic_block(0.524)
    result = simulate(damper, block.stroke, block.velocity, block.time)
    plain = simulate(
        load("SA1", as_published=True).with_(oil_level=0.37, gas_preload=0), block.stroke, block.velocity, block.time
    )
    assert np.ptp(plain.k_degr) > 0.5
    kept = {1.0: 1.0, -1.0: 1.0}
    expected = np.empty(len(block.time))
    for i, (goal, dz) in enumerate(zip(plain.k_degr, np.diff(block.stroke, prepend=block.stroke[0]), strict=True)):
        side = float(np.sign(dz)) or 1.0
        fade = math.exp(-abs(dz) / length)
        mean = goal + (kept[side] - goal) * (1 - fade) * length / abs(dz) if dz else goal
        kept[side] = goal + (kept[side] - goal) * fade
        expected[i] = mean
    settled = slice(len(expected) // 2, None)
    assert np.quantile(np.abs(result.k_degr - expected)[settled], 0.99) < 1e-3


@pytest.mark.parametrize("share", [0.0, 1.0])
def test_a_reversal_between_two_samples_is_like_a_reversal_at_a_sample(share: float) -> None:
    """Whether velocity or stroke changes its sign first is a chance of the sampling."""
    damper = load("SA1", as_published=True).with_(
        oil_level=0.83, gas_preload=0, build_up=0.0045, carry_over=1.0, carry_turn=share
    )
    frequency = 8.34
    time = np.arange(0.0, 40.0 / frequency, 2.5e-4)
    phase = 2 * np.pi * frequency * time
    result = simulate(damper, 0.03 * np.sin(phase), 0.03 * 2 * np.pi * frequency * np.cos(phase), time)
    # 3 % of an oscillation after each reversal into compression, where gas lies ahead.
    after = np.array([np.interp((i + 0.28) / frequency, time, result.k_degr) for i in range(20, 40)])
    assert np.ptp(after) < 0.1
    assert (after.mean() > 0.5) == (share == 1.0)


@pytest.mark.parametrize("share", [0.0, 0.5])
def test_foam_in_front_of_oil_ends_as_gradually_as_gas(share: float) -> None:
    """Before the second end the rise is known from the first, and the share of it comes within two lengths."""
    p = load("SA7", as_published=True).with_(gas_preload=0, build_up=0.005, early_share=share).parameters
    d, s, f = blank(Derived), blank(State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    for first in (True, False):
        s.V1_oil -= 0.02 * d.A_1
        s.V1_foam = 0.02 * d.A_1
        s.V1_foam_oil = 0.5 * s.V1_foam
        begin = s.z
        for i in range(1, 501):
            model.advance(p, d, s, f, begin + 0.05 * i / 500, 0.02, 0.02, 0.0)
            x = s.z - begin - 0.02
            if i == 1:
                foamy = s.k_target
            early = 0.0 if first else share * max(0.0, 1 + x / 0.01) ** 2
            rise = early if x < 1e-9 else 1 - (1 - share) * math.exp(-x / 0.005)
            assert f.k_degr == pytest.approx(foamy + (1 - foamy) * rise, abs=0.02)
        model.advance(p, d, s, f, begin, -0.02, -0.02, 0.0)
        s.z, s.V1_gas, s.V2_gas = begin, 0.0, 0.0


def test_a_layer_of_no_thickness_does_nothing() -> None:
    p = load("SA7", as_published=True).with_(dead_length=0.13, oil_level=0.35, gas_preload=0, build_up=0.01).parameters
    missing = []
    for layer in (1e-7, 1e-5, 1e-2):
        d, s, f = blank(Derived), blank(State), blank(Flow)
        model.set_up(p, d)
        model.start(p, d, s, 0.0)
        s.V1_gas = layer * d.A_1
        model.advance(p, d, s, f, layer / 2, 0.04, 0.04, 0.0)
        model.advance(p, d, s, f, layer * (1 + 1e-6), 0.04, 0.04, 0.0)
        missing.append(1 - f.k_degr)
    assert missing[0] < 1e-3 < missing[1] < 0.02
    assert missing[2] > 0.99
