"""An FMU against the reference run that it carries, computed on this computer."""

import csv
import io
import math
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import fmpy
from fmpy.model_description import ValidationError

from twintube.errors import UserError
from twintube.fmu.instance import Instance
from twintube.fmu.related import FOLDER

# Of the largest magnitude of an output. C libraries round exp and pow in ways of their own: at most 3e-12 was seen.
TOLERANCE = 1e-9


class TrialError(UserError):
    """The file cannot be tried: it is no FMU, has no reference run or no library for this platform."""


@dataclass(frozen=True)
class Difference:
    """The largest difference of an output to its reference."""

    name: str
    largest: float
    scale: float  # the largest magnitude of the reference
    unit: str

    @property
    def right(self) -> bool:
        """Whether it is within TOLERANCE."""
        return self.largest <= TOLERANCE * self.scale

    def __str__(self) -> str:
        """In words."""
        unit = f" {self.unit}" if self.unit else ""
        return f"{self.name} {self.largest:.3g}{unit} of {self.scale:.4g}{unit}"


def table(archive: zipfile.ZipFile, name: str) -> tuple[list[str], list[list[float]]]:
    """Names of the columns after the time, and the rows; raises ValueError."""
    lines = list(csv.reader(io.StringIO(archive.read(f"{FOLDER}/{name}").decode("utf-8"))))
    if len(lines) < 2 or any(len(line) != len(lines[0]) for line in lines):
        raise ValueError(f"{name}: is not a table with a row of names and rows of as many numbers")
    return lines[0][1:], [[float(value) for value in line[1:]] for line in lines[1:]]


def tried(fmu: Path) -> list[Difference]:
    """The differences of all outputs of the reference over its run, at the step of the default experiment.

    Raises TrialError, and FmuError where the FMU refuses a step.
    """
    try:
        with zipfile.ZipFile(fmu) as archive:
            files = archive.namelist()
            for name in ("input.csv", "reference.csv"):
                if f"{FOLDER}/{name}" not in files:
                    raise TrialError(f"{fmu}: no {FOLDER}/{name}: the FMU carries no reference run")
            (inputs, given), (outputs, expected) = table(archive, "input.csv"), table(archive, "reference.csv")
        description = fmpy.read_model_description(str(fmu))
        step = float(description.defaultExperiment.stepSize)
    except (zipfile.BadZipFile, ValueError, AttributeError, TypeError, ValidationError) as error:
        raise TrialError(f"{fmu}: is not an FMU that can be read: {error}") from None
    units = {v.name: v.unit or "" for v in description.modelVariables}
    for name in (*inputs, *outputs):
        if name not in units:
            raise TrialError(f"{fmu}: {name} is missing: the reference run is of another FMU")
    if len(given) != len(expected):
        raise TrialError(f"{fmu}: input.csv has {len(given)} rows, reference.csv {len(expected)}")
    here = fmpy.platform if description.fmiVersion == "2.0" else fmpy.platform_tuple
    if not any(name.startswith(f"binaries/{here}/") for name in files):
        there = sorted({name.split("/")[1] for name in files if name.startswith("binaries/")})
        raise TrialError(f"{fmu}: no library for {here}, only for {', '.join(there) or 'none'}")
    found = []
    with Instance(fmu, {}, (*inputs, *outputs)) as unit:
        write, read = unit.buffer(*inputs), unit.buffer(*outputs)
        for row in given:
            found.append(list(unit.read(read)))
            write[2][:] = row
            unit.advance(write, step)
    return [
        difference(name, units[name], got, wanted)
        for name, got, wanted in zip(outputs, zip(*found, strict=True), zip(*expected, strict=True), strict=True)
    ]


def difference(name: str, unit: str, found: Sequence[float], expected: Sequence[float]) -> Difference:
    """The largest difference of an output; infinite where it is not a number."""
    apart = [abs(a - b) for a, b in zip(found, expected, strict=True)]
    return Difference(name, max(x if math.isfinite(x) else math.inf for x in apart), max(map(abs, expected)), unit)
