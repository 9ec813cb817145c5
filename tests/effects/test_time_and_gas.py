"""Foam and freed gas over time: exponential, complete after a long rest."""

import math

import pytest

from twintube.core import model
from twintube.core.effects import State
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import Damper
from twintube.rig.signals import oscillations


def foamed(damper: Damper) -> tuple[object, ...]:
    """The records after three fast oscillations without time."""
    p, d, s, f = damper.parameters, blank(Derived), blank(State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    _, z, v = oscillations(1.5, 0.045, 3, 1e-3)
    for i in range(1, len(z)):
        model.advance(p, d, s, f, float(z[i]), float(v[i - 1]), float(v[i]), 0.0)
    return p, d, s, f


def oil_of(s: State) -> float:
    return s.V1_oil + s.V2_oil + s.V3_oil + s.V1_foam_oil + s.V2_foam_oil + s.V3_foam_oil


def test_foam_decays_at_rest_by_its_rate(sa8: Damper) -> None:
    p, d, s, f = foamed(sa8.with_(foam_decay_rate=0.1, oil_level=0.4))
    foam = s.V1_foam + s.V2_foam + s.V3_foam
    oil = oil_of(s)
    assert foam > 1e-6
    for _ in range(4):
        model.advance(p, d, s, f, s.z, 0.0, 0.0, 5.0)
    assert s.V1_foam + s.V2_foam + s.V3_foam == pytest.approx(foam * math.exp(-2.0), rel=1e-9)
    assert oil_of(s) == pytest.approx(oil, rel=1e-12)
    model.advance(p, d, s, f, s.z, 0.0, 0.0, 1e4)
    model.advance(p, d, s, f, s.z, 0.0, 0.0, 1.0)
    assert s.V1_foam == s.V2_foam == s.V3_foam == 0.0
    assert oil_of(s) == pytest.approx(oil, rel=1e-12)


def test_a_front_goes_through_the_foam_at_a_speed_of_its_own(sa8: Damper) -> None:
    """With order 0 the volume falls evenly, by the rate times 10 mL per second, whatever is left."""
    p, d, s, f = foamed(sa8.with_(foam_decay_rate=0.02, foam_order=0.0, oil_level=0.4))
    foam, oil = s.V1_foam + s.V2_foam + s.V3_foam, oil_of(s)
    seconds = 0.5 * foam / 0.02e-5
    for i in range(1, 1001):
        model.advance(p, d, s, f, s.z, 0.0, 0.0, seconds / 1000)
        if i % 250 == 0:
            left = s.V1_foam + s.V2_foam + s.V3_foam
            assert left == pytest.approx(foam - 0.02e-5 * seconds * i / 1000, rel=1e-3)
    assert oil_of(s) == pytest.approx(oil, rel=1e-12)


def test_dry_foam_lasts_longer_than_its_oil_drains(sa8: Damper) -> None:
    p, d, s, f = foamed(sa8.with_(foam_decay_rate=0.1, dry_share=0.2, oil_level=0.4))
    wet, foam = s.V1_foam_oil + s.V2_foam_oil + s.V3_foam_oil, s.V1_foam + s.V2_foam + s.V3_foam
    oil = oil_of(s)
    for _ in range(4):
        model.advance(p, d, s, f, s.z, 0.0, 0.0, 5.0)
    left = s.V1_foam_oil + s.V2_foam_oil + s.V3_foam_oil
    assert left == pytest.approx(wet * math.exp(-2.0), rel=1e-9)
    assert s.V1_foam + s.V2_foam + s.V3_foam - left == pytest.approx((foam - wet) * math.exp(-0.4), rel=1e-9)
    assert oil_of(s) == pytest.approx(oil, rel=1e-12)


def test_freed_gas_dissolves_at_rest_by_its_rate(sa8: Damper) -> None:
    p, d, s, f = foamed(sa8.with_(redissolution_rate=0.1))
    freed, oil = s.V_cav, oil_of(s)
    assert freed > 1e-6
    model.advance(p, d, s, f, s.z, 0.0, 0.0, 20.0)
    assert s.V_cav == pytest.approx(freed * math.exp(-2.0), rel=1e-9)
    assert oil_of(s) + s.V_cav == pytest.approx(oil + freed, rel=1e-12)
    model.advance(p, d, s, f, s.z, 0.0, 0.0, 1e4)
    assert oil_of(s) == pytest.approx(0.6 * p.V_oil, rel=1e-12)


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_gas_dissolves_by_the_pressure_where_henrys_law_holds(sa8: Damper, share: float) -> None:
    """The rate at 1000 N goes with the fluid force of the last step; at rest the share of it ends."""
    p, d, s, f = foamed(sa8.with_(redissolution_rate=0.1, pressed_share=share))
    freed = s.V_cav
    s.F_fluid = -500.0
    model.advance(p, d, s, f, s.z, 0.0, 0.0, 1.0)
    assert s.V_cav == pytest.approx(freed * math.exp(-0.1 * (1.0 - 0.5 * share)), rel=1e-9)
    freed = s.V_cav
    model.advance(p, d, s, f, s.z, 0.0, 0.0, 1.0)
    assert s.V_cav == pytest.approx(freed * math.exp(-0.1 * (1.0 - share)), rel=1e-9)


def test_gas_that_dissolves_in_the_reserve_leaves_that_of_the_chambers(sa8: Damper) -> None:
    p, d, s, f = foamed(sa8.with_(redissolution_rate=0.1, reserve_share=1.0))
    freed, oil, inside, reserve = s.V_cav, oil_of(s), s.V1_gas + s.V2_gas, s.V3_oil
    model.advance(p, d, s, f, s.z, 0.0, 0.0, 20.0)
    back = freed * (1.0 - math.exp(-2.0))
    assert s.V3_oil == pytest.approx(reserve + back, rel=1e-9)
    assert s.V1_gas + s.V2_gas == pytest.approx(inside, abs=1e-12)
    assert oil_of(s) + s.V_cav == pytest.approx(oil + freed, rel=1e-12)
