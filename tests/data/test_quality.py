"""What recorders do to a force is named with file and place, and its samples are not usable; sound data raise no alarm."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tests.data.conftest import RECORD, good
from twintube.common.arrays import Array
from twintube.data import Record, load_dataset
from twintube.data.check.defects import clipped, dropped, frozen, resolution, unprepared

Make = Callable[..., Path]
F = "force [N]"


def motion(rate: float = 1000.0, frequency: float = 2.0, seconds: float = 10.0) -> tuple[Array, Array, Array]:
    """Time [s], stroke [m] and velocity [m/s] of a sine of 30 mm."""
    t = np.arange(0.0, seconds, 1 / rate)
    w = 2 * np.pi * frequency
    return t, 0.03 * np.sin(w * t), 0.03 * w * np.cos(w * t)


def damper_force(velocity: Array, noise: float, seed: int = 1) -> Array:
    """A digressive curve with friction, other in rebound than in compression [N], with white noise."""
    force = np.where(velocity > 0, 1800, 700) * np.tanh(velocity / 0.15) + 40 * np.tanh(velocity / 0.005)
    return force + np.random.default_rng(seed).normal(0, noise, len(velocity))


def finding(folder: Make, force: Array) -> tuple[Record, list[str]]:
    record = load_dataset(folder({"a.csv": good() | {F: force}}))
    return record.records[0], [str(f) for f in record.findings if f.severity == "warning"]


@pytest.mark.parametrize("step", [0.0, 0.5, 5.0])
def test_a_force_cut_at_a_limit_is_clipped(step: float) -> None:
    _, _, v = motion()
    force = damper_force(v, 5.0)
    if step:
        force = step * np.round(force / step)
    cut = np.clip(force, -600.0, 1500.0)
    result = clipped(cut, np.abs(v))
    assert (result.low, result.high) == (-600.0, 1500.0)
    assert np.array_equal(result.samples, (cut == -600.0) | (cut == 1500.0))


@pytest.mark.parametrize("step", [0.0, 1.0, 10.0])
@pytest.mark.parametrize("noise", [0.0, 1.0, 10.0])
@pytest.mark.parametrize(("rate", "frequency"), [(1000.0, 0.1), (1000.0, 2.0), (200.0, 5.0)])
def test_a_whole_force_is_not_clipped_dropped_or_frozen(step: float, noise: float, rate: float, frequency: float) -> None:
    _, z, v = motion(rate, frequency)
    force = damper_force(v, noise)
    if step:
        force = step * np.round(force / step)
    result = clipped(force, np.abs(v))
    assert (result.low, result.high) == (None, None)
    assert not dropped(force, z).any()
    assert not frozen(force, z).any()


def test_friction_alone_is_not_clipped() -> None:
    _, _, v = motion(frequency=0.1)
    assert clipped(30.0 * np.sign(v), np.abs(v)).high is None


def test_spikes_and_zeros_are_dropouts() -> None:
    _, z, v = motion()
    force = damper_force(v, 5.0)
    broken = force.copy()
    broken[3000] = 0.0  # in full rebound
    broken[5010] = -9999.0
    broken[7000:7012] = 0.0
    assert np.flatnonzero(dropped(broken, z)).tolist() == [3000, 5010, *range(7000, 7012)]


def test_a_peak_in_every_cycle_is_no_dropout() -> None:
    _, z, v = motion(200.0)
    force = damper_force(v, 5.0)
    force[12::100] += 900.0  # a valve's jump, narrower than two samples
    assert not dropped(force, z).any()


def test_a_force_that_stands_still_is_frozen() -> None:
    _, z, v = motion()
    force = damper_force(v, 5.0)
    force[4100:4140] = force[4100]
    assert np.flatnonzero(frozen(force, z)).tolist() == [*range(4101, 4140)]
    rest = np.full(2000, 0.01)
    assert not frozen(np.append(force[:4000], np.full(2000, force[4000])), np.append(z[:4000], rest)).any()


def test_levels_are_counted_where_there_are_any() -> None:
    _, _, v = motion()
    force = damper_force(v, 1.0)
    assert resolution(force) is None
    levels = resolution(25.0 * np.round(force / 25.0))
    assert levels is not None
    step, number, _ = levels
    assert step == pytest.approx(25.0)
    assert number == pytest.approx(np.ptp(force) / 25.0, abs=2)


def test_slow_oscillations_before_a_block_prepare_it() -> None:
    t, z, _ = motion()
    slow = np.arange(0.0, 40.0, 1e-3)
    before = 0.03 * np.sin(2 * np.pi * 0.1 * slow)
    assert unprepared(t, z)
    assert not unprepared(np.append(slow, 40.0 + t), np.append(before, z))


def test_check_names_them_and_leaves_the_samples_out(folder: Make) -> None:
    force = np.array(good()[F])
    high = 0.8 * float(force.max())
    force = np.minimum(force, high)
    force[300] = 0.0
    record, messages = finding(folder, force)
    out = force == np.float64(f"{high:.7g}")
    assert any(f"clipped: the force stays at its largest value {high:.6g} N" in message for message in messages)
    assert "warning: a.csv: row 302, column 'force [N]': dropout: the force jumps to 0 N and back; left out" in messages
    np.testing.assert_array_equal(~record.usable, (force == high) | (np.arange(1501) == 300) | out)
    assert not record.usable.flags.writeable


def test_coarse_levels_are_said_unless_noise_fills_them_in(folder: Make) -> None:
    _, messages = finding(folder, 20.0 * np.round(good()[F] / 20.0))
    assert any("coarse: force takes" in message and "levels, 20 N apart" in message for message in messages)
    noisy = good()[F] + np.random.default_rng(3).normal(0.0, 20.0, 1501)
    assert not finding(folder, 20.0 * np.round(noisy / 20.0))[1]


def test_two_repeated_samples_do_not_refuse_a_dataset(folder: Make) -> None:
    c = {name: np.array(values) for name, values in good().items()}
    for name in ("stroke [mm]", "velocity [mm/s]", F):
        c[name][502:504] = c[name][501]
    dataset = load_dataset(folder({"a.csv": c}))
    assert np.flatnonzero(~dataset.records[0].usable).tolist() == [502, 503]


def test_missing_preconditioning_is_a_remark_on_degraded_records(folder: Make) -> None:
    intact = RECORD.format("b.csv").replace("0.56", "1").replace("false", "true")
    toml = 'damper = "SA8"\n' + RECORD.format("a.csv") + intact
    findings = load_dataset(folder({"a.csv": good(), "b.csv": good(1401)}, toml=toml)).findings
    (remark,) = [f for f in findings if f.severity == "remark"]
    assert str(remark).startswith("remark: dataset.toml: no preconditioning in a.csv: they begin at the speed")
