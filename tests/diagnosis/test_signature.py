from collections.abc import Callable
from dataclasses import replace
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lsim

from twintube.data import Record, load_dataset
from twintube.diagnosis.measurement.line import peaks, unrepeated
from twintube.diagnosis.measurement.signature import signatures

EXAMPLES = Path(str(files("twintube.examples")))
AMPLITUDE = 0.045
VELOCITIES = (0.1, 0.2, 0.4, 0.7, 1.1, 1.5)


def record(
    velocity: float,
    preload: bool,
    noise: float,
    rng: np.random.Generator,
    rate: float | None = None,
    *,
    amplitude: float = AMPLITUDE,
) -> Record:
    """Twelve oscillations of a digressive damper with friction; without preload no force in a part that fades."""
    omega = velocity / amplitude
    rate = rate or float(np.clip(300 * omega / (2 * np.pi), 100.0, 2000.0))
    n = int(12 * 2 * np.pi / omega * rate)
    time = (np.arange(n) + rng.uniform(-0.1, 0.1, n)) / rate
    stroke, v = amplitude * np.sin(omega * time), velocity * np.cos(omega * time)
    force = 900 * np.sign(v) * np.abs(v) ** 0.6 * np.where(v > 0, 2.0, 1.0) + 40 * np.tanh(v / 0.005)
    turns = omega * time / (2 * np.pi)
    if preload:
        force -= 60.0
    else:
        force = np.where(np.abs(stroke) < 0.02 * (1.0 + np.exp(-turns / 3)), 0.05, 1.0) * force
    force = force + noise * np.abs(force).max() * rng.standard_normal(n)
    force = force.astype(np.float32).astype(float)
    name = f"{'intact' if preload else 'oil'}_{velocity:g}"
    return Record(
        name,
        name + ".csv",
        "harmonic",
        1.0 if preload else 0.5,
        preload,
        None,
        None,
        time,
        stroke,
        force,
        v,
        "measured",
        None,
        (),
    )


def bench(noise: float = 0.01, seed: int = 0, rate: float | None = None, slow: float = AMPLITUDE) -> list[Record]:
    """Intact and degraded; `slow` is the amplitude [m] of the three slower velocities."""
    rng = np.random.default_rng(seed)
    return [
        record(v, preload, noise, rng, rate, amplitude=slow if v < 0.5 else AMPLITUDE)
        for preload in (True, False)
        for v in VELOCITIES
    ]


def changed(records: list[Record], change: Callable[[Record], np.ndarray]) -> list[Record]:
    return [replace(r, force=change(r)) for r in records]


def names(records: list[Record]) -> list[str]:
    return [signature.name for signature in signatures(records)]


@pytest.mark.parametrize(("noise", "seed"), [(0.0, 0), (0.005, 1), (0.03, 2), (0.03, 3)])
def test_a_good_measurement_has_none(noise: float, seed: int) -> None:
    assert names(bench(noise, seed)) == []


def test_forces_of_a_coarse_converter_are_not_cut() -> None:
    assert names(changed(bench(0.01), lambda r: 5.0 * np.round(r.force / 5.0))) == []
    assert names(changed(bench(0.0), lambda r: 5.0 * np.round(r.force / 5.0))) == []


@pytest.mark.parametrize("step", [0.0, 2.0])
@pytest.mark.parametrize("sign", [1, -1])
def test_a_cut_force(sign: int, step: float) -> None:
    whole = changed(bench(0.01), lambda r: sign * r.force)

    def cut(r: Record) -> np.ndarray:
        force = np.clip(r.force, -1800.0, 1800.0)
        return step * np.round(force / step) if step else force

    (signature,) = signatures(changed(whole, cut))
    assert signature.name == "saturation"
    # What the limit takes of oil_1.1 is less than its noise.
    assert f"clipped at {1800 * sign} N in intact_1.1, intact_1.5, oil_1.5 (" in signature.text
    assert signature.size == np.inf  # nothing limits what was cut off


def test_a_limit_of_a_single_record_does_not_count() -> None:
    records = bench(0.01)
    records[5] = replace(records[5], force=np.minimum(records[5].force, 2500.0))
    assert names(records) == []


def test_hum() -> None:
    def hum(r: Record) -> np.ndarray:
        angle = 2 * np.pi * 49.98 * r.time
        return r.force + 30 * np.sin(angle) + 9 * np.sin(2 * angle)

    (signature,) = signatures(changed(bench(0.02), hum))
    assert signature.name == "line"
    assert "49.98 Hz (" in signature.text and "99.9" in signature.text and "50 Hz mains" in signature.text
    assert signature.size == pytest.approx(np.hypot(30, 9) / np.sqrt(2), rel=0.1)


def test_hum_beyond_half_the_sampling_rate() -> None:
    (signature,) = signatures(changed(bench(0.02, rate=100.0), lambda r: r.force + 40 * np.sin(2 * np.pi * 60.0 * r.time)))
    assert signature.name == "line"
    assert "60 Hz mains, as seen by sampling at 100 Hz" in signature.text


def test_a_vibration_at_a_harmonic_of_the_excitation_is_the_dampers() -> None:
    fade = lambda r: r.force + 60 * np.exp(-r.time / 5) * np.sin(40 * np.unwrap(np.arctan2(r.stroke / 0.045, r.velocity)))  # noqa: E731
    assert "line" not in names(changed(bench(0.02), fade))


@pytest.mark.parametrize("rate", [100.0, 113.0])
def test_white_noise_makes_a_line_as_rarely_as_said(rate: float) -> None:
    rng = np.random.default_rng(5)
    sine = record(0.5, True, 0.0, rng, rate)
    rests = [unrepeated(replace(sine, force=rng.standard_normal(len(sine.time)))) for _ in range(200)]
    assert not any(len(peaks(rest)) for rest in rests if rest is not None)  # 0.02 expected


def swinging(r: Record, frequency: float, loss: float, share: float) -> np.ndarray:
    grid = np.linspace(r.time[0], r.time[-1], 4 * len(r.time))
    w = 2 * np.pi * frequency
    force = np.interp(grid, r.time, r.force)
    _, felt, _ = lsim(([w**2], [1, 2 * loss * w, w**2]), force - force[0], grid - grid[0])
    return r.force + share * (np.interp(r.time, grid, felt + force[0]) - r.force)


def test_a_resonance() -> None:
    rng = np.random.default_rng(1)
    quiet = changed(bench(0.0), lambda r: swinging(r, 41.0, 0.04, 0.7))
    (signature,) = signatures(
        changed(quiet, lambda r: r.force + 0.01 * np.abs(r.force).max() * rng.standard_normal(len(r.time)))
    )
    assert signature.name == "ringing"
    assert float(signature.text.split("about ")[1].split()[0]) == pytest.approx(41.0, rel=0.08)


def test_a_filter_is_no_resonance() -> None:
    assert names(changed(bench(0.01), lambda r: swinging(r, 41.0, 0.6, 1.0))) == []


def after_reversal(r: Record) -> tuple[np.ndarray, np.ndarray]:
    """Way since the last reversal [m] and its direction."""
    turned = np.flatnonzero(np.diff(np.sign(r.velocity))) + 1
    last = np.searchsorted(turned, np.arange(len(r.time)), side="right") - 1
    way = np.where(last >= 0, np.abs(r.stroke - r.stroke[turned[np.maximum(last, 0)]]), 1.0)
    return way, np.sign(r.velocity)


def test_play() -> None:
    (signature,) = signatures(changed(bench(0.01), lambda r: np.where(after_reversal(r)[0] < 0.6e-3, 0.0, r.force)))
    assert signature.name == "backlash"
    assert float(signature.text.split("over ")[1].split()[0]) == pytest.approx(0.6, rel=0.15)


def test_dead_strokes_of_lost_oil_are_no_play() -> None:
    assert (
        names(
            changed(
                bench(0.01), lambda r: r.force if r.gas_preload else np.where(after_reversal(r)[0] < 0.6e-3, 0.0, r.force)
            )
        )
        == []
    )


def test_a_slow_rise_is_no_play() -> None:
    def soft(r: Record) -> np.ndarray:
        way, _ = after_reversal(r)
        return r.force * np.clip(way / 1e-3, 0.0, 1.0) ** 2

    assert names(changed(bench(0.01), soft)) == []


def test_the_example() -> None:
    assert names(load_dataset(EXAMPLES / "bench_SA8").records) == []
