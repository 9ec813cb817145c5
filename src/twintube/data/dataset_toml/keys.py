"""The keys of `dataset.toml`: which there are, and what their values must be."""

import math
import re
from collections.abc import Callable
from typing import Any

from twintube.dampers.quantity import quantity
from twintube.data.dataset_toml.channels import good_channels
from twintube.data.formats import MOST_COLUMNS, MOST_SKIPPED, known_encoding

FILE = "dataset.toml"
MEASUREMENTS = ("quasi-static", "harmonic", "stochastic")
SPLITS = ("fit", "heldout")
COLDEST, HOTTEST = -60.0, 200.0  # start temperature [degC]
MOST_RECORDS = 1000
MOST_UNKNOWN = 5  # unknown keys that are named
LONGEST_TEXT = 200  # characters
LONGEST_PATH = 1000
MOST_DOUBTS, LONGEST_DOUBT = 50, 500  # entries of not_sure, and characters of each
LARGEST_OFFSET = 1.0  # [m]
LARGEST_VOLUME = 100_000.0  # oil [mL]
MOST_PRESSURE = 10e6  # gauge pressure of the gas [Pa]
SLOWEST_RATE, FASTEST_RATE = 2.0, 100e3  # samples per second: the limits of the time step
MOST_WINDOWS = 1000
LONGEST_LABEL = 40  # characters of a state, which stands in tables
UNKNOWN = "unknown"  # where nobody knows the fill
MOST_GROUPS = 65_535  # of an MDF file, whose format counts them in 16 bits
# How to read the files: at the top for all records, or in a record.
READING = ("columns", "channels", "sample_rate_Hz", "delimiter", "decimal", "encoding", "skip_rows", "sheet", "group",
           "force_sign",
           "stroke_sign", "stroke_offset")  # fmt: skip
NOT_SURE = "not_sure"
TOP = ("title", "damper", "record", NOT_SURE, *READING)
OIL = ("oil_level", "oil_volume_mL")
RECORD = ("file", "block", "measurement", *OIL, "gas_preload", "gas_pressure", "state", "setting", "temperature_degC",
          "start_temperature_degC", "start_s", "end_s", "exclude", "split",
          "reference", "reference_s", NOT_SURE, *READING)  # fmt: skip


def number(value: Any) -> bool:
    """Whether a TOML value is a finite number."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def good_columns(value: Any) -> bool:
    """A list of headers, or a table header = name in the file."""
    texts = list(value.values()) if isinstance(value, dict) else value
    return isinstance(texts, list) and 0 < len(texts) <= MOST_COLUMNS and all(isinstance(text, str) for text in texts)


def good_offset(value: Any) -> bool:
    """A length with its unit."""
    try:
        return isinstance(value, str) and abs(quantity(value, "m")) <= LARGEST_OFFSET
    except ValueError:
        return False


def good_pressure(value: Any) -> bool:
    """A gauge pressure with its unit."""
    try:
        return isinstance(value, str) and 0.0 <= quantity(value, "Pa") <= MOST_PRESSURE
    except ValueError:
        return False


def good_windows(value: Any) -> bool:
    """A list of pairs of times, each from the earlier to the later."""
    return (
        isinstance(value, list)
        and 0 < len(value) <= MOST_WINDOWS
        and all(isinstance(pair, list) and len(pair) == 2 and all(map(number, pair)) for pair in value)
        and all(low <= high for low, high in value)
    )


def good_window(value: Any) -> bool:
    """A pair of times, the earlier one first."""
    return isinstance(value, list) and len(value) == 2 and all(map(number, value)) and value[0] < value[1]


def text(value: Any, most: int = LONGEST_TEXT) -> bool:
    """A text of one line that is not empty."""
    return isinstance(value, str) and 0 < len(value) <= most and "\n" not in value


def label(value: Any) -> bool:
    """A short text by which records are told to belong together; blanks and what is not seen would part them."""
    return text(value, LONGEST_LABEL) and value.isprintable() and value == value.strip()


def good_doubts(value: Any) -> bool:
    """A list of texts; empty once all is confirmed."""
    return isinstance(value, list) and len(value) <= MOST_DOUBTS and all(text(doubt, LONGEST_DOUBT) for doubt in value)


def good_path(value: Any) -> bool:
    """A path of a file that systems take; `a.csv/` is that of a folder."""
    return text(value, LONGEST_PATH) and re.search(r"[/\\]\.{0,2}$", value) is None


def good_delimiter(value: Any) -> bool:
    """What the csv module takes as a delimiter, or the word `whitespace`."""
    return value == "whitespace" or (isinstance(value, str) and len(value) == 1 and value not in "\r\n\"'")


RULES: dict[str, tuple[Callable[[Any], bool], str]] = {
    "title": (text, f"a text of one line and at most {LONGEST_TEXT} characters"),
    "damper": (good_path, "the name of a damper or of a parameter file"),
    NOT_SURE: (
        good_doubts,
        f"a list of at most {MOST_DOUBTS} texts of one line, of at most {LONGEST_DOUBT} characters each",
    ),
    "file": (good_path, f"the name of a file, not of a folder, at most {LONGEST_PATH} characters"),
    "block": (
        lambda x: type(x) is int and 1 <= x <= MOST_RECORDS,
        f"an integer from 1 to {MOST_RECORDS}, the number of a table in a text or sheet",
    ),
    "measurement": (lambda x: isinstance(x, str) and x in MEASUREMENTS, f"one of {', '.join(MEASUREMENTS)}"),
    "oil_level": (
        lambda x: x == UNKNOWN or (number(x) and 0 <= x <= 1),
        f"a number from 0 to 1, the share of the intact oil volume, or '{UNKNOWN}'",
    ),
    "oil_volume_mL": (
        lambda x: number(x) and 0 <= x <= LARGEST_VOLUME,
        f"a number from 0 to {LARGEST_VOLUME:g}; where nobody knows it, oil_level = '{UNKNOWN}' instead",
    ),
    "gas_preload": (
        lambda x: x == UNKNOWN or isinstance(x, bool) or (number(x) and 0 <= x <= 1),
        f"true (present), false (lost), a share from 0 to 1 or '{UNKNOWN}'",
    ),
    "state": (label, f"a text like 'as delivered' of at most {LONGEST_LABEL} characters"),
    "reference": (lambda x: isinstance(x, bool), "true or false"),
    "reference_s": (good_window, "a list like [0, 10] of from and to in seconds"),
    "start_temperature_degC": (lambda x: number(x) and COLDEST <= x <= HOTTEST, f"from {COLDEST:g} to {HOTTEST:g} degC"),
    "temperature_degC": (lambda x: number(x) and COLDEST <= x <= HOTTEST, f"from {COLDEST:g} to {HOTTEST:g} degC"),
    "gas_pressure": (good_pressure, f"a gauge pressure like '10 bar' or '150 psi', at most {MOST_PRESSURE / 1e5:g} bar"),
    "setting": (text, "a text like 'C3'"),
    "start_s": (number, "a time in seconds"),
    "end_s": (number, "a time in seconds"),
    "exclude": (good_windows, f"a list like [[1.25, 1.3]] of from and to in seconds, at most {MOST_WINDOWS}"),
    "split": (lambda x: isinstance(x, str) and x in SPLITS, f"one of {', '.join(SPLITS)}"),
    "columns": (
        good_columns,
        "a list of headers, or a table like {'stroke [mm]' = 'name in the file'}, at most " + str(MOST_COLUMNS),
    ),
    "channels": (good_channels, "tables like {force = {column = 'AI1', scale = '500 N/V', offset = '-12 N'}}"),
    "sample_rate_Hz": (
        lambda x: number(x) and SLOWEST_RATE <= x <= FASTEST_RATE,
        f"a number from {SLOWEST_RATE:g} to {FASTEST_RATE:g}",
    ),
    "sheet": (text, "the name of a sheet of a workbook"),
    "group": (
        lambda x: text(x) or (type(x) is int and 0 <= x <= MOST_GROUPS),
        f"the name of a channel group of an MDF file, or its number from 0 to {MOST_GROUPS}",
    ),
    "delimiter": (good_delimiter, "one character or 'whitespace'"),
    "decimal": (lambda x: isinstance(x, str) and x in (".", ","), "'.' or ','"),
    "encoding": (lambda x: isinstance(x, str) and known_encoding(x), "a text encoding like 'utf-8' or 'latin-1'"),
    "skip_rows": (lambda x: type(x) is int and 0 <= x <= MOST_SKIPPED, f"an integer from 0 to {MOST_SKIPPED}"),
    "force_sign": (lambda x: type(x) in (int, float) and x in (1, -1), "1 or -1"),
    "stroke_sign": (lambda x: type(x) in (int, float) and x in (1, -1), "1 or -1"),
    "stroke_offset": (good_offset, "a length with unit like '-12.5 mm'"),
}
