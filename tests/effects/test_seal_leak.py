"""Oil lost past the seal."""

import numpy as np
import pytest

from twintube.core import model
from twintube.core.effects import State, seal_leak
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import Damper, load
from twintube.engine.simulate import simulate
from twintube.rig.signals import harmonic_block


def test_the_film_leaves_from_the_reserve_first() -> None:
    p = load("SA8", as_published=True).with_(leak_film=1e-5).parameters
    d, s, f = blank(Derived), blank(State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    reserve = s.V3_oil
    way = 0.0
    while s.V_lost < 0.9 * reserve:
        for z in (0.04, 0.0):
            model.advance(p, d, s, f, z, 0.0, 0.0, 0.0)
            way += 0.04
    assert s.V_lost == pytest.approx(1e-5 * way, rel=1e-12)
    assert s.k_flow == 1.0  # as long as the reserve lasts the force does
    for _ in range(400):
        for z in (0.04, 0.0):
            model.advance(p, d, s, f, z, 0.1, 0.1, 0.0)
    assert s.V1_gas > 0.0
    assert s.V_lost <= p.V_oil * (1 + 1e-12)


def test_a_film_may_end_with_the_reserve() -> None:
    """The reserve is lost whole, of the rest the share. Oil that the chambers give it again for gas is lost, too."""
    lost = []
    for share in (0.0, 0.5, 1.0):
        p = load("SA8", as_published=True).with_(leak_film=1e-5, leak_beyond=share, oil_level=0.6, gas_preload=0).parameters
        d, s, f = blank(Derived), blank(State), blank(Flow)
        model.set_up(p, d)
        model.start(p, d, s, 0.0)
        reserve, way = s.V3_oil, 0.0
        while 1e-5 * way < 2.0 * reserve:
            for z, v in ((0.001, 0.1), (0.0, -0.1)):
                model.advance(p, d, s, f, z, v, v, 0.01)
                way += 0.001
        lost.append(s.V_lost)
        estimate = seal_leak.seal_leak_lost(p, 0.6, 0.0, way / 0.1, way, 0.1 * way)
        assert estimate == pytest.approx(reserve + share * (1e-5 * way - reserve), rel=1e-9)
        assert estimate == pytest.approx(s.V_lost, rel=0.3)
    assert reserve < lost[0] < lost[1] < lost[2]
    assert lost[2] == pytest.approx(1e-5 * way, rel=1e-9)


def test_force_falls_over_the_measurement(sa8: Damper) -> None:
    block = harmonic_block(0.524)
    result = simulate(sa8.with_(leak_film=1e-5), block.stroke, block.velocity, block.time)
    works = np.diff(result.work[block.marks])
    assert works[-1] < 0.8 * works[0]


@pytest.mark.parametrize("power", [0.0, 0.5, 1.0, 2.0])
def test_the_loss_per_time_goes_with_a_power_of_the_speed(power: float) -> None:
    p = load("SA8", as_published=True).with_(leak_film=1e-6, leak_power=power).parameters
    lost = []
    for speed in (0.1, 0.4):
        d, s, f = blank(Derived), blank(State), blank(Flow)
        model.set_up(p, d)
        model.start(p, d, s, 0.0)
        for i in range(1, 51):
            model.advance(p, d, s, f, speed * 1e-3 * i, speed, speed, 1e-3)
        lost.append(s.V_lost)
    assert lost[0] == pytest.approx(1e-6 * 0.005, rel=1e-9)
    assert lost[1] / lost[0] == pytest.approx(4.0**power, rel=1e-9)


def test_pressure_drives_oil_past_a_cut_in_rebound_and_air_comes_in_for_it() -> None:
    air = {}
    for cut in (0.0, 1e-8):
        p = load("SA8", as_published=True).with_(cut_area=cut).parameters
        d, s, f = blank(Derived), blank(State), blank(Flow)
        model.set_up(p, d)
        model.start(p, d, s, -0.03)
        expected = 0.0
        for i in range(1, 41):
            expected += cut * (2.0 * max(0.0, s.F_fluid) / (870.0 * d.A_1)) ** 0.5 * 1e-3
            model.advance(p, d, s, f, -0.03 + 2e-4 * i, 0.2, 0.2, 1e-3)
        air[cut] = s.V1_gas + s.V2_gas - s.V3_oil, s.V_lost
        assert s.V_lost == pytest.approx(expected, rel=1e-9)
    assert air[1e-8][0] - air[0.0][0] == pytest.approx(s.V_lost, rel=1e-9), "or what the reserve made up for"
    for i in range(1, 41):
        model.advance(p, d, s, f, -0.022 - 2e-4 * i, -0.2, -0.2, 1e-3)
    assert s.V_lost == pytest.approx(air[1e-8][1], rel=0.05), "nothing under the pressure of compression"


def test_a_cut_takes_its_share_of_the_force_whatever_the_step(sa8: Damper) -> None:
    block = harmonic_block(0.131)
    works = []
    for step in (1, 4):
        z, v, t = (a[::step] for a in (block.stroke, block.velocity, block.time))
        whole, less = (simulate(sa8.with_(oil_level=1.0, gas_preload=1, cut_area=cut), z, v, t) for cut in (0.0, 2e-8))
        works.append(less.work[-1] / whole.work[-1])
    assert works[0] == pytest.approx(works[1], abs=1e-5) and works[0] < 0.99
