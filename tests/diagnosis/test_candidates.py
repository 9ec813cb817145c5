"""Which parameters a candidate has in a dataset, and where the search for it begins."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

from tests.diagnosis import small
from twintube.dampers import load
from twintube.data import Record
from twintube.diagnosis.fits.calibration import best_calibration, calibration
from twintube.diagnosis.fits.candidates import (
    Candidate,
    candidates,
    linear,
    nuisances,
    period,
    usual_delay,
)
from twintube.diagnosis.fits.fit import Problem
from twintube.diagnosis.fits.grids import lowest
from twintube.diagnosis.fits.starts import best_start, starts
from twintube.diagnosis.measurement.edges import with_noise
from twintube.diagnosis.measurement.sampling import with_sampling
from twintube.diagnosis.records.seen import DELAY
from twintube.diagnosis.rules import RULES

KELVIN = {"fade_kelvin", "friction_kelvin", "gas_kelvin"}


def named(problem: Problem, name: str) -> Candidate:
    return next(c for c in candidates(problem) if c.name == name)


@pytest.fixture(scope="module")
def good() -> list[Record]:
    return small.records()


def test_heat_acts_by_the_work_and_by_the_temperature_where_it_was_measured(good: list[Record]) -> None:
    names = {f.name for f in named(small.problem(good), "oil_temperature").free}
    assert names.isdisjoint(KELVIN) and "fade_heat" in names
    rising = [replace(r, temperature=22.0 + 20.0 * r.time / r.time[-1]) for r in good]
    names = {f.name for f in named(small.problem(rising), "oil_temperature").free}
    assert names >= KELVIN | {"fade_heat"}, "a thermometer on the tube lags behind the oil that the work warms"
    for each, kelvin in ((0.5, {"fade_kelvin"}), (2.0, KELVIN)):
        apart = [replace(r, start_temperature=22.0 + each * i) for i, r in enumerate(good)]
        names = {f.name for f in named(small.problem(apart), "oil_temperature").free}
        assert names & KELVIN == kelvin and "fade_heat" in names, "where it begins is known, and what its work adds is not"
    even = [replace(r, temperature=np.full(len(r.time), 22.0)) for r in good]
    assert {f.name for f in named(small.problem(even), "oil_temperature").free}.isdisjoint(KELVIN)


def test_what_every_measurement_has_goes_with_the_sampling(good: list[Record]) -> None:
    problem = small.problem(good)
    peak = max(record.peak for record in problem.records)
    assert named(problem, "fluid_lag").least["tau_fluid"] >= max(RULES.small_delay, period(problem))
    assert named(problem, "gas_spring").least["F_surplus"] == pytest.approx(RULES.small_force * peak)
    assert named(problem, "stroke_gain").least["stroke_gain"] == RULES.small_gain
    coarse = small.problem([small.record(small.run(v, turns=20, samples=40)) for v in (0.1, 0.3, 1.0)])
    assert named(coarse, "fluid_lag").least["tau_fluid"] > 2 * named(problem, "fluid_lag").least["tau_fluid"]
    zero, late, *_ = nuisances(coarse)
    assert zero.high == pytest.approx(RULES.small_zero * max(record.peak for record in coarse.records))
    assert late.high == pytest.approx(RULES.open_filtered * period(coarse)), "a filter is not ruled out yet"
    sharp = nuisances(coarse.with_usual({"bend_about": 0.0}))
    assert sharp[1].high == pytest.approx(RULES.open_samples * period(coarse))


def test_a_strength_that_does_not_help_stays_neutral() -> None:
    """Worn in rebound alone: what compression would add only follows the noise."""
    problem = small.problem(small.records(lambda r: r.force - 0.1 * np.where(r.velocity > 0, r.fluid, 0.0)))
    wear = named(problem, "valve_wear")
    cost, point = best_start([problem], wear, [{}])
    assert point["wear_re"] < 0.0 and "wear_co" not in point
    assert cost < 0.6 * float(np.sum(problem.residual({}) ** 2))
    assert "wear_co" not in {f.name for f in wear.joined(point)}
    assert "wear_re" in {f.name for f in wear.joined(point)}
    both = small.problem(small.records(lambda r: r.force - 0.1 * r.fluid))
    assert {"wear_re", "wear_co"} <= set(best_start([both], wear, [{}])[1])


def test_the_fill_of_a_single_state_may_be_wrong() -> None:
    """At 70 % by the records stands a damper with 66 %; the other fill is as stated."""
    runs = [(level, small.run(v, level, slow=2)) for level in (0.56, 0.66) for v in (0.3, 0.6, 1.0)]
    records = [
        replace(small.record(r, seed=i), oil_level=0.70 if level == 0.66 else level) for i, (level, r) in enumerate(runs)
    ]
    problem = small.problem([*small.records(), *records])
    fill = named(problem, "oil_level_error")
    _, point = best_start([problem], fill, [{}])
    assert set(point) == {"fill_of_state_70"}, "a single strength acts"
    free = [replace(f, start=point.get(f.name, f.start)) for f in fill.joined(point)]
    best = problem.fit([*nuisances(problem), *free])
    assert best.values["fill_of_state_70"] == pytest.approx(-0.04, abs=0.002)
    assert float(np.mean(best.misfit)) < 1.5
    shared = small.problem([*small.records(), *(r for r in records if r.oil_level == 0.56)])
    assert [f.name for f in named(shared, "oil_level_error").free] == ["level_error"], "a single degraded state has no other"


@pytest.mark.parametrize("compliance", [4e-7, 1e-6])  # [m/N]
def test_an_effect_that_is_late_is_seen_behind_the_delay_that_stands_in_for_it(compliance: float) -> None:
    """A spring in series: the rig moves by the damper's stroke and its own deflection."""

    def in_series(r: small.Run) -> small.Run:
        stroke = r.stroke + compliance * r.force
        return replace(r, stroke=stroke, velocity=np.gradient(stroke, r.time))

    records = [small.record(in_series(small.run(v, samples=60)), seed=i) for i, v in enumerate((0.3, 0.6, 1.0))]
    problem = with_sampling(with_noise(small.problem(records)))
    assert abs(problem.usual[DELAY]) > 0.1 * usual_delay(problem), "a delay stands in for the spring"
    cost, point = best_start([problem], named(problem, "mount_compliance"), [problem.usual])
    assert 0.1 * compliance < point["C_mount"] < 1.1 * compliance
    assert cost < 0.8 * problem.costs([problem.usual], problem.usual, linear(problem))[0]


def test_a_strength_between_two_values_of_its_grid_is_not_lost() -> None:
    """Both branches lose 1.5 %: of wear the grid has 0.8 and 2.4 %, and a bleed valve would come nearer in one of them."""
    problem = small.problem(small.records(lambda r: r.force - 0.015 * r.fluid))
    wear = named(problem, "valve_wear")
    _, point = best_start([problem], wear, [{}])
    assert set(point) & set(wear.strength) == {"wear_re", "wear_co"}
    assert [point[name] for name in ("wear_re", "wear_co")] == pytest.approx([-0.015, -0.015], rel=0.25)


def test_oil_that_gives_in_both_directions_alike_is_a_start_of_its_own() -> None:
    """Of one direction alone late valves come nearer, beside which its compliance is not found again."""
    stiffness = 4e5  # [N/m] of an element in series with the valves: dF/dt = K (v - u(F))

    def in_series(r: small.Run) -> np.ndarray:
        order = np.argsort(r.velocity)
        force, out, dt = float(r.fluid[0]), np.empty(len(r.fluid)), np.diff(r.time, prepend=r.time[0])
        speeds, curve = r.velocity[order], np.maximum.accumulate(r.fluid[order] + 1e-6 * np.arange(len(order)))
        for i, (v, h) in enumerate(zip(r.velocity, dt, strict=True)):
            goal, gain = force + stiffness * h * v, stiffness * h
            force = float(np.interp(goal, curve + gain * speeds, curve))
            out[i] = force
        return r.force - r.fluid + out

    records = [small.record(r, in_series(r), seed=i) for i, r in enumerate(small.run(v) for v in (0.3, 0.6, 1.0))]
    problem = with_noise(small.problem(records))
    point = starts([problem], named(problem, "fluid_lag"), [{}])[1][0]
    assert point["C_fluid"] == pytest.approx(point["C_fluid_co"]) and point["C_fluid"] == pytest.approx(2.5e-6, rel=0.7)
    assert "tau_fluid" not in point


def test_a_lag_is_seen_where_a_delay_as_long_stands_in_for_it() -> None:
    """Its slope tells nothing of a delay so far off: 4 ms behind a first-order lag, with 2.4 ms to a sample."""

    def late(r: small.Run) -> np.ndarray:
        share = 1.0 - np.exp(-(r.time[1] - r.time[0]) / 0.004)
        return r.force - r.fluid + lfilter([share], [1.0, share - 1.0], r.fluid)

    speeds = (0.15, 0.3, 0.6, 1.0)
    records = [small.record(r, late(r), seed=i) for i, r in enumerate(small.run(v, samples=200) for v in speeds)]
    problem = with_sampling(with_noise(small.problem(records)))
    assert abs(problem.usual[DELAY]) > 0.5 * period(problem), "a delay stands in for the lag"
    cost, point = best_start([problem], named(problem, "fluid_lag"), [problem.usual])
    assert point["tau_fluid"] == pytest.approx(0.004, rel=0.3) and point.get(DELAY, 0.0) == 0.0
    # A filter of the channel, which four samples of an interval leave open, takes some of the lag.
    assert cost < 0.5 * problem.costs([problem.usual], problem.usual, nuisances(problem))[0]


def test_a_second_strength_joins_the_first_at_its_size() -> None:
    """Beside a first strength of a coarse grid a leak of the other branch came nearer than its wear."""
    problem = small.problem(small.records(lambda r: r.force - np.where(r.velocity > 0, 0.15, 0.09) * r.fluid))
    wear = named(problem, "valve_wear")
    _, point = best_start([problem], wear, [{}])
    assert set(point) & set(wear.strength) == {"wear_re", "wear_co"}
    assert [point[name] for name in ("wear_re", "wear_co")] == pytest.approx([-0.15, -0.09], rel=0.15)


def test_the_lowest_of_a_parabola() -> None:
    costs = {x: 3.0 * (x - 0.7) ** 2 + 1.0 for x in (-1.0, 0.0, 0.5, 2.0)}
    assert lowest(costs) == pytest.approx(0.7)
    assert lowest({0.0: 1.0, 1.0: 2.0, 3.0: 5.0}) == 0.0
    assert lowest({0.0: 2.0, 1.0: 1.0, 3.0: 1.0}) == pytest.approx(2.0)


def test_a_calibration_moves_the_parameters_that_help_and_no_others() -> None:
    """Two of fourteen are wrong: the others keep what was given, so that they do not follow the noise."""
    true = load("SA8", as_published=True).with_(X_Re=0.25, B=0.5)
    runs = [small.run(v, level, slow=2, damper=true) for level in (0.7, small.DEGRADED) for v in (0.3, 0.6, 1.0)]
    problem = with_noise(small.problem([small.record(r, seed=i) for i, r in enumerate(runs)]))
    candidate = calibration(problem)
    cost, point = best_start([problem], candidate, [{}])
    assert cost < 0.2 * float(np.sum(problem.residual({}) ** 2))
    assert "X_Re" in point and len(point) <= 5
    assert {f.name for f in candidate.joined(point)} == set(point)
    healthy = with_noise(small.problem([small.record(small.run(v, 0.7, slow=2), seed=9) for v in (0.3, 1.0)]))
    assert len(best_start([healthy], calibration(healthy), [{}])[1]) == 1  # that with which a search begins


def test_degradation_parameters_that_interact_are_sought_together() -> None:
    true = load("SA8", as_published=True).with_(
        X_Re=0.15, X_Co2=0.59, G_PV=0.34, S_BV=0.2, E=11.5, Y_Co_cav=0.16, Y_Re_cav=0.07
    )
    runs = [small.run(v, level, slow=2, damper=true) for level in (0.7, small.DEGRADED) for v in (0.3, 0.6, 1.3)]
    problem = with_noise(small.problem([small.record(r, seed=i) for i, r in enumerate(runs)]))
    candidate = calibration(problem)
    point = best_calibration([problem], candidate, [{}])
    singly = best_start([problem], candidate, [{}])[1]
    left = [float(np.sum(problem.residual(values) ** 2)) for values in ({}, singly, point)]
    assert left[2] < 0.1 * left[0] and left[2] < 0.5 * left[1]
    assert 0 < len(point) < len(candidate.strength), "what hardly helps keeps the given value"


def test_no_candidate_changes_forces_while_its_strength_vanishes() -> None:
    """A step in the strength would be seen as its effect: late valves had taken half a step of time whatever their lag."""
    runs = [small.run(v, level, slow=2) for level in (small.INTACT, small.DEGRADED) for v in (0.15, 1.0)]
    problem = small.problem([small.record(r, seed=i) for i, r in enumerate(runs)])
    given, peak = problem.forces({}), max(record.peak for record in problem.records)
    for candidate in candidates(problem):
        for f in candidate.free:
            if f.name in candidate.strength and f.high > f.start:
                changed = problem.forces({f.name: f.start + 1e-10 * (f.high - f.start)})
                assert np.abs(changed - given)[problem.used].max() < 1e-6 * peak, f.name


@pytest.mark.parametrize("power", [0.0, 0.5, 1.0, 1.5, 2.0])
def test_oil_that_leaked_in_a_record_is_missing_in_those_after_it(power: float) -> None:
    film, damper = 2e-7, load("SA8", as_published=True)
    runs = [small.run(speed, fill) for fill, speed in ((small.INTACT, 0.3), (small.DEGRADED, 0.1), (small.DEGRADED, 0.6))]
    problem = small.problem([small.record(r) for r in runs])
    lost = [film * 0.1 ** (1.0 - power) * float(np.trapezoid(np.abs(r.velocity) ** power, r.time)) for r in runs]
    for carried, same, before in ((0.5, 0.5, 0.0), (1.0, 1.0, 0.0), (1.5, 1.0, 0.5), (2.0, 1.0, 1.0)):
        drained = problem.drained({"leak_film": film, "leak_power": power}, carried)
        missing = (problem.states[:, 0] - drained[:, 0]) * damper.parameters.V_oil
        # The first record has another fill than the two after it.
        assert missing == pytest.approx([0.0, before * lost[0], before * lost[0] + same * lost[1]], rel=0.03)
    leak = named(problem, "seal_leak")
    assert "loss_carried" in leak.laws and "loss_carried" not in leak.strength
    alone = small.problem([small.record(r) for r in runs[:1]])
    assert "loss_carried" not in {f.name for f in named(alone, "seal_leak").free}


def test_oil_that_a_cut_lost_in_a_record_is_missing_in_those_after_it_at_a_usual_force() -> None:
    damper = load("SA8", as_published=True)
    runs = [small.run(speed, fill) for fill, speed in ((small.INTACT, 0.3), (small.DEGRADED, 0.1), (small.DEGRADED, 0.6))]
    problem = small.problem([small.record(r) for r in runs])
    ring = 0.25 * np.pi * (damper.parameters.D_li**2 - damper.parameters.D_PR**2)
    flow = 1e-9 * (2.0 * 1000.0 / (870.0 * ring)) ** 0.5
    missing = (problem.states[:, 0] - problem.drained({"cut_area": 1e-9}, 2.0)[:, 0]) * damper.parameters.V_oil
    lost = [0.5 * flow * float(np.ptp(r.time)) for r in runs]
    assert missing == pytest.approx([0.0, lost[0], lost[0] + lost[1]], rel=0.03)
