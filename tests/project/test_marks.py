"""Each test has the mark of its folder."""

import tomllib
from pathlib import Path

import pytest

from tests.conftest import MARKS, TESTS, mark_of


def test_a_mark_is_that_of_folders_that_exist_and_is_declared() -> None:
    folders = [folder for several in MARKS.values() for folder in several]
    assert len(folders) == len(set(folders)) and all((TESTS / folder).is_dir() for folder in folders)
    options = tomllib.loads((TESTS.parent / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["pytest"]["ini_options"]
    assert {text.split(":")[0] for text in options["markers"]} == {"slow", "unit", *MARKS}


def test_a_test_has_the_mark_of_its_folder(request: pytest.FixtureRequest) -> None:
    folder = Path(__file__).parent.name
    assert (
        [mark.name for mark in request.node.iter_markers() if mark.name in {"unit", *MARKS}] == [mark_of(folder)] == ["docs"]
    )
    assert mark_of("kernel") == "unit"
