import os

# The workers share the cores: threads of the linear algebra would wait for each other. Read when numpy is imported.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import fmpy
import pytest
from hypothesis import settings

from twintube.dampers import load
from twintube.fmu import build_fmu
from twintube.fmu.platforms import Kind
from twintube.native import made
from twintube.native.units import MODULE

# CI repeats the same examples; elsewhere new ones are tried every time.
settings.register_profile("ci", derandomize=True)
settings.register_profile("night", max_examples=500)
if os.environ.get("CI"):
    settings.load_profile("ci")

TESTS = Path(__file__).parent
# The tests of these folders and files have a mark; all others are `unit`.
MARKS = {
    "diagnosis": ["diagnosis", "identification", "claims", "studies", "worlds", "challenge",
                  "virtual_rig"],
    "fmu": ["fmu", "native", "vehicle", "driving", "inspection", "explorer", "effects/test_extended_fmu.py"],
    "docs": ["project", "hardening", "report"],
}  # fmt: skip
HERE = (fmpy.platform,)
PROGRAMS = ("chromium", "chromium-browser", "google-chrome", "chrome")
# No sandbox: containers run as root. The rest keeps the browser from calling its maker.
FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync"]  # fmt: skip


def mark_of(path: Path) -> str:
    """The mark of the tests of a file, given below the folder of all tests."""
    named = {path.parts[0], path.as_posix()}
    return next((mark for mark, places in MARKS.items() if named & set(places)), "unit")


@pytest.hookimpl(tryfirst=True)  # before -m looks at marks
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        item.add_marker(mark_of(item.path.relative_to(TESTS)))


def ensure_made(platform: str) -> None:
    """Make what the package brings for a platform, where this checkout does not have it."""
    if not made.complete(platform):
        made.made_for(platform)


@pytest.fixture(scope="session", autouse=True)
def unpacked_in_pytests_folder(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """What importers unpack goes where pytest clears up; many leave it behind."""
    with pytest.MonkeyPatch.context() as patch:
        folder = str(tmp_path_factory.mktemp("unpacked"))
        patch.setattr(tempfile, "tempdir", folder)
        patch.setenv("TMPDIR", folder)
        yield


@pytest.fixture(scope="session", params=["native", "python"])
def kind(request: pytest.FixtureRequest) -> Kind:
    return request.param


@pytest.fixture(scope="session")
def sa8_fmu(kind: Kind, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_fmu(load("SA8"), tmp_path_factory.mktemp("fmu"), kind, HERE)


@pytest.fixture(scope="session")
def explorer_module() -> None:
    """The explorer's module; a checkout has it only where somebody asked for it."""
    ensure_made(MODULE)


@pytest.fixture(scope="session")
def sa7_fmu(kind: Kind, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_fmu(load("SA7"), tmp_path_factory.mktemp("fmu"), kind, HERE)


@pytest.fixture(scope="session")
def sa8_native(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_fmu(load("SA8"), tmp_path_factory.mktemp("fmu"), platforms=HERE)


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
