"""Real dampers: intact identification on sines predicts records that it has not seen better than the others' mean does."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tests.data.test_formats import MAPPING, REAL
from twintube.data import load_dataset
from twintube.identify import Harmonic, harmonic
from twintube.identify.sines import identify_sines
from twintube.parameters import load, to_toml
from twintube.simulate import simulate

# The labcontrol damper's gas pushes the rod out only if both signs are turned; its stroke is about 10 mm off centre.
TURNED = 'stroke_sign = -1\nforce_sign = -1\nstroke_offset = "10 mm"\n'
COLUMNS = 'columns = ["time [s]", "stroke [mm]", "velocity [mm/s]", "force [N]"]\n'


def mean_loop(record: Harmonic) -> np.ndarray:
    """Mean force over the phase of the oscillation."""
    phase = np.linspace(0, 1, 200)
    cycles = zip(record.marks[:-1], record.marks[1:], strict=True)
    return np.mean([np.interp(a + phase * (b - a), np.arange(a, b + 1), record.force[a : b + 1]) for a, b in cycles], axis=0)


def rms(x: np.ndarray) -> float:
    return float(np.sqrt(np.mean(x**2)))


@pytest.mark.skipif(not REAL.is_dir(), reason="no measured data beside the repository")
@pytest.mark.parametrize(
    ("source", "pattern", "head"), [("mr_maurel", "*.txt", COLUMNS), ("mr_labcontrol", "*.mat", MAPPING + TURNED)]
)
def test_held_out_records_are_predicted(
    tmp_path: Path, source: str, pattern: str, head: str, record_property: Callable[[str, object], None]
) -> None:
    base = load("SA1")
    wide = base.with_(h_l=0.35, V_oil=base.parameters.V_oil + 1e-5)
    (tmp_path / "wide.toml").write_text(to_toml(wide))
    toml = f'title = "{source}"\ndamper = "wide.toml"\n{head}'
    for file in sorted((REAL / source).glob(pattern)):
        toml += f'[[record]]\nfile = "{file.as_posix()}"\nmeasurement = "harmonic"\noil_level = 1.0\ngas_preload = true\n'
    (tmp_path / "dataset.toml").write_text(toml)
    dataset = load_dataset(tmp_path)
    records = [harmonic(record) for record in dataset.records]
    model, means = [], []
    for i, held_out in enumerate(records):
        others = [record for j, record in enumerate(records) if j != i]
        fit = identify_sines(dataset.damper, others)
        found = simulate(fit.damper, held_out.stroke, held_out.velocity).force + fit.offset
        a, b = held_out.marks[0], held_out.marks[-1]
        model.append(rms((found - held_out.force)[a:b]))
        mean = np.mean([mean_loop(other) for other in others], axis=0)
        cycles = zip(held_out.marks[:-1], held_out.marks[1:], strict=True)
        said = np.concatenate(
            [np.interp(np.arange(n) / n, np.linspace(0, 1, 200), mean) for n in (d - c for c, d in cycles)]
        )
        means.append(rms(said - held_out.force[a:b]))
    record_property("model_rms_N", model)
    assert np.mean(model) < np.mean(means)
