from importlib.resources import files
from pathlib import Path

import pytest
from typer.testing import CliRunner

from twintube.cli import app

OWN = "Mine </script> & <b>more</b>"


@pytest.fixture(scope="session", autouse=True)
def made_module(explorer_module: None) -> None:
    """All tests here need the module."""


@pytest.fixture(scope="session")
def explorer(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page with a damper of one's own."""
    folder = tmp_path_factory.mktemp("explorer")
    text = files("twintube.dampers").joinpath("SA2.toml").read_text(encoding="utf-8")
    (folder / "mine.toml").write_text(text.replace('name = "SA2"', f'name = "{OWN}"'), encoding="utf-8")
    arguments = ["explore", str(folder / "mine.toml"), "--output", str(folder / "explorer.html")]
    done = CliRunner().invoke(app, arguments)
    assert done.exit_code == 0, done.output
    return folder / "explorer.html"
