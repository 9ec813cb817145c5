import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

import fmpy
import pytest
from hypothesis import settings

from twintube.dampers import load
from twintube.fmu import build_fmu
from twintube.fmu.platforms import Kind

# CI repeats the same examples; elsewhere new ones are tried every time.
settings.register_profile("ci", derandomize=True)
if os.environ.get("CI"):
    settings.load_profile("ci")


HERE = (fmpy.platform,)


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
def sa7_fmu(kind: Kind, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_fmu(load("SA7"), tmp_path_factory.mktemp("fmu"), kind, HERE)


@pytest.fixture(scope="session")
def sa8_native(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_fmu(load("SA8"), tmp_path_factory.mktemp("fmu"), platforms=HERE)
