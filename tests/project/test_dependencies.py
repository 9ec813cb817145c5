"""The table of dependencies in CONTRIBUTING.md names what is declared, and who imports it."""

import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "src" / "twintube"
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
# Modules whose name is not that of the package.
MODULES = {
    "fmu-manipulation-toolbox": "fmu_manipulation_toolbox",
    "python-calamine": "python_calamine",
    "scikit-learn": "sklearn",
}
MANY = 8  # rooms that are not listed
PROGRAMS = {"docs", "native", "test"}  # extras of those who work on the package, whose tools need no import
ROW = re.compile(r"^\| `([\w-]+)` \| ([\w, -]+) \| \d+ \| [^|]+ \| ([\w, ]*)\|$", re.MULTILINE)


def declared() -> dict[str, set[str]]:
    """The packages, each with `core` or the extras that bring it; `all` is the others together."""
    extras = {"core": PROJECT["dependencies"], **PROJECT["optional-dependencies"]}
    found: dict[str, set[str]] = {}
    for extra, requirements in extras.items():
        for requirement in requirements:
            name = re.match(r"[\w-]+", requirement)
            assert name is not None
            if name[0] != "twintube":
                found.setdefault(name[0], set()).add(extra)
    return found


def rows() -> dict[str, tuple[set[str], set[str]]]:
    """Of each package in the table: where it is declared, and the rooms that import it."""
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    return {name: (set(extras.split(", ")), set(re.findall(r"\w+", rooms))) for name, extras, rooms in ROW.findall(text)}


def importers(package: str) -> set[str]:
    """Rooms of the package that import a module, or look where it is."""
    module = MODULES.get(package, package)
    used = re.compile(rf"(from|import) {module}\b|(find_spec|import_module)\(\"{module}\"")
    files = [path for path in PACKAGE.rglob("*.py") if used.search(path.read_text(encoding="utf-8"))]
    return {path.relative_to(PACKAGE).parts[0].removesuffix(".py") for path in files}


def test_the_table_names_the_declared_dependencies_and_where_they_are_declared() -> None:
    assert {name: extras for name, (extras, _) in rows().items()} == declared()


@pytest.mark.parametrize("package", sorted(declared()))
def test_a_dependency_is_imported_where_the_table_says(package: str) -> None:
    extras, rooms = rows()[package]
    if extras <= PROGRAMS:
        assert not rooms
    elif rooms == {"many"}:
        assert len(importers(package)) >= MANY
    else:
        assert rooms == importers(package) != set()
