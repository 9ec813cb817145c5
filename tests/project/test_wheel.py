"""The wheel holds all that the package needs: nobody who installs it has the checkout."""

import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
ENDINGS = {".py", ".pyi", ".toml", ".html", ".js", ".css", ".png", ".c", ".h", ".csv", ".parquet", ".mat", ".md", ".typed"}


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    subprocess.run([sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "-w", str(folder), str(ROOT)], check=True)
    return next(folder.glob("*.whl"))


def files_of(folder: Path, prefix: str) -> set[str]:
    """The files below a folder by their names in the wheel."""
    every = (path for path in folder.rglob("*") if path.suffix in ENDINGS and "__pycache__" not in path.parts)
    return {f"{prefix}/{path.relative_to(folder).as_posix()}" for path in every}


def test_the_wheel_holds_every_file_of_the_package(wheel: Path) -> None:
    wanted = files_of(ROOT / "src" / "twintube", "twintube") | files_of(ROOT / "fmu_src", "twintube/fmu_sources")
    names = set(zipfile.ZipFile(wheel).namelist())
    assert wanted <= names, sorted(wanted - names)
    assert not {name for name in names if not name.startswith("twintube")}


def test_the_wheel_asks_for_little_and_names_the_rest_as_extras(wheel: Path) -> None:
    archive = zipfile.ZipFile(wheel)
    metadata = archive.read(next(name for name in archive.namelist() if name.endswith("/METADATA"))).decode()
    core = [line for line in metadata.splitlines() if line.startswith("Requires-Dist") and "extra ==" not in line]
    assert not [
        line for line in core if any(name in line for name in ("pyarrow", "h5py", "asammdf", "numba", "fmpy", "ziglang"))
    ]
    for extra in ("fmu", "pythonfmu", "formats", "mdf", "cluster", "all"):
        assert f"Provides-Extra: {extra}" in metadata
