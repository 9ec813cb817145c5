from types import ModuleType

import pytest


@pytest.fixture(scope="session")
def ecos() -> ModuleType:
    """The importer ecos; it needs a library that pip does not bring."""
    try:
        import ecospy
    except OSError as error:
        pytest.skip(f"ecos cannot be loaded: {error} (Debian has it in the package libtbb12)")
    ecospy.EcosLib.set_log_level("warn")
    return ecospy
