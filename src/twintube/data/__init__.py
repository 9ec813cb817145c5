"""Measured data: dataset folders in, SI arrays and a report of every defect out; nothing is repaired.

    load_dataset    a folder with dataset.toml; raises DataError with all findings at once
    check_dataset   the same without raising: the findings and what can be read
    read_motion     time, stroke and velocity of a single record, for a simulation
    report          findings as text
    require_fills   the door of whatever needs records of a known fill

Reading: manifest.py (dataset.toml), raw.py (any file), text.py (CSV, text), blocks.py (several tables in a text), lvm.py
(LabVIEW), binary.py and its child read_binary.py (Parquet, MATLAB, MDF), table.py (units). Judging: checks.py,
fills.py (states of filling), reference.py.
"""

from twintube.data.dataset import Dataset, LoadedDataset, check_dataset, listed_record, load_dataset
from twintube.data.findings import DataError, Finding, report
from twintube.data.motion import read_motion
from twintube.data.record import (
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
