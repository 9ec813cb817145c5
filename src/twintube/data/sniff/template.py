"""A dataset.toml to start from: every key with its meaning, filled in as far as the files tell."""

import os
import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import tomlkit

from twintube import dampers
from twintube.common.files import replacing, write_text
from twintube.common.reading import MB, ReadError, check_regular
from twintube.common.words import CONTROL
from twintube.data.dataset_toml.keys import FILE, NOT_SURE, READING, UNKNOWN
from twintube.data.dataset_toml.manifest import form_of, part_of
from twintube.data.sniff.blocks import sniff_records
from twintube.data.sniff.values import Sniffed
from twintube.engine.simulate import InputError
from twintube.readers import KINDS

MOST_BYTES = 4000 * MB  # of a record

HEAD = """\
# A dataset: records of one damper. `twintube check` on this folder reads it and reports every defect.
# Lines that begin with # are comments; remove the # before a key to use it.

"""
READING_HELP = """
# How the files are to be read. These keys hold for all records; a record may have its own.
#
# columns = {"time [s]" = "Zeit", "stroke [mm]" = "Weg", "force [kN]" = "Kraft"}
#     quantity [unit] = name in the file. Needed: time, stroke, force; optional: velocity, temperature.
#     A list gives the columns of a text or sheet without header: ["time [s]", "stroke [mm]", "", "force [N]"]
#     Times may be date-time stamps. Units may stand in a row of their own under the header.
# channels = {force = {column = "AI1 [V]", scale = "500 N/V", offset = "-12 N"}}
#     For volts and counts: quantity = scale times what is in the file, plus offset. column and offset may be left out.
# sample_rate_Hz = 500        # where the file has no times
# delimiter = ";"             # one character, or "whitespace"; usual is a comma in .csv, a tab in .tsv
# decimal = ","
# encoding = "cp1252"         # where the file is not UTF-8
# skip_rows = 3               # rows before the header, or before the numbers where `columns` is a list
# sheet = "Data"              # of a workbook; usual is the first
# group = "Bench"             # of an MDF file with several channel groups: name or number, the first is 0
# force_sign = -1             # force must be positive when the damper is pulled
# stroke_sign = -1            # stroke must rise when the damper is pulled (rebound)
# stroke_offset = "12.5 mm"   # added: 0 must be the middle position
#
# not_sure = ["force: N is guessed"]   # what is still a guess: every command warns until you delete the entry
"""
RECORD_HELP = """
# The records, one [[record]] for each file:
#
# [[record]]
# file = "oil060_1.0.csv"     # CSV, text, LabVIEW .lvm, Excel, JSON, Parquet, MATLAB .mat or MDF 4, relative to this file
# block = 2                   # optional: which of several tables in a text or sheet, the first is 1
# measurement = "harmonic"    # quasi-static, harmonic or stochastic
# oil_level = 0.6             # share of the intact oil volume, "unknown" where nobody knows it; or instead of it
# oil_volume_mL = 164
# gas_preload = false         # true: the gas is at its pressure; false: lost; a share; or "unknown"
# state = "after the run"     # optional: records with the same words are of one filling; one may state it for all
# gas_pressure = "10 bar"     # optional, of present gas: gauge, cold; bar, psi, MPa
# setting = "C3"              # optional: of an adjustable valve
# start_temperature_degC = 25.0   # optional
# temperature_degC = 40.0     # optional: of the whole record; a column of temperatures counts more
# start_s = 2.0               # optional: what is before is not read
# end_s = 30.5                # optional: what is after is not read
# exclude = [[12.5, 12.6]]    # optional: windows [s] whose force says nothing; their stroke is kept
# split = "heldout"           # optional: fit or heldout; without it the program holds records out by itself
# reference = true            # optional: the damper as it was on this bench, before whatever happened to it
# reference_s = [0, 10]       # optional, instead: from and to [s], this part of a long record is the reference
"""
# What a record says where no file tells its fill
UNKNOWN_FILL = {
    "oil_level": "share of the intact oil volume: where you know it, write a number such as 0.6",
    "gas_preload": "where you know it, write true (at its pressure) or false (lost)",
}


@dataclass(frozen=True)
class Fill:
    """What no file tells: the state of the damper in all records; None where nobody knows it."""

    oil_level: float | None = None
    gas_preload: float | None = None


def new_dataset(
    folder: Path,
    sources: Sequence[Path],
    damper: str = "",
    state: Fill | None = None,
    reference: Sequence[Path] = (),
) -> dict[str, list[str]]:
    """Write dataset.toml into the folder, copy the files into it, and return what is not sure, each with its records.

    Without `sources` it takes the records that lie in the folder. Files of the `reference`, which may be among them, come
    first and are marked as the damper as it was. A fill that `state` leaves open is "unknown". Nothing is overwritten, and
    nothing is written where an InputError, a ParameterError or an OSError is raised.
    """
    if (folder / FILE).exists():
        raise InputError(f"{folder / FILE} is there already; it is not overwritten")
    if damper:
        dampers.load(damper)
    before = {file.resolve(): file for file in reference}
    files = [*before.values(), *(f for f in sources or present(folder) if f.resolve() not in before)]
    names = [file.name for file in files]
    copies: dict[Path, Path] = {}
    for file in files:
        if file.suffix.lower() not in KINDS:
            raise InputError(f"{file}: unknown format {file.suffix!r}, must be one of {', '.join(KINDS)}")
        if names.count(file.name) > 1:
            raise InputError(f"{file}: two files have the name {file.name}")
        try:
            check_regular(file, MOST_BYTES)
        except ReadError as error:
            raise InputError(f"{file}: {error}") from error
        target = folder / file.name
        if target.exists() and not target.samefile(file):
            raise InputError(f"{target} is there already; it is not overwritten")
        if not target.exists():
            copies[target] = file
    records = [
        (file.name, guess, file.resolve() in before)
        for file in files
        for guess in (sniff_records(file) if KINDS[file.suffix.lower()].cells else [Sniffed({})])
    ]
    text, doubts = template(folder, records, damper, state or Fill())
    for target, file in copies.items():
        with replacing(target) as part:
            shutil.copyfile(file, part)
    write_text(folder / FILE, text)
    return doubts


def present(folder: Path) -> list[Path]:
    """The records that lie in a folder, by name."""
    return sorted(p for p in folder.glob("*") if p.suffix.lower() in KINDS) if folder.is_dir() else []


def template(
    folder: Path, records: Sequence[tuple[str, Sniffed, bool]], damper: str, state: Fill
) -> tuple[str, dict[str, list[str]]]:
    """The text of dataset.toml about files by name, and what is not sure in it with the names of the records.

    Of each record it is told whether it is a reference.
    """
    doubts: dict[str, list[str]] = {}
    readings = [guess.reading for _, guess, _ in records]
    first = readings[0] if readings else {}
    shared = {key: first[key] for key in READING if key in first and all(r.get(key) == first[key] for r in readings)}
    text = HEAD + f"title = {quoted(folder.resolve().name)}\n"
    if not damper:
        doubt = "damper: none was given, SA8 is assumed; a name of `twintube dampers` or a parameter file"
        doubts[doubt] = []
        text += not_sure([doubt])
    text += f"damper = {quoted(relative(damper, folder) if damper else 'SA8')}\n"
    text += READING_HELP + "".join(f"{key} = {quoted(value)}\n" for key, value in shared.items()) + RECORD_HELP
    for name, guess, reference in records:
        text += entry(name, guess, reference=reference, shared=shared, state=state, doubts=doubts)
    return text, doubts


def entry(
    name: str, guess: Sniffed, *, reference: bool, shared: dict[str, Any], state: Fill, doubts: dict[str, list[str]]
) -> str:
    """One `[[record]]`; what is not sure goes to `doubts` too."""
    guessed, missing = list(guess.doubts), list(guess.missing)
    body = [f"file = {quoted(name)}"]
    if guess.measurement:
        guessed.append(f"measurement: {guess.measurement}, judged by the speed and the turning points of the stroke")
        body.append(f"measurement = {quoted(guess.measurement)}")
    else:
        missing.append("measurement: quasi-static, harmonic or stochastic; fill it in")
        body.append("# measurement = ")
    for key, value in (("oil_level", state.oil_level), ("gas_preload", state.gas_preload)):
        body.append(f'{key} = "{UNKNOWN}"  # {UNKNOWN_FILL[key]}' if value is None else f"{key} = {quoted(value)}")
    body += ["reference = true"] if reference else []
    body += [f"{key} = {quoted(value)}" for key, value in guess.reading.items() if key not in shared]
    part = part_of(form_of(guess.reading))
    for doubt in guessed + missing:
        doubts.setdefault(said(doubt), []).append(said(f"{name}, {part}" if part else name))
    comments = [f"# {said(fact)}" for fact in guess.facts] + [f"# NOT SURE: {said(doubt)}" for doubt in missing]
    return "\n".join(["", "[[record]]", *comments, *body]) + "\n" + not_sure([said(doubt) for doubt in guessed])


def not_sure(guesses: Sequence[str]) -> str:
    """The key by which every command repeats what was guessed until the user deletes it; empty where nothing was."""
    if not guesses:
        return ""
    lines = "".join(f"    {quoted(guess)},\n" for guess in guesses)
    return f"{NOT_SURE} = [  # NOT SURE: delete what you have confirmed; all commands warn of the rest\n{lines}]\n"


def said(text: str) -> str:
    """A text with what a file may hold as one line of a comment."""
    return CONTROL.sub("?", text)[:500]


def relative(damper: str, folder: Path) -> str:
    """A named damper, or the path of its parameter file as seen from the folder."""
    if damper in dampers.names():
        return damper
    try:
        return Path(os.path.relpath(damper, folder)).as_posix()
    except ValueError:  # on another drive
        return str(Path(damper).resolve())


def quoted(value: Any) -> str:
    """A value as TOML; a table in one line."""
    if isinstance(value, dict):
        table = tomlkit.inline_table()
        table.update(value)
        return table.as_string()
    return str(tomlkit.item(value).as_string())
