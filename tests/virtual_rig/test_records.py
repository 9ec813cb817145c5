import tomllib

import numpy as np
import pytest

from twintube.lab.virtual_rig import DatasetRecord, measured, run, virtual_damper, write_dataset


@pytest.fixture(scope="module")
def record():
    t = np.linspace(0, 6, 6001)
    return run(virtual_damper("SA1"), t, 0.03 * np.sin(2 * np.pi * t))


def test_noise_and_offset(record):
    clean = measured(record, 1, noise=0, rate_Hz=1000)
    noisy = measured(record, 1, noise=0.02, force_offset_N=30, rate_Hz=1000)
    error = noisy.force - clean.force
    assert error.mean() == pytest.approx(30, abs=3)
    assert error.std() == pytest.approx(0.02 * np.abs(clean.force).max(), rel=0.1)


def test_jitter(record):
    steps = np.diff(measured(record, 1, jitter=0.1, rate_Hz=500).time)
    assert steps.mean() == pytest.approx(0.002, rel=0.01)
    assert steps.std() == pytest.approx(0.1 * 0.002 * np.sqrt(2), rel=0.1)
    assert (np.diff(measured(record, 1, jitter=2.0, rate_Hz=500).time) > 0).all()


def test_seed_decides(record):
    a, b, c = (measured(record, seed, jitter=0.1) for seed in (1, 1, 2))
    assert (a.force == b.force).all() and (a.time == b.time).all()
    assert len(a.force) != len(c.force) or (a.force != c.force).any()


def test_start_leaves_out_what_was_before(record):
    assert measured(record, 1, start=2.0).time[0] >= 2.0


def test_bad_values_are_refused(record):
    for bad in ({"rate_Hz": 0.0}, {"noise": -1.0}, {"rate_Hz": 0.01}):
        with pytest.raises(ValueError):
            measured(record, 1, **bad)


def test_dataset(record, tmp_path):
    data = measured(record, 3, jitter=0.05)
    entry = DatasetRecord("h100.csv", "harmonic", 1.0, True, data, "fit")
    folder = write_dataset(tmp_path / "set", "SA1", [entry])
    content = tomllib.loads((folder / "dataset.toml").read_text(encoding="utf-8"))
    assert content["damper"] == "SA1"
    assert content["record"][0] == {
        "file": "h100.csv",
        "measurement": "harmonic",
        "oil_level": 1.0,
        "gas_preload": True,
        "start_temperature_degC": pytest.approx(25.0, abs=0.1),
        "split": "fit",
    }
    path = folder / "h100.csv"
    assert path.read_text(encoding="utf-8").splitlines()[0] == "time [s],stroke [mm],force [N],temperature [degC]"
    table = np.loadtxt(path, delimiter=",", skiprows=1)
    assert np.allclose(table[:, 0], data.time, atol=1e-6) and np.allclose(table[:, 1], data.stroke * 1e3, atol=1e-4)
    assert np.allclose(table[:, 2], data.force, atol=1e-2)
    for bad in (DatasetRecord("a/b.csv", "harmonic", 1, True, data), DatasetRecord("b.csv", "sine", 1, True, data)):
        with pytest.raises(ValueError):
            write_dataset(tmp_path, "SA1", [bad])
