import shutil
from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from twintube.cli import app

PROGRAMS = ("chromium", "chromium-browser", "google-chrome", "chrome")
# No sandbox: containers run as root. The rest keeps the browser from calling its maker.
FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync"]  # fmt: skip
OWN = "Mine </script> & <b>more</b>"


@pytest.fixture(scope="session")
def explorer(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page with a damper of one's own."""
    folder = tmp_path_factory.mktemp("explorer")
    text = files("twintube.dampers").joinpath("SA2.toml").read_text(encoding="utf-8")
    (folder / "mine.toml").write_text(text.replace('name = "SA2"', f'name = "{OWN}"'), encoding="utf-8")
    arguments = ["explore", "--parameters", str(folder / "mine.toml"), "--output", str(folder / "explorer.html")]
    done = CliRunner().invoke(app, arguments)
    assert done.exit_code == 0, done.output
    return folder / "explorer.html"


@pytest.fixture(scope="session")
def chromium() -> Iterator[Any]:
    """A headless Chromium, driven by playwright."""
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed: the page is not opened")
    program = next(filter(None, map(shutil.which, PROGRAMS)), None)
    if program is None:
        pytest.skip("no Chromium is installed (Debian: chromium): the page is not opened")
    with playwright.sync_playwright() as started:
        browser = started.chromium.launch(executable_path=program, args=FLAGS)
        yield browser
        browser.close()
