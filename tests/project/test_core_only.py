"""Without any extra the example is read and its diagnosis can begin: nothing of an extra is imported on the way."""

import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = """
import sys

for name in ("asammdf", "distributed", "fmpy", "h5py", "pandas", "pyarrow", "pythonfmu", "ziglang"):
    sys.modules[name] = None
from typer.testing import CliRunner

import twintube.diagnosis
import twintube.report.diagnosis.page
from twintube.cli import app

for arguments in (["example", "my_example"], ["check", "my_example"], ["simulate", "SA8", "--amplitude-mm", "10"], ["ride", "SA8"], ["fmu", "SA8"], ["ssp"]):
    run = CliRunner().invoke(app, arguments)
    assert run.exit_code == 0, (arguments, run.output, run.exception)
"""


@pytest.mark.parametrize(
    ("package", "command", "extra"), [("pyarrow", ["study", "variants"], "formats"), ("fmpy", ["demo"], "fmu")]
)
def test_a_missing_package_is_answered_with_what_to_install(
    tmp_path: Path, package: str, command: list[str], extra: str
) -> None:
    script = f"import sys\nsys.modules['{package}'] = None\nfrom twintube.cli import app\napp({command})"
    done = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stderr == f"error: the package {package} is not installed: pip install 'twintube[{extra}]'\n"


def test_first_contact_needs_no_extra(tmp_path: Path) -> None:
    done = subprocess.run([sys.executable, "-c", SCRIPT], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
