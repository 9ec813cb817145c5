"""The headline of the wheel load says what the table of the sensitivity page says."""

import re
from pathlib import Path

import pytest

from twintube.dampers import load
from twintube.dampers.dead_length import bounds, collapse_level
from twintube.demo.bands import SPEEDS
from twintube.demo.sensitivity import RISES

ROOT = Path(__file__).parents[2]
LOW = [level for level in RISES if level <= 0.4]  # "40 % of the oil and less"
OPEN = [level for level in RISES if level >= 0.6]  # "from 90 to 60 %"


def rise(row: str) -> dict[tuple[float, float], tuple[int, int]]:
    """Smallest and largest rise [%] of a row of docs/sensitivity.md, by speed [km/h] and oil level."""
    page = (ROOT / "docs" / "sensitivity.md").read_text(encoding="utf-8")
    lines = page[page.index("## Rise") :].splitlines()
    line = next(line for line in lines if line.startswith(f"| {row} |"))
    cells = [tuple(map(int, cell.split(" to "))) for cell in line.strip("| ").split(" | ")[1:]]
    return {key: (cell[0], cell[1]) for key, cell in zip([(v, x) for v in SPEEDS for x in RISES], cells, strict=True)}


def span(row: str, levels: list[float]) -> tuple[int, int]:
    """Smallest and largest rise [%] at both speeds and some levels."""
    cells = [cell for (_, level), cell in rise(row).items() if level in levels]
    return min(low for low, _ in cells), max(high for _, high in cells)


def sentence(name: str, begin: str) -> str:
    """The text of a page from `begin` on, in one line."""
    text = " ".join((ROOT / name).read_text(encoding="utf-8").split())
    return text[text.index(begin) :]


EVERYTHING = "**all settings of the bands**"


@pytest.mark.parametrize("page", ["README.md", "docs/index.md", "docs/car.md"])
def test_the_wheel_load_of_the_headline_is_that_of_the_table(page: str) -> None:
    low, high = span(EVERYTHING, LOW)
    assert low > 10, "the headline claims a rise"
    text = " ".join((ROOT / page).read_text(encoding="utf-8").split())
    (begin, *_) = re.findall("[Ww]ith 40 % of the oil and less", text)
    assert f"by {low} to {high} %" in sentence(page, begin)


def test_what_is_open_above_it_is_that_of_the_table() -> None:
    high = span(EVERYTHING, OPEN)[1]
    assert f"From 90 to 60 % it rises by 0 to {high} %" in sentence("README.md", "## What it can say")
    text = sentence("docs/car.md", "With 40 % of the oil and less")
    assert f"{high} %" in text
    assert "at 50 % it is {} to {} %".format(*span(EVERYTHING, [0.5])) in text.lower()
    assert f"{span('all mild ends at once', LOW)[0]} %" in text


def test_what_is_left_at_50_percent_is_that_of_the_table() -> None:
    text = sentence("docs/car.md", "at 50 % it is")
    default = rise("default")
    for speed in SPEEDS:
        assert "{} to {} % ({:.0f} km/h)".format(*default[speed, 0.5], speed) in text
    for row in ("both: `pushes_oil` and 110 mm", "these and links 450 N s/m"):
        assert "{} to {} %".format(*span(row, [0.5])) in text


def test_levels_of_collapse_on_the_pages_are_those_of_the_dampers() -> None:
    damper = load("SA8")
    low, high = (collapse_level(damper.with_(dead_length=length)) for length in reversed(bounds(damper)))
    text = sentence("docs/car.md", "Where the damper collapses")
    assert f"{100 * collapse_level(damper):.1f} % of SA8's oil, {100 * low:.0f} to {100 * high:.0f} %" in text
    claims = sentence("docs/claims.md", "`twintube dampers` prints")
    levels = [100 * collapse_level(load(name)) for name in ("SA1", "SA5")]
    assert [f"{level:.1f}" for level in levels] == re.findall(r"([\d.]+) % \(SA[15]\)", claims)
