"""Threads that start together load the compiled kernel once, and take fingerprints."""

import subprocess
import sys

SCRIPT = """
import sys
from concurrent.futures import ThreadPoolExecutor

from twintube import provenance
from twintube.engine import compiled

sys.setswitchinterval(1e-6)
with ThreadPoolExecutor(8) as threads:
    modules = list(threads.map(lambda _: compiled.module(), range(16)))
    marks = list(threads.map(provenance.fingerprint, ["twintube.studies.cases", "twintube.report.paper.fitted"] * 4))
assert len(set(marks)) == 2
assert len(set(map(id, modules))) == 1
"""


def test_threads_do_not_disturb_each_other() -> None:
    done = subprocess.run([sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
