from pathlib import Path
from types import ModuleType

import fmpy
import pytest

from twintube.dampers import load
from twintube.fmu import build_fmu


@pytest.fixture(scope="session")
def sa8_fmi3(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_fmu(load("SA8"), tmp_path_factory.mktemp("fmi3"), platforms=(fmpy.platform_tuple,), fmi=3)


@pytest.fixture(scope="session")
def ecos() -> ModuleType:
    """The importer ecos; it needs a library that pip does not bring."""
    try:
        import ecospy
    except OSError as error:
        pytest.skip(f"ecos cannot be loaded: {error} (Debian has it in the package libtbb12)")
    ecospy.EcosLib.set_log_level("warn")
    return ecospy
