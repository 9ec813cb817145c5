"""What the benches say about dampers that have lost oil."""

from dataclasses import replace

import numpy as np
import pytest

from twintube.dampers import ParameterError, load
from twintube.dampers.variants import scalar_factor
from twintube.engine.simulate import InputError
from twintube.inspection import INTACT, METHODS, USUAL, Condition, Plate, Setting, conditions, inspected, method, read
from twintube.inspection.corner import LEAST_FACTOR
from twintube.inspection.figures import WINDOWS, phase_shift
from twintube.inspection.methods import eusama_class
from twintube.inspection.plate import Cycles
from twintube.vehicle.cars import load_car
from twintube.vehicle.drive import drive

NAMES = USUAL


def figures(damper: str, state: Condition, setting: Setting | None = None, dt: float = 1e-3) -> dict[str, float]:
    loaded = load(damper)
    return read(state.applied(loaded), load_car().corner(loaded), NAMES, setting or Setting(), dt=dt)


@pytest.mark.parametrize("damper", ["SA1", "SA8"])
def test_every_usual_method_finds_a_damper_with_30_percent_oil_worse_than_the_intact_one(damper):
    intact, worn = figures(damper, INTACT), figures(damper, Condition(0.3, 0))
    for name in NAMES:
        how = METHODS[name]
        assert (worn[name] < intact[name]) == how.low_fails, name
    assert worn["eusama"] < 5.0


def test_the_intact_dampers_pass_and_those_with_30_percent_oil_fail():
    for damper in ("SA1", "SA8"):
        entries = inspected(load(damper), load_car(), conditions((1.0, 0.3), gas_preload=0.0))
        assert all(entry.passed == (entry.condition.oil_level == 1.0) for entry in entries), damper


@pytest.mark.parametrize("damper", ["SA1", "SA8"])
def test_a_scalar_factor_overestimates_what_inspection_sees_of_a_moderate_loss(damper):
    """The paper's conclusion: on the benches the damper moves slowly, and 60 % of the oil fill both chambers."""
    intact, model, scalar = (figures(damper, state) for state in (INTACT, Condition(0.6, 0), Condition(0.6, 0, scalar=True)))
    for name in ("eusama", "damping_ratio", "push_down"):
        assert model[name] == pytest.approx(intact[name], rel=0.1), name
        assert scalar[name] < 0.9 * intact[name], name


@pytest.mark.parametrize("level", [1.0, 0.4])
def test_halving_the_step_changes_the_figures_by_less_than_two_percent(level):
    state = Condition(level, int(level == 1.0))
    coarse, fine = (figures("SA8", state, dt=dt) for dt in (1e-3, 5e-4))
    # The phase of a wheel that leaves the plate is not a smooth function of anything.
    for name in NAMES if level == 1.0 else ("eusama", "damping_ratio", "push_down"):
        assert coarse[name] == pytest.approx(fine[name], rel=0.02, abs=0.05), name


def test_a_softer_tyre_and_a_smaller_amplitude_give_more_adhesion():
    loaded = load("SA8")

    def adhesion(setting: Setting, share: float) -> float:
        nominal = load_car().corner(loaded)
        return read(loaded, load_car().corner(loaded, c_tyre=share * nominal.c_tyre), ("eusama",), setting)["eusama"]

    small = Setting(replace(Plate(), amplitude=2.5e-3))
    assert adhesion(Setting(), 0.7) > adhesion(Setting(), 1.0) > adhesion(Setting(), 1.3)
    assert adhesion(small, 1.0) > adhesion(Setting(), 1.0)


def test_the_window_of_the_phase_shift_matters_more_than_the_loss_of_40_percent_of_the_oil():
    intact, worn = inspected(load("SA8"), load_car(), conditions((1.0, 0.6), gas_preload=0.0), ("phase_shift",))
    assert set(intact.windows) == set(WINDOWS)
    assert intact.figure == intact.windows["2 Hz to the wheel"]
    change = abs(intact.figure - worn.figure)
    assert max(intact.windows.values()) - min(intact.windows.values()) > 10 * change


def test_the_scalar_factor_of_the_full_oil_level_is_the_intact_damper():
    full, worn = inspected(load("SA8"), load_car(), [INTACT, Condition(0.1, 0)], ("eusama",))
    assert full.scalar_figure == full.figure
    assert worn.scalar_figure is None, "the valves' wear has its bound at 0.2"
    assert worn.as_json["scalar_factor"] is None
    load("SA8").with_(**scalar_factor(LEAST_FACTOR))
    with pytest.raises(ParameterError, match="wear_re"):
        load("SA8").with_(**scalar_factor(LEAST_FACTOR - 0.01))


def test_a_window_without_a_cycle_takes_the_next_one():
    turned = np.exp(1j * np.radians([10.0, 50.0, 70.0]))
    fast = Cycles(np.array([20.0, 10.0, 4.0]), turned * [3, 2, 1])
    assert fast.wheel_frequency == 20.0
    assert phase_shift(fast, "2 Hz to the wheel") == pytest.approx(10.0)
    slow = Cycles(fast.frequency, turned * [1, 2, 3])
    assert slow.wheel_frequency == 4.0
    assert phase_shift(slow, "5 Hz to the wheel") == pytest.approx(70.0)


def test_preload_is_lost_below_full_oil_unless_said_otherwise():
    assert [s.gas_preload for s in conditions((1.0, 0.9), gas_preload=0.0)] == [1, 0]
    assert [s.gas_preload for s in conditions((1.0, 0.9), gas_preload=1.0)] == [1, 1]


def test_noise_only_adds_noise():
    loaded, setting = load("SA8"), Setting(force_noise=5.0, height_noise=1e-4, acceleration_noise=0.05)
    exact = read(loaded, load_car().corner(loaded), NAMES, Setting())
    noisy = read(loaded, load_car().corner(loaded), NAMES, setting, noise=1)
    for name in NAMES:
        assert noisy[name] != exact[name]
        assert noisy[name] == pytest.approx(exact[name], rel=0.05)


def test_limits_and_classes():
    assert METHODS["eusama"].passed(40.0) and not METHODS["eusama"].passed(39.9)
    assert METHODS["bump"].passed(2.0) and not METHODS["bump"].passed(2.1)
    assert [eusama_class(x) for x in (0.0, 20.0, 20.1, 40.1, 60.1)] == ["poor", "poor", "weak", "fair", "good"]


def test_a_piston_that_leaves_its_tube_is_named_with_stroke_and_range():
    damper = load("SA8")
    car = load_car().corner(damper, c_stop=0.0)
    with pytest.raises(
        InputError, match=r"^SA8, time [\d.]+ s: stroke = -0\.12\d* m: must be from -0\.125499 to 0\.125499 m$"
    ):
        drive(damper, car, np.linspace(0.0, 1.0, 100), 1e-3)


def test_bad_input_names_quantity_value_and_range():
    with pytest.raises(InputError, match=r"^plate.amplitude = 0.1 m: must be a number from 0.0001 to 0.02 m$"):
        Plate(amplitude=0.1)
    with pytest.raises(ParameterError, match=r"^method shaking: must be one of eusama, phase_shift, damping_ratio"):
        method("shaking")
