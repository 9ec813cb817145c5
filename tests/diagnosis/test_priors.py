"""Other numbers of the method, from a file or by name."""

from pathlib import Path

import pytest

from twintube.diagnosis import priors
from twintube.diagnosis.numbers import numbers
from twintube.errors import InputError


def test_other_numbers_hold_as_long_as_something_is_asked(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text("law_usual = 0.05\nlaw_lags = [1e-3, 4e-3]\n", encoding="utf-8")
    usual = numbers().law_usual, numbers().law_lags
    with priors(file):
        assert (numbers().law_usual, numbers().law_lags) == (0.05, (1e-3, 4e-3))
    assert usual == (numbers().law_usual, numbers().law_lags)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("# mine\nlaw_usual = -0.05\n", "line 2: law_usual = -0.05: must be a number above 0$"),
        ("unchanged = 1.5\n", "line 1: unchanged = 1.5: must be a number above 0 up to 0.99"),
        ("gain = true\n", "line 1: gain = True: must be a number above 0"),
        ("law_lags = [0.002, 0.001]\n", r"line 1: law_lags = \[.*\]: must be 2 numbers of 0 or more that rise"),
        ("law_lag = 0.002\n", "line 1: unknown law_lag.*law_lags"),
        ("unchanged = 0.9\nother = 0.2\n", "unchanged \\+ other = 1.1: must be below 1"),
    ],
)
def test_a_number_out_of_its_range_is_refused_with_its_line(tmp_path: Path, text: str, message: str) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=message), priors(file):
        pass
