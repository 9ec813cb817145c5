"""The type checker sees the records that are generated: names that do not exist, hooks of the wrong shape."""

import re
import subprocess
import sys
from pathlib import Path

from twintube import stubs

ROOT = Path(__file__).parents[2]
WRONG = """
from collections.abc import Callable

from twintube import harmonic_block, load, simulate
from twintube.core.effects import oil_temperature

damper = load("SA8")
print(damper.parameters.X_Ree)  # parameter
block = harmonic_block(1.048)
print(simulate(damper, block.stroke, block.velocity).strokee)  # result
damper.parameters.oil_level = 7.0  # frozen


def phases(p: oil_temperature.Parameters, s: oil_temperature.State, dt: float) -> None: ...


hook: Callable[[oil_temperature.Parameters, oil_temperature.State, float, float], None] = phases  # hook
"""


def test_generated_types_are_current() -> None:
    assert stubs.STUB.read_text(encoding="utf-8") == stubs.stub(), "python -m twintube.stubs"
    assert stubs.HOOK_TYPES.read_text(encoding="utf-8") == stubs.hook_types(), "python -m twintube.stubs"


def test_every_hook_is_compared_with_its_signature() -> None:
    text = stubs.hook_types()
    assert (
        "oil_temperature_phases: Callable[[oil_temperature.Parameters, oil_temperature.State, float, float], None]" in text
    )


def test_mypy_sees_wrong_names_and_shapes(tmp_path: Path) -> None:
    file = tmp_path / "wrong.py"
    file.write_text(WRONG, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--config-file", str(ROOT / "pyproject.toml"), str(file)],
        cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    lines = {int(number): text for number, text in re.findall(r"wrong\.py:(\d+): error: (.*)", done.stdout)}
    wanted = {
        "# parameter": 'has no attribute "X_Ree"',
        "# result": 'has no attribute "strokee"',
        "# frozen": "read-only",
        "# hook": "Incompatible types in assignment",
    }
    for mark, message in wanted.items():
        number = next(i for i, line in enumerate(WRONG.splitlines(), start=1) if mark in line)
        assert message in lines.get(number, ""), (mark, done.stdout + done.stderr)
    assert len(lines) == len(wanted), done.stdout
