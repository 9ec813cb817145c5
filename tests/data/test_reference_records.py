"""Records that show the damper as it was, and parts of records."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tests.data.conftest import RECORD, good
from twintube.data import check_dataset, load_dataset

Make = Callable[..., Path]


def written(folder: Make, *lines: str) -> Path:
    """A dataset with a record of 3 s for each of the texts; those of the first begin in line 8 of dataset.toml."""
    toml = 'title = "Test"\ndamper = "SA8"\n' + "".join(RECORD.format(f"{i}.csv") + more for i, more in enumerate(lines))
    return folder({f"{i}.csv": good(1501 + i) for i in range(len(lines))}, toml=toml)


def test_which_samples_are_the_reference(folder: Make) -> None:
    whole, part, none = load_dataset(written(folder, "reference = true\n", "reference_s = [0, 1]\n", "")).records
    assert (whole.reference, part.reference, none.reference) == (True, False, False)
    assert whole.in_reference.all() and not none.in_reference.any()
    np.testing.assert_array_equal(part.in_reference, part.time <= 1.0)
    assert (part.reference_window, whole.reference_window) == ((0.0, 1.0), None)


def test_check_names_the_reference(folder: Make) -> None:
    findings = load_dataset(written(folder, "", "reference = true\n", "reference_s = [0.5, 1]\n")).findings
    (said,) = [finding for finding in findings if finding.column.startswith("reference")]
    assert str(said) == "remark: dataset.toml, line 13, reference: reference: 1.csv, 2.csv from 0.5 to 1 s"


def test_nothing_but_references_is_a_warning(folder: Make) -> None:
    findings = load_dataset(written(folder, *["reference = true\n"] * 2)).findings
    (said,) = [finding for finding in findings if finding.column == "reference"]
    assert said.severity == "warning" and "no change can be named" in said.message


@pytest.mark.parametrize(
    ("lines", "line", "message"),
    [
        ("reference = 1\n", 8, "reference = 1: must be true or false"),
        ("reference_s = [1, 0]\n", 8, "reference_s = [1, 0]: must be a list like [0, 10]"),
        ("reference_s = 10\n", 8, "reference_s = 10: must be a list like [0, 10]"),
        ("reference_s = [0, 1]\nreference = true\n", 8, "must be left out where reference = true"),
        ("start_s = 1\nreference_s = [0, 2]\n", 9, "reference_s = [0, 2]: must not begin before start_s = 1"),
        ("reference_s = [0, 2]\nend_s = 1.5\n", 8, "reference_s = [0, 2]: must not end after end_s = 1.5"),
        ("reference_s = [0, 10]\n", 8, "0 usable samples are beside it; a whole record has reference = true, the record"),
        ("reference_s = [5, 10]\n", 8, "reference_s = [5, 10]: 0 usable samples are in it, the record goes from 0 to 3 s"),
        ("reference_s = [0, 1]\nexclude = [[0, 1]]\n", 8, "reference_s = [0, 1]: 0 usable samples are in it"),
    ],
)
def test_a_part_that_cannot_be_is_refused_with_its_line(folder: Make, lines: str, line: int, message: str) -> None:
    (error,) = check_dataset(written(folder, lines)).errors
    assert message in error.message
    assert (error.file, error.row) == ("dataset.toml", line)
