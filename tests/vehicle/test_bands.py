"""What the wheel load is varied over: the dead length over its bounds, the rear curve at the rear, both together with others."""

import pytest

from twintube.dampers import load
from twintube.dampers.dead_length import bounds, collapse_level
from twintube.dampers.freed_gas import P_GAS, P_GASES, acting, condition
from twintube.dampers.temperature import at_temperature
from twintube.dampers.variants import REAR_COMPRESSION, REAR_REBOUND, rear_curve
from twintube.demo.bands import Rides, Setting, assumptions, changed, dead_length, everything, limited, rises
from twintube.demo.sensitivity import combinations, mild
from twintube.vehicle.cars import load_car

LOW, HIGH = 0.3, 0.55


@pytest.fixture(scope="module")
def rides() -> Rides:
    return Rides(load("SA8"), load_car(), 20.0, 1e-3)


@pytest.mark.parametrize("name", ["SA2", "SA5", "SA8"])
def test_the_dead_length_is_varied_over_its_bounds(name: str) -> None:
    damper = load(name)
    ends = next(pair for key, pair in assumptions(damper, load_car()).items() if key.startswith("dead length"))
    lengths = tuple(changed(damper, end).parameters.dead_length for end in ends)
    assert lengths == bounds(damper)


def test_the_friction_of_the_suspension_is_varied_from_none_on(rides: Rides) -> None:
    """It hides wear: the more of it, the less the wheel load rises."""
    none, most = assumptions(rides.damper, rides.car)["friction of the suspension, 0 to 150 N"]
    assert {none, most} <= set(everything(rides))
    rides.drive_all([30.0, 50.0], (LOW,), [none, Setting(), most], "test")
    for speed in (30.0, 50.0):
        rise = [rises(rides, speed, LOW, [setting])[0] for setting in (none, Setting(), most)]
        assert rise == sorted(rise, reverse=True)


def test_a_kept_preload_and_a_temperature_reach_the_ride(rides: Rides) -> None:
    kept, cold = Setting(gas=1.0), Setting(temperature=253.15)
    rides.drive_all([50.0], (0.8,), [kept, cold, Setting()], "test")
    full, none = rises(rides, 50.0, 0.8, [kept, Setting()])
    assert abs(full - 1.0) < 0.1 * (none - 1.0)
    itself = Rides(at_temperature(rides.damper, 253.15), rides.car, rides.seconds, rides.dt)
    itself.drive_all([50.0], (0.8,), [Setting()], "test")
    for level in (None, 0.8):
        assert rides.get(50.0, level, cold, "dlc") == itself.get(50.0, level, Setting(), "dlc")


def test_what_matters_most_is_varied_together(rides: Rides) -> None:
    longest = dead_length(bounds(rides.damper)[1]).damper
    assert Setting("pushes_oil", car=(("d_links", 450.0),), damper=longest) in everything(rides)
    assert all(set(several) <= set(everything(rides)) for several in combinations(rides).values())


@pytest.mark.parametrize("pressure", P_GASES)
def test_the_limit_of_freed_gas_is_varied_with_its_pressure(rides: Rides, pressure: float) -> None:
    """At 0.3 bar it is the way `limited`; the more pressure, the less gas the oil gives."""
    setting = limited(pressure)
    assert setting in everything(rides)
    way = condition(rides.damper.with_(exhaustion=0.0), 0.6, 0, "limited").parameters.exhaustion
    varied = condition(changed(rides.damper, setting), 0.6, 0, setting.freed_gas)
    assert varied.parameters.exhaustion == pytest.approx(way * pressure / P_GAS)
    assert acting(varied).startswith("limited" if pressure == P_GAS else "its own")


def test_only_a_rear_damper_gets_the_rear_curve() -> None:
    assert rear_curve(load("SA7")) == {}
    rear = load("SA8").with_(**rear_curve(load("SA8"))).parameters
    ratio = REAR_COMPRESSION[-1][1] / REAR_REBOUND[-1][1]
    assert ratio == pytest.approx(0.66, abs=0.005)
    assert rear.F_co[5] / rear.F_re[5] == pytest.approx(ratio) and rear.v_re[5] == 0.832
    assert changed(load("SA8"), Setting(forces=2.0, damper=tuple(rear_curve(load("SA8")).items()))).parameters.F_re[
        5
    ] == pytest.approx(2.0 * REAR_REBOUND[-1][1])


def test_a_longer_dead_length_and_pushed_oil_are_milder_below_the_level_of_collapse(rides: Rides) -> None:
    """Between the levels of both lengths the long one still has its force; below both none has."""
    longest = dead_length(bounds(rides.damper)[1])
    gentle = Setting("pushes_oil", damper=longest.damper)
    assert collapse_level(changed(rides.damper, longest)) < HIGH < collapse_level(rides.damper)
    rides.drive_all([30.0], (LOW, HIGH), [Setting(), gentle], "test")
    assert rises(rides, 30.0, HIGH, [gentle])[0] < 1.05
    assert rises(rides, 30.0, HIGH, [Setting()])[0] > 1.3
    assert min(rises(rides, 30.0, LOW, [Setting(), gentle])) > 1.3


def test_the_mild_ends_are_the_milder_ones(rides: Rides) -> None:
    ends = [end for pair in assumptions(rides.damper, rides.car).values() for end in pair]
    rides.drive_all((30.0, 50.0), (0.4,), ends, "test")
    setting = mild(rides)
    assert setting.freed_gas == "pushes_oil" and dict(setting.car)["d_links"] == 450.0
    assert dict(setting.damper)["dead_length"] == bounds(rides.damper)[1]
