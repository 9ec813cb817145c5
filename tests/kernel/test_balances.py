"""Whatever the strokes, parameters and steps: nothing is lost, chambers are full, no phase is negative."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.eight import EIGHT
from twintube.core import model
from twintube.core.checks import stroke_limit
from twintube.core.effects import Parameters, State
from twintube.core.kernel import fill, prepare, step
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import load, names

UNIT = st.floats(0, 1)
SHARES = ("X_Re", "L_PV", "G_PV", "X_Co1", "X_Co2", "S_BV", "S_BVoil", "S_PV", "S_PVoil", "B", "Y_Co_cav", "Y_Re_cav")


@st.composite
def dampers(draw: st.DrawFn, cavitating: bool) -> Parameters:
    p = load(draw(st.sampled_from(names()))).parameters
    # Exact zeros and ones are the corner cases of the flow equations.
    shares = {name: draw(st.one_of(UNIT, st.sampled_from([0.0, 1.0]))) for name in SHARES}
    if not cavitating:
        shares |= {"Y_Co_cav": 0.0, "Y_Re_cav": 0.0}
    readings = {
        name: draw(st.integers(0, 1))
        for name in ("leak_carries_oil", "foam_leaves_with_gas", "foam_decays", "cavitation_foams", "venting")
    }
    return replace(
        p,
        **shares,
        **readings,
        E=draw(st.floats(0, 100)),
        v_cav=draw(st.floats(0, 1.5)),
        oil_level=draw(st.one_of(UNIT, st.sampled_from([0.0, 0.4, 0.999]))),
        gas_preload=draw(st.one_of(UNIT, st.sampled_from([0.0, 1.0]))),
        cavitation_loss=draw(st.one_of(UNIT, st.sampled_from([0.0, 0.1]))),
        foot_valve=draw(st.sampled_from([0.0, 0.1, 1.0])),
    )


@st.composite
def motions(draw: st.DrawFn) -> list[tuple[float, float, float]]:
    """(share of the stroke limit, velocity at start, velocity at end), long oscillations and erratic jumps."""
    if draw(st.booleans()):
        steps = draw(st.integers(4, 60))
        speed = draw(st.floats(0.01, 3.0))
        size = draw(st.floats(0.1, 1.0))
        phase = [2 * math.pi * i / steps for i in range(draw(st.integers(20, 300)))]
        return [(size * math.sin(x), speed * math.cos(x), speed * math.cos(x)) for x in phase]
    jump = st.tuples(st.floats(-1, 1), st.floats(-3, 3), st.floats(-3, 3))
    return draw(st.lists(jump, min_size=1, max_size=80))


def oil_of(s: State) -> float:
    return s.V1_oil + s.V2_oil + s.V3_oil + s.V1_foam_oil + s.V2_foam_oil + s.V3_foam_oil


PHASES = ("V1_oil", "V1_gas", "V1_foam", "V1_foam_oil", "V1_void", "V2_oil", "V2_gas", "V2_foam", "V2_foam_oil", "V3_oil", "V3_foam",
          "V3_foam_oil", "V_cav")  # fmt: skip


def run_checked(
    p: Parameters, motion: list[tuple[float, float, float]], displaced: float = 0.0
) -> tuple[list[float], State]:
    d, s, f = blank(Derived), blank(State), blank(Flow)
    p = replace(p, displaced_share=displaced)  # the one effect that changes flows; the kernel's own without it
    model.set_up(p, d)
    limit = stroke_limit(d)
    model.start(p, d, s, motion[0][0] * limit)
    start = oil_of(s)
    totals = [start]
    for share, v0, v1 in motion:
        z = share * limit
        assert model.advance(p, d, s, f, z, v0, v1, 0.0), "the step was not finished"
        z = s.z  # of a jump against the velocity, less than the play
        V1, V2 = d.A_1 * (d.half_length - z), d.A_2 * (d.half_length + z)
        full = 2 * d.A_2 * d.half_length
        assert abs(s.V1_oil + s.V1_gas + s.V1_foam + s.V1_void - V1) <= 1e-12 * full
        assert abs(s.V2_oil + s.V2_gas + s.V2_foam - V2) <= 1e-12 * full
        # Foam gives way where the reserve is full; its oil stays, as the model has no limit there.
        assert s.V3_oil + s.V3_foam <= max(d.V_reserve, s.V3_oil + s.V3_foam_oil) + 1e-12 * full
        for name in PHASES:
            assert getattr(s, name) >= 0.0, name
        for chamber in ("V1", "V2", "V3"):
            assert getattr(s, f"{chamber}_foam_oil") <= getattr(s, f"{chamber}_foam") * (1 + 1e-9) + 1e-18
        assert 0.0 <= s.k_degr <= 1.0 + 1e-12
        assert math.isfinite(s.F_fluid + s.F_friction + s.F_gas + s.work)
        totals.append(oil_of(s))
    return totals, s


@given(dampers(cavitating=False), motions())
@settings(deadline=None)
def test_oil_is_conserved_without_cavitation(p: Parameters, motion: list[tuple[float, float, float]]) -> None:
    totals, s = run_checked(p, motion)
    assert s.V_cav == 0.0
    assert max(abs(t - totals[0]) for t in totals) <= 1e-12 * p.V_oil


@given(dampers(cavitating=True), motions())
@settings(deadline=None)
def test_oil_falls_by_cavitation_alone(p: Parameters, motion: list[tuple[float, float, float]]) -> None:
    totals, s = run_checked(p, motion)
    assert abs(totals[0] - totals[-1] - s.V_cav) <= 1e-12 * p.V_oil
    assert all(after <= before + 1e-12 * p.V_oil for before, after in zip(totals, totals[1:], strict=False))


@pytest.mark.parametrize("name", EIGHT)
def test_a_sliding_flow_with_a_trace_of_foaming_ends(name: str) -> None:
    # V1 slides along "no gas": what it keeps is zero up to rounding, of either sign, and the foam takes a share of that.
    for sixty_fourths in range(1, 65):
        p = replace(load(name, as_published=True).parameters, oil_level=1.0, gas_preload=0, X_Re=0.0, S_BV=0.0, S_BVoil=0.0, S_PV=1e-108,
                    S_PVoil=0.0, B=0.0, E=0.0, v_cav=0.0, L_PV=0.0, G_PV=0.0, X_Co1=0.0, X_Co2=0.0, Y_Re_cav=0.0,
                    Y_Co_cav=sixty_fourths / 64, cavitation_foams=1, cavitation_loss=0.0)  # fmt: skip
        run_checked(p, [(0.0, 1.0, 1.0), (1.0, 0.0, 0.0), (0.0, -1.0, -1.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 1.0)])


@given(dampers(cavitating=True), motions(), st.one_of(UNIT, st.just(1.0)))
@settings(deadline=None)
def test_displaced_oil_stays_in_the_damper(
    p: Parameters, motion: list[tuple[float, float, float]], displaced: float
) -> None:
    totals, s = run_checked(p, motion, displaced)
    assert abs(totals[0] - totals[-1] - s.V_cav) <= 1e-12 * p.V_oil
    if displaced == 1.0:
        assert s.V_cav == 0.0


@given(dampers(cavitating=True), motions())
@settings(deadline=None)
def test_work_never_comes_back_from_the_fluid(p: Parameters, motion: list[tuple[float, float, float]]) -> None:
    p = replace(p, F_FrS=0.0)
    d, s, f = blank(Derived), blank(State), blank(Flow)
    prepare(p, d)
    limit = stroke_limit(d)
    fill(p, d, s, motion[0][0] * limit)
    before = 0.0
    for share, v, _ in motion:
        z = share * limit
        speed = math.copysign(v, z - s.z)  # stroke and velocity of one sign, as in every real record
        step(p, d, s, f, z, speed, speed)
        assert s.work >= before
        before = s.work
