"""What holds the project together: one version, valid files of the tools, imports in one direction."""

import re
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest
import yaml

import twintube
from twintube.core.effects import EFFECTS
from twintube.identification.dataset import ENOUGH, HELD_OUT

ROOT = Path(__file__).parents[2]
PROJECT: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


def load(name: str) -> Any:
    return yaml.safe_load((ROOT / name).read_text(encoding="utf-8"))


def test_one_version() -> None:
    version = PROJECT["project"]["version"]
    assert twintube.__version__ == version
    assert load("CITATION.cff")["version"] == version
    assert f"## {version}" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")


def test_citation_names_the_paper() -> None:
    citation = load("CITATION.cff")
    assert citation["cff-version"] == "1.2.0"
    assert {"message", "title", "authors"} <= set(citation)
    doi = citation["preferred-citation"]["doi"]
    assert doi in PROJECT["project"]["urls"]["Paper"]
    assert doi in (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_workflow_is_valid() -> None:
    workflow = load(".github/workflows/ci.yml")
    assert set(workflow["jobs"]) == {"test", "platforms", "fmu", "docs", "translation", "release", "nightly", "versions"}
    for name, job in workflow["jobs"].items():
        assert job["runs-on"], name
        for step in job["steps"]:
            assert ("run" in step) != ("uses" in step), (name, step)
    systems = workflow["jobs"]["platforms"]["strategy"]["matrix"]["os"]
    assert {system.split("-")[0] for system in systems} == {"windows", "macos"}
    triggers = workflow[True] if True in workflow else workflow["on"]  # YAML 1.1 reads `on` as true
    assert "schedule" in triggers


def test_every_python_that_is_named_is_tested_at_night() -> None:
    named = {c.rsplit(" ", 1)[1] for c in PROJECT["project"]["classifiers"] if re.search(r"Python :: 3\.\d+$", c)}
    matrix = load(".github/workflows/ci.yml")["jobs"]["versions"]["strategy"]["matrix"]
    assert set(matrix["python"]) >= named
    assert f">={min(named, key=lambda v: int(v[2:]))}" == PROJECT["project"]["requires-python"]
    assert {"python": "3.11", "packages": "oldest"} in matrix["include"]


def test_the_oldest_versions_are_those_of_the_requirements() -> None:
    done = subprocess.run([sys.executable, str(ROOT / ".ci" / "oldest")], capture_output=True, text=True, check=True)
    lines = done.stdout.split()
    for requirement in PROJECT["project"]["dependencies"]:
        assert requirement.replace(">=", "==") in lines


def test_the_package_says_who_made_it_and_carries_its_licence() -> None:
    assert {a["name"] for a in PROJECT["project"]["authors"]} == {a["name"] for a in load("CITATION.cff")["authors"]}
    licence = (ROOT / "LICENSE").read_text(encoding="utf-8")
    assert (ROOT / "fmu_src" / "licences" / "twintube.txt").read_text(encoding="utf-8") == licence


def test_pre_commit_runs_the_tools_of_the_test_command() -> None:
    (repository,) = load(".pre-commit-config.yaml")["repos"]
    hooks = {hook["id"]: hook for hook in repository["hooks"]}
    assert {"ruff", "ruff-format", "mypy"} <= set(hooks)
    command = re.search(r"<!-- test -->\n```sh\n(.*?)\n```", (ROOT / "README.md").read_text(encoding="utf-8"), re.DOTALL)
    assert command is not None
    for tool in ("ruff check", "ruff format --check", "mypy", "pytest"):
        assert f"/{tool}" in command[1], tool


def test_imports_run_in_one_direction(tmp_path: Path) -> None:
    program = Path(sys.executable).with_name("lint-imports")
    if not program.exists() and not program.with_suffix(".exe").exists():
        pytest.skip("import-linter is not installed")
    done = subprocess.run(
        [str(program), "--no-logo", "--cache-dir", str(tmp_path)], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout


def test_nothing_is_without_use() -> None:
    """But for the names in pyproject.toml, with who uses them there."""
    pytest.importorskip("vulture")
    done = subprocess.run([sys.executable, "-m", "vulture"], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_every_package_is_in_the_distribution_and_in_the_architecture() -> None:
    packages = {path.parent.relative_to(ROOT / "src") for path in (ROOT / "src" / "twintube").rglob("__init__.py")}
    listed = set(PROJECT["tool"]["setuptools"]["packages"])
    assert {".".join(path.parts) for path in packages} <= listed
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    for path in packages:
        if len(path.parts) == 2 and path.name != "examples":
            assert f"`{path.name}`" in page, path.name


def test_the_page_of_effects_has_every_effect_with_its_parameters() -> None:
    page = (ROOT / "docs" / "effects.md").read_text(encoding="utf-8")
    rows = {match[1]: match[0] for match in re.finditer(r"^\| `(\w+)`.*$", page, re.MULTILINE)}
    for name, effect in EFFECTS.items():
        for item in effect.parameters:
            text = f"**`{item.name}`**" if item.name in effect.strength else f"`{item.name}`"
            assert text in rows[name], (name, item.name)


def test_the_guide_says_what_identify_holds_out() -> None:
    numbers = {1: "second", 2: "third", 3: "third", 4: "fourth"}
    guide = " ".join((ROOT / "docs" / "identification.md").read_text(encoding="utf-8").split())
    every, first = HELD_OUT
    assert f"every {numbers[every]} degraded velocity from the {numbers[first]} on is held out" in guide
    assert ENOUGH == 5 and "five or more velocities" in guide
