"""Dataset folders: `dataset.toml` and the records it names."""

import hashlib
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from twintube.arrays import Array, freeze_arrays
from twintube.core.checks import tube_limit
from twintube.dampers import Damper, ParameterError, load, names
from twintube.data.checks import check, computed
from twintube.data.findings import DataError, Finding, Notes, UnreadableError
from twintube.data.manifest import Entry, Manifest, read_manifest
from twintube.data.raw import Outcome, read_all
from twintube.data.table import Table, convert
from twintube.reading import ReadError, read_toml

FILE = "dataset.toml"
MEASURED = "measured"
GIVEN = "given, but recomputable from the stroke"
GRADIENT = "central difference of the stroke over its actual times (numpy.gradient)"


@dataclass(frozen=True)
class Record:
    """One measurement; all arrays (n,), SI units but temperatures in degC; stroke and force positive in rebound."""

    name: str  # the file without its ending
    file: str
    measurement: str  # quasi-static, harmonic or stochastic
    oil_level: float  # share of the intact oil volume
    gas_preload: bool
    start_temperature: float | None  # [degC]
    split: str | None  # fit, heldout or not said
    time: Array
    stroke: Array
    force: Array
    velocity: Array
    velocity_source: str  # MEASURED, GIVEN or GRADIENT
    temperature: Array | None  # [degC]
    findings: tuple[Finding, ...]

    def __post_init__(self) -> None:
        """Shared by all who read it."""
        freeze_arrays(self)


@dataclass(frozen=True)
class Dataset:
    """Records of one damper. With `errors` in its findings it holds only the records that have none."""

    title: str
    damper: Damper | None  # None only where it could not be read
    records: list[Record]
    findings: list[Finding]  # of dataset.toml and of all records

    @property
    def errors(self) -> list[Finding]:
        """The findings that refuse the dataset."""
        return [finding for finding in self.findings if finding.severity == "error"]


@dataclass(frozen=True)
class LoadedDataset(Dataset):
    """A dataset without errors."""

    damper: Damper


def load_dataset(path: str | Path) -> LoadedDataset:
    """The dataset of a folder, or of its dataset.toml.

    Raises:
        DataError: with all findings of all records, if one of them is an error. Warnings stay in `findings`.

    """
    dataset = check_dataset(path)
    if dataset.errors or dataset.damper is None:
        raise DataError(dataset.title, dataset.findings)
    return LoadedDataset(dataset.title, dataset.damper, dataset.records, dataset.findings)


def check_dataset(path: str | Path) -> Dataset:
    """As `load_dataset`, but errors are only in the findings; nothing is raised."""
    return read_dataset(path, 1)


def flipped_dataset(path: str | Path) -> Dataset:
    """As `check_dataset` with the sign of every force turned: what a wrong sign of the force channel would explain."""
    return read_dataset(path, -1)


def read_dataset(path: str | Path, sign: int) -> Dataset:
    """The dataset with its forces times `sign`."""
    folder = Path(path)
    toml = folder / FILE if folder.is_dir() or folder.suffix != ".toml" else folder
    notes = Notes(toml.name)
    title = toml.resolve().parent.name
    try:
        content, text = read_toml(toml)
    except (OSError, ReadError) as error:
        notes.error(missing_manifest(folder) if isinstance(error, FileNotFoundError) else f"cannot be read: {error}")
        return Dataset(title, None, [], notes.findings)
    manifest = read_manifest(content, text, title, notes)
    damper = damper_of(manifest, toml.parent, notes)
    records: list[Record] = []
    findings: list[Finding] = []
    known: dict[bytes, Record] = {}
    entries = [replace(entry, force_sign=sign * entry.force_sign) for entry in manifest.entries]
    outcomes = read_all([(toml.parent / entry.file, entry.form) for entry in entries if entry.file])
    for entry in entries:
        own = Notes(entry.file)
        record = read_record(entry, next(outcomes) if entry.file else None, damper, notes, own)
        findings += own.findings
        if record is not None:
            twin = known.setdefault(digest(record), record)
            if twin is not record:
                remark = Finding("warning", record.file, "", None, f"the same samples as {twin.file}: recorded twice?")
                findings.append(remark)
                record = replace(record, findings=(*record.findings, remark))
            records.append(record)
    return Dataset(manifest.title, damper, records, notes.findings + findings)


def missing_manifest(path: Path) -> str:
    """What to do where dataset.toml is not there."""
    where = f"no {FILE} in {path}" if path.is_dir() else f"{path}: no such folder or file"
    return f"cannot be read: {where}; it names the damper and the records, `twintube new-dataset` writes one to start from"


def damper_of(manifest: Manifest, folder: Path, notes: Notes) -> Damper | None:
    """The named damper, or the parameter file in the folder of dataset.toml."""
    if not manifest.damper:
        return None
    try:
        return load(manifest.damper if manifest.damper in names() else folder / manifest.damper)
    except (ParameterError, OSError) as error:
        notes.error(str(error), "damper", manifest.damper_line)
        return None


def digest(record: Record) -> bytes:
    """Of the samples: equal for a record that was stored twice."""
    return hashlib.sha256(record.stroke.tobytes() + record.force.tobytes()).digest()


def read_record(entry: Entry, outcome: Outcome | None, damper: Damper | None, notes: Notes, own: Notes) -> Record | None:
    """Check a record that was read; None if it has an error. `notes` takes findings on dataset.toml, `own` on the file."""
    limit, level = None, entry.oil_level
    if damper is not None:
        if level is None and entry.oil_volume is not None:
            level = entry.oil_volume / damper.parameters.V_oil
            if level > 1.0:
                most = damper.parameters.V_oil * 1e6
                message = f"{entry.where}oil_volume_mL = {entry.oil_volume * 1e6:g}: must be from 0 to {most:g} mL"
                notes.error(message + f", the intact volume of {damper.name}", "oil_volume_mL", entry.line)
                entry = replace(entry, complete=False)
        limit = tube_limit(damper.parameters)
    if outcome is None:
        return None
    if isinstance(outcome, UnreadableError):
        own.counted = "row"
        own.error(str(outcome), row=outcome.row)
        return None
    if isinstance(outcome, OSError):
        own.error(f"cannot be read: {outcome.strerror or outcome}")
        return None
    table = convert(outcome, entry.form, own)
    if table is None:
        return None
    table = turned(table, entry)
    check(table, limit, own)
    if own.failed or not entry.complete or level is None:
        return None
    c = table.columns
    velocity, source = c.get("velocity"), MEASURED
    if velocity is None:
        velocity, source = np.gradient(c["stroke"], c["time"]), GRADIENT
    elif computed(c["time"], c["stroke"], velocity):
        source = GIVEN
    return Record(
        name=Path(entry.file).stem,
        file=entry.file,
        measurement=entry.measurement,
        oil_level=level,
        gas_preload=entry.gas_preload,
        start_temperature=entry.start_temperature,
        split=entry.split,
        time=c["time"],
        stroke=c["stroke"],
        force=c["force"],
        velocity=velocity,
        velocity_source=source,
        temperature=c.get("temperature"),
        findings=tuple(own.findings),
    )


def turned(table: Table, entry: Entry) -> Table:
    """The signs and the zero that dataset.toml states; nothing else is ever changed."""
    columns = dict(table.columns)
    columns["force"] = columns["force"] * entry.force_sign
    columns["stroke"] = columns["stroke"] * entry.stroke_sign + entry.stroke_offset
    if "velocity" in columns:
        columns["velocity"] = columns["velocity"] * entry.stroke_sign
    return replace(table, columns=columns)
