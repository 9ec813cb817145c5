"""Real dampers: intact identification on sines predicts records that it has not seen better than the others' mean does."""

import itertools
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.data.test_formats import MAPPING, REAL
from twintube.dampers import Damper, load, to_toml
from twintube.data import LoadedDataset, load_dataset
from twintube.fitting.averaging import asked, averaging, through
from twintube.fitting.prediction import predicted
from twintube.identification import Harmonic, harmonic
from twintube.identification.sines import identify_sines

# The labcontrol damper's gas pushes the rod out only if both signs are turned.
TURNED = "stroke_sign = -1\nforce_sign = -1\n"
COLUMNS = 'columns = ["time [s]", "stroke [mm]", "velocity [mm/s]", "force [N]"]\n'


def mean_loop(record: Harmonic) -> np.ndarray:
    """Mean force over the phase of the oscillation."""
    phase = np.linspace(0, 1, 200)
    cycles = zip(record.marks[:-1], record.marks[1:], strict=True)
    return np.mean([np.interp(a + phase * (b - a), np.arange(a, b + 1), record.force[a : b + 1]) for a, b in cycles], axis=0)


def rms(x: np.ndarray) -> float:
    return float(np.sqrt(np.mean(x**2)))


def measured(tmp_path: Path, source: str, damper: Damper) -> LoadedDataset:
    """A source as a dataset folder for `damper`.

    The stroke of labcontrol is counted from where each record begins, a dead centre of the table's crank: its middle is
    another one every time.
    """
    pattern, head = {"mr_maurel": ("*.txt", COLUMNS), "mr_labcontrol": ("*.mat", MAPPING + TURNED)}[source]
    files = sorted((REAL / source).glob(pattern))
    dataset = written(tmp_path, source, damper, head, dict.fromkeys(files, 0.0))
    if source == "mr_maurel":
        return dataset
    middles = {file: (r.stroke.min() + r.stroke.max()) / 2 for file, r in zip(files, dataset.records, strict=True)}
    return written(tmp_path, source, damper, head, middles)


def written(folder: Path, source: str, damper: Damper, head: str, middles: dict[Path, float]) -> LoadedDataset:
    """The folder's description, with the middle of each file's stroke [m]."""
    (folder / "damper.toml").write_text(to_toml(damper))
    toml = f'title = "{source}"\ndamper = "damper.toml"\n{head}'
    for file, middle in middles.items():
        toml += f'[[record]]\nfile = "{file.as_posix()}"\nmeasurement = "harmonic"\noil_level = 1.0\ngas_preload = true\n'
        toml += f'stroke_offset = "{-1e3 * middle:.3f} mm"\n'
    (folder / "dataset.toml").write_text(toml)
    return load_dataset(folder)


def wide() -> Damper:
    """A damper with room for the strokes of the sources; what is identified does not depend on its oil."""
    base = load("SA1", as_published=True)
    return base.with_(h_l=0.35, V_oil=base.parameters.V_oil + 1e-5)


def held_out_errors(damper: Damper, records: list[Harmonic]) -> list[float]:
    """Force error [N] of each record, predicted from the others."""
    errors = []
    for i, record in enumerate(records):
        fit = identify_sines(damper, [other for j, other in enumerate(records) if j != i])
        a, b = record.marks[0], record.marks[-1]
        errors.append(rms((predicted(fit.damper, record, fit.offset) - record.force)[a:b]))
    return errors


needs_real = pytest.mark.skipif(not REAL.is_dir(), reason="no measured data beside the repository")


@needs_real
@pytest.mark.parametrize("source", ["mr_maurel", "mr_labcontrol"])
def test_held_out_records_are_predicted(tmp_path: Path, source: str, record_property: Callable[[str, object], None]) -> None:
    dataset = measured(tmp_path, source, wide())
    records = [harmonic(record) for record in dataset.records]
    model, means = held_out_errors(dataset.damper, records), []
    for i, held_out in enumerate(records):
        mean = np.mean([mean_loop(other) for j, other in enumerate(records) if j != i], axis=0)
        cycles = zip(held_out.marks[:-1], held_out.marks[1:], strict=True)
        said = np.concatenate(
            [np.interp(np.arange(n) / n, np.linspace(0, 1, 200), mean) for n in (d - c for c, d in cycles)]
        )
        means.append(rms(said - held_out.force[held_out.marks[0] : held_out.marks[-1]]))
    record_property("model_rms_N", model)
    assert np.mean(model) < np.mean(means)


@needs_real
def test_the_smoothing_of_a_source_is_recognised_and_helps_where_nothing_was_fitted(
    tmp_path: Path, record_property: Callable[[str, object], None]
) -> None:
    """Its force is a moving mean over a tenth of each oscillation, from 0.1 to 3 Hz alike."""
    dataset = measured(tmp_path, "mr_maurel", wide())
    records = [harmonic(record) for record in dataset.records]
    mean = averaging(records)
    assert mean is not None and mean.seen >= 4
    shares = [share for share, _ in filter(None, map(asked, records))]
    assert np.ptp(shares) < 0.07 * np.mean(shares)
    plain, seen = (held_out_errors(dataset.damper, some) for some in (records, through(records, mean)))
    record_property("held_out_rms_N", (plain, seen))
    assert np.mean(np.square(seen)) < 0.85 * np.mean(np.square(plain))


@needs_real
@pytest.mark.parametrize("source", ["mr_maurel", "mr_labcontrol"])
def test_the_smoothing_does_not_depend_on_the_signs(tmp_path: Path, source: str) -> None:
    answers = []
    for force, stroke in itertools.product((1, -1), repeat=2):
        records = [
            replace(r, force=force * r.force, stroke=stroke * r.stroke, velocity=stroke * r.velocity)
            for r in measured(tmp_path, source, wide()).records
        ]
        answers.append(averaging([harmonic(r) for r in records]))
    if source == "mr_labcontrol":
        assert answers == [None] * 4
    else:
        assert [answer.share for answer in answers if answer] == pytest.approx([0.1] * 4, rel=0.03)
        assert len({(answer.seen, answer.of) for answer in answers if answer}) == 1
