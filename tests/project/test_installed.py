"""The wheel in an environment of its own, in a folder of its own: nothing of the checkout is used."""

import json
import subprocess
import sys
import venv
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
pytestmark = pytest.mark.slow
Run = Callable[..., str]


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Run:
    """Runs a program of the environment in an empty folder and returns what it prints."""
    folder = tmp_path_factory.mktemp("installed")
    subprocess.run([sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "-w", str(folder), str(ROOT)], check=True)
    wheel = next(folder.glob("*.whl"))
    venv.create(folder / "env", with_pip=True)
    programs = folder / "env" / ("Scripts" if sys.platform == "win32" else "bin")
    subprocess.run([programs / "python", "-m", "pip", "install", "-q", f"twintube[all] @ {wheel.as_uri()}"], check=True)
    (folder / "work").mkdir()

    def program(name: str, *arguments: str) -> str:
        done = subprocess.run(
            [programs / name, *arguments], cwd=folder / "work", capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        return done.stdout

    return program


def test_the_package_is_the_installed_one(run: Run) -> None:
    assert "site-packages" in run("python", "-c", "import twintube; print(twintube.__file__)")


def test_fmu_is_built_and_valid(run: Run) -> None:
    run("twintube", "fmu", "SA8", "--output", "SA8.fmu")
    assert "[]" in run("python", "-c", "from fmpy.validation import validate_fmu; print(validate_fmu('SA8.fmu'))")
    run("fmpy", "simulate", "SA8.fmu", "--stop-time", "0.1", "--output-file", "result.csv")


def test_ride_and_main_job(run: Run) -> None:
    assert "DLC" in run("twintube", "ride", "SA8", "--oil-level", "0.6", "--gas-lost", "--seconds", "30")
    assert "intact" in run("twintube", "demo", "--seconds", "20", "--output", "demo")


def test_the_example_is_diagnosed(run: Run) -> None:
    run("twintube", "example", "example")
    run("twintube", "diagnose", "example", "--output", "diagnosis")
    answer = json.loads(run("python", "-c", "print(open('diagnosis/diagnosis.json').read())"))
    assert answer["verdict"] == "cause"
