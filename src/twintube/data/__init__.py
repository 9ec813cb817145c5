"""Measured data: dataset folders in, SI arrays and a report of every defect out; nothing is repaired.

    load_dataset    a folder with dataset.toml; raises DataError with all findings at once
    check_dataset   the same without raising: the findings and what can be read
    read_motion     time, stroke and velocity of a single record, for a simulation
    report          findings as text
    require_fills   the door of whatever needs records of a known fill

A room for each step:

    read          a file of any format becomes columns by name
    convert       columns become quantities in SI units
    check         what is wrong with them
    records       a folder becomes a Dataset of Records
    dataset_toml  what dataset.toml may say and what it says
    sniff         guesses from the files, for a new dataset.toml and for columns that it does not name

`formats.py` and `findings.py` are the words that all steps speak: how a file is to be read, and what is wrong with it.
"""

from twintube.data.findings import DataError, Finding, report
from twintube.data.records.dataset import Dataset, LoadedDataset, check_dataset, listed_record, load_dataset
from twintube.data.records.motion import read_motion
from twintube.data.records.record import (
    GIVEN,
    GRADIENT,
    MEASURED,
    Record,
    UnknownFillError,
    has_reference,
    require_fills,
)

__all__ = [
    "GIVEN",
    "GRADIENT",
    "MEASURED",
    "DataError",
    "Dataset",
    "Finding",
    "LoadedDataset",
    "Record",
    "UnknownFillError",
    "check_dataset",
    "has_reference",
    "listed_record",
    "load_dataset",
    "read_motion",
    "report",
    "require_fills",
]
