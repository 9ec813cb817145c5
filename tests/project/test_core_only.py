"""Without any extra the example is read and its diagnosis can begin: nothing of an extra is imported on the way."""

import subprocess
import sys
from pathlib import Path

SCRIPT = """
import sys

for name in ("asammdf", "cma", "distributed", "emcee", "h5py", "pandas", "pyarrow", "pymoo"):
    sys.modules[name] = None
from typer.testing import CliRunner

import twintube.evidence
import twintube.report.answered
from twintube.cli import app

for arguments in (["example", "my_example"], ["check", "my_example"], ["simulate", "SA8", "--amplitude-mm", "10"]):
    run = CliRunner().invoke(app, arguments)
    assert run.exit_code == 0, (arguments, run.output, run.exception)
"""


def test_a_missing_package_is_answered_with_what_to_install(tmp_path: Path) -> None:
    script = "import sys\nsys.modules['pyarrow'] = None\nfrom twintube.cli import app\napp(['study', 'variants'])"
    done = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stderr == "error: the package pyarrow is not installed: pip install 'twintube[formats]'\n"


def test_first_contact_needs_no_extra(tmp_path: Path) -> None:
    done = subprocess.run([sys.executable, "-c", SCRIPT], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
