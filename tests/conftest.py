import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

import fmpy
import pytest
from hypothesis import settings

import build_fmu
from twintube.parameters import load

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
def kind(request: pytest.FixtureRequest) -> build_fmu.Kind:
    return request.param


@pytest.fixture(scope="session")
def sa8_fmu(kind: build_fmu.Kind, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_fmu.build(load("SA8"), tmp_path_factory.mktemp("fmu"), kind, HERE)


@pytest.fixture(scope="session")
def sa7_fmu(kind: build_fmu.Kind, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_fmu.build(load("SA7"), tmp_path_factory.mktemp("fmu"), kind, HERE)


@pytest.fixture(scope="session")
def sa8_native(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_fmu.build(load("SA8"), tmp_path_factory.mktemp("fmu"), platforms=HERE)
