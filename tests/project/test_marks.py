"""Each test has the mark of its folder or file."""

import tomllib
from pathlib import Path

import pytest

from tests.conftest import MARKS, TESTS, mark_of


def test_a_mark_is_that_of_places_that_exist_and_is_declared() -> None:
    places = [place for several in MARKS.values() for place in several]
    assert len(places) == len(set(places)) and all((TESTS / place).exists() for place in places)
    options = tomllib.loads((TESTS.parent / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["pytest"]["ini_options"]
    assert {text.split(":")[0] for text in options["markers"]} == {"slow", "unit", *MARKS}


def test_a_test_has_the_mark_of_its_folder(request: pytest.FixtureRequest) -> None:
    own = [mark.name for mark in request.node.iter_markers() if mark.name in {"unit", *MARKS}]
    assert own == [mark_of(Path(__file__).relative_to(TESTS))] == ["docs"]
    assert mark_of(Path("effects/test_factors.py")) == "unit"
    assert mark_of(Path("effects/test_extended_fmu.py")) == "fmu"
