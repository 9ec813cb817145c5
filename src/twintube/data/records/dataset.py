"""Dataset folders: `dataset.toml` and the records it names."""

import hashlib
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from twintube.common.grouping import grouped
from twintube.common.reading import ReadError, read_toml
from twintube.common.words import listed, printable
from twintube.core.checks import KELVIN
from twintube.dampers import Damper, ParameterError, load, names
from twintube.data.check.quality import no_preconditioning
from twintube.data.check.reference import check_references
from twintube.data.dataset_toml.fills import fills, say_unknown
from twintube.data.dataset_toml.keys import FILE
from twintube.data.dataset_toml.manifest import Manifest, read_manifest
from twintube.data.findings import DataError, Finding, Notes
from twintube.data.read.columns import read_all
from twintube.data.records.condition import is_intact
from twintube.data.records.record import Record, read_record
from twintube.data.records.signs import check_signs
from twintube.engine.simulate import InputError
from twintube.rig.signals import PRECONDITIONING, V_PRECONDITIONING


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
    return sound(check_dataset(path))


def sound(dataset: Dataset) -> LoadedDataset:
    """The dataset; raises DataError where it has errors."""
    if dataset.errors or dataset.damper is None:
        raise DataError(dataset.title, dataset.findings)
    return LoadedDataset(dataset.title, dataset.damper, dataset.records, dataset.findings)


def check_dataset(path: str | Path, *, force_factor: int = 1) -> Dataset:
    """As `load_dataset`, but errors are only in the findings; nothing is raised.

    All forces times `force_factor` tell what a wrong sign or a wrong unit of the force channel would explain.
    """
    return read_dataset(path, force_factor)


def listed_record(path: Path, block: int | None = None) -> tuple[Damper, Record] | None:
    """The damper and the record of a file that the dataset.toml of its folder names; None where there is no such name.

    Of several records of the file it is that of the `block`. Raises DataError where dataset.toml or this record has an
    error, InputError where it is not one; the other records are not read.
    """
    toml = path.parent / FILE
    if not toml.is_file() or path.name == FILE:
        return None
    found = read_dataset(toml, 1, path, block)
    if not found.errors and not found.records:
        return None
    dataset = sound(found)
    if len(dataset.records) > 1:
        there = listed([record.file for record in dataset.records], 5)
        raise InputError(f"{toml} names {len(dataset.records)} records of this file: {there}; choose by --block")
    return dataset.damper, dataset.records[0]


def read_dataset(path: str | Path, force_factor: int, only: Path | None = None, block: int | None = None) -> Dataset:
    """The dataset with its forces times `force_factor`; with `only`, the records of this file, or of this block of it."""
    if not isinstance(path, (str, Path)):
        raise InputError(f"path is a {type(path).__name__}: must be that of a folder with {FILE}, or of this file")
    folder = Path(path)
    toml = folder / FILE if folder.is_dir() or folder.suffix != ".toml" else folder
    notes = Notes(toml.name, "line")
    title = toml.resolve().parent.name
    try:
        content, text = read_toml(toml)
    except (OSError, ReadError) as error:
        notes.error(missing_manifest(folder) if isinstance(error, FileNotFoundError) else f"cannot be read: {error}")
        return Dataset(title, None, [], notes.findings)
    manifest = read_manifest(content, text, title, notes)
    damper = damper_of(manifest, toml.parent, notes)
    manifest = replace(manifest, entries=fills(manifest.entries, damper, notes))
    say_unknown(manifest.entries, notes)
    check_references(manifest.entries, notes)
    if only is not None:
        named = [
            entry for entry in manifest.entries if entry.file and (toml.parent / entry.file).resolve() == only.resolve()
        ]
        if block is not None:  # of tables in sheets or beside each other the one of this number
            blocks = any(entry.form.block for entry in named)
            named = [entry for entry in named if entry.form.block == block] if blocks else named[block - 1 : block]
        manifest = replace(manifest, entries=named)
        if not named:
            return Dataset(title, None, [], [])
    check_settings(manifest, notes)
    check_places(manifest, toml.parent, notes)
    records: list[Record] = []
    findings: list[Finding] = []
    known: dict[bytes, Record] = {}
    entries = [replace(entry, force_sign=force_factor * entry.force_sign) for entry in manifest.entries]
    outcomes = read_all([(toml.parent / entry.file, entry.form) for entry in entries if entry.file])
    for entry in entries:
        own = Notes(entry.label)
        record = read_record(entry, next(outcomes) if entry.file else None, damper, notes, own)
        findings += own.findings
        if record is not None:
            twin = known.setdefault(digest(record), record)
            if twin is not record:
                remark = Finding("warning", record.file, "", None, f"the same samples as {twin.file}: recorded twice?")
                findings.append(remark)
                record = replace(record, findings=(*record.findings, remark))
            records.append(record)
    check_preconditioning(records, notes)
    if damper is not None:
        check_signs(entries, records, damper, notes)
        findings += list(beyond_law(records, damper))
    return Dataset(manifest.title, damper, records, notes.findings + findings)


def check_settings(manifest: Manifest, notes: Notes) -> None:
    """A warning that names the settings where the records are of several."""
    groups = grouped((entry.setting, entry.label) for entry in manifest.entries)
    if len(groups) > 1:
        named = [f"{printable(key or 'none given')} ({listed(files, 5)})" for key, files in groups.items()]
        line = next(entry.line for entry in manifest.entries if entry.setting is not None)
        notes.warning(f"records of several settings, no single damper: {', '.join(named)}", "setting", line)


def check_places(manifest: Manifest, folder: Path, notes: Notes) -> None:
    """A remark that names the files outside of the dataset's folder: whoever copies it does not have them."""
    home = os.path.abspath(folder)
    outside = [e for e in manifest.entries if e.file and not Path(os.path.abspath(folder / e.file)).is_relative_to(home)]
    if outside:
        files = listed(dict.fromkeys(entry.file for entry in outside), 5)
        notes.remark(f"outside of the dataset's folder: {files}; a copy of the folder is without", "file", outside[0].line)


def check_preconditioning(records: Sequence[Record], notes: Notes) -> None:
    """A remark that names the harmonic records, of a damper that may be degraded, without slow oscillations before."""
    degraded = [r for r in records if r.measurement == "harmonic" and (r.unknown or not is_intact(*r.fill))]
    files = [record.file for record in degraded if no_preconditioning(record.time, record.stroke)]
    if files:
        notes.remark(
            f"no preconditioning in {listed(files, 5)}: they begin at the speed of their blocks; {PRECONDITIONING} "
            f"oscillations at {V_PRECONDITIONING:g} m/s before would bring a damper without its oil to a known state"
        )


def beyond_law(records: Sequence[Record], damper: Damper) -> Iterator[Finding]:
    """A warning for each record that is colder or hotter than the law of the damper's temperature reaches."""
    ends = [kelvins - KELVIN for kelvins in (damper.parameters.T_cold, damper.parameters.T_hot)]
    for record in records:
        along = record.start_temperature if record.temperature is None else record.temperature
        if along is not None and (np.min(along) < ends[0] or np.max(along) > ends[1]):
            message = (
                f"temperature from {np.min(along):.3g} to {np.max(along):.3g} degC: the law of {damper.name} holds from "
                f"{ends[0]:.3g} to {ends[1]:.3g} degC, beyond it fluid force and friction stay as at its end"
            )
            yield Finding("warning", record.file, "temperature", None, message)


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
