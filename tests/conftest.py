from pathlib import Path

import pytest

import build_fmu
from twintube.parameters import load


@pytest.fixture(scope="session")
def sa8_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_fmu.build(load("SA8"), tmp_path_factory.mktemp("fmu"))


@pytest.fixture(scope="session")
def sa7_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_fmu.build(load("SA7"), tmp_path_factory.mktemp("fmu"))
