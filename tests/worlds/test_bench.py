"""The bench of all worlds: motions, faults, sampling and files."""

from pathlib import Path

import numpy as np
import pytest

from twintube.data import check_dataset
from worlds.bench import faults, motions
from worlds.bench.files import LAYOUTS, in_milliseconds, write_dataset
from worlds.bench.plan import Channels, Record
from worlds.bench.sampler import Recorder, coloured, converted, taken

DT = 1e-3
PIECES = {
    "swing": motions.swing(0.5, 0.04, 3, DT),
    "triangle": motions.triangle(0.5, 0.04, 12, DT, 0.014),
    "sweep": motions.sweep(0.5, 0.04, 0.5, 8.0, seconds=5.0, dt=DT),
    "road": motions.road(np.random.default_rng(1), 0.5, 0.04, 5.0, DT),
    "rest": motions.rest(1.0, DT),
}


@pytest.mark.parametrize("name", PIECES)
def test_a_motion_begins_and_ends_in_the_middle_and_stays_in_its_bounds(name: str) -> None:
    time, z, v = PIECES[name]
    assert np.all(np.diff(time) > 0.0)
    assert abs(z[0]) < 1e-12 and abs(v[0]) < 0.02 and abs(z[-1]) < 1e-4
    assert np.abs(z).max() < 0.0401 and np.abs(v).max() < 0.51
    way = np.cumsum(np.append(0.0, (v[1:] + v[:-1]) / 2 * np.diff(time)))
    assert np.abs(way - z).max() < 0.001


def test_a_record_may_begin_after_the_strokes_that_settle_the_oil() -> None:
    slow, block = motions.swing(0.05, 0.04, 2, DT), PIECES["swing"]
    cut = motions.joined([slow, motions.rest(2.0, 2.0), block], 2)
    assert cut.time[cut.first] == pytest.approx(slow[0][-1] + 2.0)
    assert len(cut.time) - cut.first == len(block[0])


def channels() -> Channels:
    motion = motions.joined([PIECES["swing"]])
    return Channels(record=Record("r", 0, "harmonic", 1.0, True, 20.0, 10.0), motion=motion, stroke=motion.stroke,
                    force=1000.0 * np.sin(20.0 * motion.time))  # fmt: skip


def test_faults_do_what_they_say() -> None:
    plain, one = channels(), channels()
    faults.late(one, force=0.01)
    at = 0.5 * plain.time[-1]
    np.testing.assert_allclose(np.interp(at, one.time, one.force), np.interp(at - 0.01, plain.time, plain.force), rtol=1e-4)
    for carried, settling, change in ((False, 0.0, 2.0 * at), (True, 0.0, 2.0 * (at + 10.0)), (False, 0.1, 0.2)):
        one = channels()
        faults.drift(one, 2.0, carried=carried, settling=settling)
        np.testing.assert_allclose(np.interp(at, one.time, one.force - plain.force), change, rtol=0.02)
    faults.fast_clock(one, 0.01)
    assert one.force_time is not None and one.force_time(np.array([1.01]))[0] == pytest.approx(1.0)
    faults.clipped(one, 300.0)
    assert np.abs(one.force).max() == 300.0
    one = channels()
    faults.scaled(one, 1.1, 5.0)
    np.testing.assert_allclose(one.force, 1.1 * plain.force + 5.0, rtol=1e-6)
    assert one.stroke is plain.stroke or np.array_equal(one.stroke, plain.stroke)
    for gap, share in ((1e-7, 1.0), (5e-3, 0.9)):
        one = channels()
        faults.backlash(one, gap)
        assert np.sum(np.abs(one.force)) <= share * np.sum(np.abs(plain.force)) + 1e-6
    one = channels()
    faults.resonance(one, 60.0, 0.05)
    assert np.abs(one.force[200:] - plain.force[200:]).max() < 120.0, "a mass follows what is slow"
    faults.dropouts(one, np.array([0.5]), np.array([0.05]), to_zero=True)
    assert np.sum(one.force == 0.0) == pytest.approx(50, abs=2)


def test_sampling_kinds() -> None:
    time = np.linspace(0.0, 2.0, 20001)
    values = np.sin(2 * np.pi * time)
    at = np.arange(0.1, 1.9, 0.01)
    mean = np.sin(2 * np.pi * (at - 0.005))
    np.testing.assert_allclose(taken(time, values, at, Recorder(100.0, "point")), np.sin(2 * np.pi * at), rtol=0, atol=1e-6)
    np.testing.assert_allclose(taken(time, values, at, Recorder(100.0, "mean", late=True)), mean, rtol=0, atol=1e-3)
    np.testing.assert_allclose(taken(time, values, at, Recorder(100.0, "mean")), np.sin(2 * np.pi * at), rtol=0, atol=1e-3)
    delay = np.sqrt(2.0) / (2 * np.pi * 40.0)  # of a Butterworth filter of second order at low frequency
    late = np.sin(2 * np.pi * (at - delay))
    np.testing.assert_allclose(taken(time, values, at, Recorder(100.0, "filtered")), late, rtol=0, atol=5e-3)


def test_noise_has_its_size_and_memory_and_a_converter_its_steps() -> None:
    noise = coloured(np.random.default_rng(1), 20000, 0.8)
    assert np.std(noise) == pytest.approx(1.0, rel=0.05)
    assert np.corrcoef(noise[1:], noise[:-1])[0, 1] == pytest.approx(0.8, abs=0.02)
    assert np.unique(converted(noise, 0.5) % 0.5).tolist() == [0.0]


@pytest.mark.parametrize("layout", [*LAYOUTS, "milliseconds"])
def test_every_layout_is_read_as_written(layout: str, tmp_path: Path) -> None:
    time, z, v = PIECES["swing"]
    force, warm = 2000.0 * v, np.full(len(time), 23.4)
    columns = {"time [s]": np.arange(len(time)) * DT, "stroke [mm]": 1e3 * z, "force [N]": force}
    if layout in ("csv", "machine", "parquet"):
        columns["temperature [degC]"] = warm
    form = in_milliseconds(LAYOUTS["csv"]) if layout == "milliseconds" else LAYOUTS[layout]
    entries = {"measurement": "harmonic", "oil_level": 1.0, "gas_preload": True}
    write_dataset(tmp_path, "A bench", "SA8", form, [("one", entries, columns)])
    dataset = check_dataset(tmp_path)
    assert not dataset.errors
    (record,) = dataset.records
    np.testing.assert_allclose(record.force, force, rtol=0, atol=1e-4)
    np.testing.assert_allclose(record.stroke, z, rtol=0, atol=1e-8)
    np.testing.assert_allclose(record.time, columns["time [s]"], rtol=0, atol=1e-6)
    assert (record.temperature is not None) == ("temperature [degC]" in columns)
