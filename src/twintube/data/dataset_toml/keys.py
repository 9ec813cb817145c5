"""The keys of `dataset.toml`: which there are, and what their values must be."""

import math
import re
from collections.abc import Callable, Sequence
from typing import Any

from twintube.dampers.quantity import quantity
from twintube.data.dataset_toml.channels import good_channels
from twintube.data.formats import MOST_COLUMNS, MOST_SKIPPED, known_encoding

Rule = tuple[Callable[[Any], bool], str]  # what a value must be, and that in words
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
           "force_sign", "stroke_sign", "stroke_offset")  # fmt: skip
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


def measured(unit: str, low: float, high: float) -> Callable[[Any], bool]:
    """A text of a number with its unit, from low to high in the SI `unit`."""

    def good(value: Any) -> bool:
        try:
            return isinstance(value, str) and low <= quantity(value, unit) <= high
        except ValueError:
            return False

    return good


def pair(value: Any) -> bool:
    """A pair of times, the earlier one first."""
    return isinstance(value, list) and len(value) == 2 and all(map(number, value)) and value[0] <= value[1]


def text(value: Any, most: int = LONGEST_TEXT) -> bool:
    """A text of one line that is not empty."""
    return isinstance(value, str) and 0 < len(value) <= most and "\n" not in value


def label(value: Any) -> bool:
    """A short text by which records are told to belong together; blanks and what is not seen would part them."""
    return text(value, LONGEST_LABEL) and value.isprintable() and value == value.strip()


def good_path(value: Any) -> bool:
    """A path of a file that systems take; `a.csv/` is that of a folder."""
    return text(value, LONGEST_PATH) and re.search(r"[/\\]\.{0,2}$", value) is None


def between(low: float, high: float, said: str = "a number {}") -> Rule:
    """A number within a range."""
    return lambda x: number(x) and low <= x <= high, said.format(f"from {low:g} to {high:g}")


def whole(low: int, high: int, said: str = "") -> Rule:
    """A whole number within a range."""
    return lambda x: type(x) is int and low <= x <= high, f"an integer from {low} to {high}{said}"


def one_of(texts: Sequence[str], said: str = "one of {}") -> Rule:
    """One of some texts."""
    return lambda x: isinstance(x, str) and x in texts, said.format(", ".join(texts))


SIGN: Rule = (lambda x: type(x) in (int, float) and x in (1, -1), "1 or -1")
TEMPERATURE = between(COLDEST, HOTTEST, "{} degC")
RULES: dict[str, Rule] = {
    "title": (text, f"a text of one line and at most {LONGEST_TEXT} characters"),
    "damper": (good_path, "the name of a damper or of a parameter file"),
    NOT_SURE: (
        lambda x: isinstance(x, list) and len(x) <= MOST_DOUBTS and all(text(doubt, LONGEST_DOUBT) for doubt in x),
        f"a list of at most {MOST_DOUBTS} texts of one line, of at most {LONGEST_DOUBT} characters each",
    ),
    "file": (good_path, f"the name of a file, not of a folder, at most {LONGEST_PATH} characters"),
    "block": whole(1, MOST_RECORDS, ", the number of a table in a text or sheet"),
    "measurement": one_of(MEASUREMENTS),
    "oil_level": (
        lambda x: x == UNKNOWN or (number(x) and 0 <= x <= 1),
        f"a number from 0 to 1, the share of the intact oil volume, or '{UNKNOWN}'",
    ),
    "oil_volume_mL": between(0, LARGEST_VOLUME, f"a number {{}}; where nobody knows it, oil_level = '{UNKNOWN}' instead"),
    "gas_preload": (
        lambda x: x == UNKNOWN or isinstance(x, bool) or (number(x) and 0 <= x <= 1),
        f"true (present), false (lost), a share from 0 to 1 or '{UNKNOWN}'",
    ),
    "state": (label, f"a text like 'as delivered' of at most {LONGEST_LABEL} characters"),
    "reference": (lambda x: isinstance(x, bool), "true or false"),
    "reference_s": (lambda x: pair(x) and x[0] < x[1], "a list like [0, 10] of from and to in seconds"),
    "start_temperature_degC": TEMPERATURE,
    "temperature_degC": TEMPERATURE,
    "gas_pressure": (
        measured("Pa", 0.0, MOST_PRESSURE),
        f"a gauge pressure like '10 bar' or '150 psi', at most {MOST_PRESSURE / 1e5:g} bar",
    ),
    "setting": (text, "a text like 'C3'"),
    "start_s": (number, "a time in seconds"),
    "end_s": (number, "a time in seconds"),
    "exclude": (
        lambda x: isinstance(x, list) and 0 < len(x) <= MOST_WINDOWS and all(map(pair, x)),
        f"a list like [[1.25, 1.3]] of from and to in seconds, at most {MOST_WINDOWS}",
    ),
    "split": one_of(SPLITS),
    "columns": (
        good_columns,
        f"a list of headers, or a table like {{'stroke [mm]' = 'name in the file'}}, at most {MOST_COLUMNS}",
    ),
    "channels": (good_channels, "tables like {force = {column = 'AI1', scale = '500 N/V', offset = '-12 N'}}"),
    "sample_rate_Hz": between(SLOWEST_RATE, FASTEST_RATE),
    "sheet": (text, "the name of a sheet of a workbook"),
    "group": (
        lambda x: text(x) or (type(x) is int and 0 <= x <= MOST_GROUPS),
        f"the name of a channel group of an MDF file, or its number from 0 to {MOST_GROUPS}",
    ),
    # What the csv module takes as a delimiter, or the word.
    "delimiter": (
        lambda x: x == "whitespace" or (isinstance(x, str) and len(x) == 1 and x not in "\r\n\"'"),
        "one character or 'whitespace'",
    ),
    "decimal": one_of((".", ","), "'.' or ','"),
    "encoding": (lambda x: isinstance(x, str) and known_encoding(x), "a text encoding like 'utf-8' or 'latin-1'"),
    "skip_rows": whole(0, MOST_SKIPPED),
    "force_sign": SIGN,
    "stroke_sign": SIGN,
    "stroke_offset": (measured("m", -LARGEST_OFFSET, LARGEST_OFFSET), "a length with unit like '-12.5 mm'"),
}
