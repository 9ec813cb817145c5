"""`python -m benchmarks.real_dampers FOLDER`: intact identification on sines of real dampers, whose files are not ours.

FOLDER holds files of two public repositories under the MIT licence, both of magneto-rheological dampers without current:
`mr_maurel` (DanielMaurelE/vRTHS_AMBC_MRdamper, Cap7_ModeloMR, *.txt) and `mr_labcontrol` (labcontrol-data/mr-damper, *.mat,
doi 10.5281/zenodo.4445334). Each record is predicted from the others: by the identified damper, and by the mean loop of the
others over the phase. The smoothing that a source's force went through is told, and the errors of a damper seen through it.
"""

from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated

import numpy as np
import typer

from twintube.cli.base import standalone
from twintube.common.arrays import Array
from twintube.dampers import Damper, load, to_toml
from twintube.data import LoadedDataset, load_dataset
from twintube.errors import InputError
from twintube.fitting.averaging import averaging, through
from twintube.fitting.harmonic import Harmonic
from twintube.fitting.oscillations import harmonic
from twintube.fitting.prediction import predicted
from twintube.identification.sines import identify_sines

SOURCES = {
    "mr_maurel": ("*.txt", 'columns = ["time [s]", "stroke [mm]", "velocity [mm/s]", "force [N]"]\n'),
    # The gas pushes the rod out only if both signs are turned.
    "mr_labcontrol": (
        "*.mat",
        '[columns]\n"time [s]" = "Tout"\n"stroke [mm]" = "x_F[0]"\n"velocity [mm/s]" = "x_F[1]"\n"force [N]" = "x_F[2]"\n',
    ),
}
TURNED = {"mr_labcontrol": "stroke_sign = -1\nforce_sign = -1\n"}
PHASE = np.linspace(0.0, 1.0, 200)


def measured(folder: Path, source: str, at: Path) -> LoadedDataset:
    """A source as a dataset at `at`; a table whose crank begins anywhere has the middle of each stroke taken out."""
    pattern, head = SOURCES[source]
    files = sorted((folder / source).glob(pattern))
    if not files:
        raise InputError(f"{folder / source}: no {pattern}: must hold the files of the source")
    base = load("SA1", as_published=True)
    # Room for the strokes; what is identified does not depend on its oil.
    (at / "damper.toml").write_text(to_toml(base.with_(h_l=0.35, V_oil=base.parameters.V_oil + 1e-5)))
    dataset = written(at, source, head, dict.fromkeys(files, 0.0))
    if source not in TURNED:
        return dataset
    middles = [(r.stroke.min() + r.stroke.max()) / 2 for r in dataset.records]
    return written(at, source, head, dict(zip(files, middles, strict=True)))


def written(at: Path, source: str, head: str, middles: dict[Path, float]) -> LoadedDataset:
    """The dataset with the middle of each file's stroke [m]."""
    toml = f'title = "{source}"\ndamper = "damper.toml"\n{TURNED.get(source, "")}{head}'
    for file, middle in middles.items():
        toml += f'[[record]]\nfile = "{file.resolve().as_posix()}"\nmeasurement = "harmonic"\noil_level = 1.0\n'
        toml += f'gas_preload = true\nstroke_offset = "{-1e3 * middle:.3f} mm"\n'
    (at / "dataset.toml").write_text(toml)
    return load_dataset(at)


def loop(record: Harmonic) -> Array:
    """Mean force [N] over the phase of the oscillation."""
    cycles = zip(record.marks[:-1], record.marks[1:], strict=True)
    several = [np.interp(a + PHASE * (b - a), np.arange(a, b + 1), record.force[a : b + 1]) for a, b in cycles]
    return np.asarray(np.mean(several, axis=0))


def error(record: Harmonic, force: Array) -> float:
    """RMS error [N] over the whole oscillations."""
    a, b = record.marks[0], record.marks[-1]
    return float(np.sqrt(np.mean((force - record.force)[a:b] ** 2)))


def by_loops(record: Harmonic, others: Sequence[Harmonic]) -> float:
    """Error [N] of the mean loop of other records."""
    mean, force = np.mean([loop(other) for other in others], axis=0), record.force.copy()
    for a, b in zip(record.marks[:-1], record.marks[1:], strict=True):
        force[a:b] = np.interp(np.arange(b - a) / (b - a), PHASE, mean)
    return error(record, force)


def by_damper(base: Damper, record: Harmonic, others: Sequence[Harmonic]) -> float:
    """Error [N] of the damper that is identified from other records."""
    fit = identify_sines(base, list(others))
    return error(record, predicted(fit.damper, record, fit.offset))


def left_out(base: Damper, records: Sequence[Harmonic]) -> tuple[float, float]:
    """Mean errors [N] of records that were left out: of the damper, and of the mean loop."""
    pairs = [(record, [other for other in records if other is not record]) for record in records]
    return (
        float(np.mean([by_damper(base, record, others) for record, others in pairs])),
        float(np.mean([by_loops(record, others) for record, others in pairs])),
    )


def main(folder: Annotated[Path, typer.Argument(help="With mr_maurel and mr_labcontrol.")]) -> None:
    """Predict each record of a real damper from the others."""
    typer.echo(
        "| source | records | damper [N] | mean loop of the others [N] | smoothed over | damper seen through it [N] |"
    )
    typer.echo("| --- | --- | --- | --- | --- | --- |")
    for source in SOURCES:
        with TemporaryDirectory() as at:
            dataset = measured(folder, source, Path(at))
        records = [harmonic(record) for record in dataset.records]
        mean, (own, others) = averaging(records), left_out(dataset.damper, records)
        through_it = "" if mean is None else f"{left_out(dataset.damper, through(records, mean))[0]:.1f}"
        said = "nothing" if mean is None else f"{mean.share:.0%} of an oscillation"
        typer.echo(f"| {source} | {len(records)} | {own:.1f} | {others:.1f} | {said} | {through_it} |")


if __name__ == "__main__":
    standalone(main)()
