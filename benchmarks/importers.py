"""The FMUs and SSPs in every importer that this computer has, and the table of it for a page.

Programs are found on the search path, fmi4c's Python module on Python's, VDMCheck by `VDMCHECK2` and `VDMCHECK3`: the paths
of vdmcheck2.jar and vdmcheck3.jar.
"""

import os
import shutil
import tempfile
from collections.abc import Mapping
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

from benchmarks.importer_jobs import COLUMNS, jobs
from benchmarks.importer_runs import Runner, apart, by_ecos, by_fmi4c, by_host, by_libcosim, by_program, checked, told

REFUSED = "no: "  # before what a tool said
REFERENCE = "reference"
DAMPERS, FMUS, SYSTEMS = COLUMNS[:4:2], COLUMNS[:4], COLUMNS[4:]
LINUX, ARM, WINDOWS = ("linux64", "x86_64-linux"), ("aarch64-linux",) * 2, ("win64", "x86_64-windows")
FMUSIM = "fmusim --input-file {input} --output-file {result} --stop-time {stop} --output-interval 1e-3 {fmu}"
CHECKER = "fmuCheck.linux64 -k cs -h 1e-3 -s {stop} -n 0 -i {input} -o {result} {fmu}"


def tools() -> dict[str, dict[str, Runner]]:
    """Each importer that is here, with its version: how it runs what it is for."""
    found: dict[str, dict[str, Runner]] = {
        f"ecos {version('ecospy')}": dict.fromkeys(COLUMNS, by_ecos),
        f"libcosim (libcosimpy {version('libcosimpy')})": dict.fromkeys(COLUMNS, by_libcosim),
    }
    if shutil.which("fmusim"):
        found[f"fmusim {told('fmusim')}"] = dict.fromkeys(FMUS, by_program(FMUSIM))
    if find_spec("fmi4c"):
        found["fmi4c"] = dict.fromkeys(FMUS, by_fmi4c)
    if shutil.which("fmuCheck.linux64"):
        found["FMU Compliance Checker"] = dict.fromkeys(FMUS[:2], by_program(CHECKER))
    if shutil.which("wine"):
        found[f"Windows library, wine {told('wine')}"] = dict.fromkeys(DAMPERS, by_host(WINDOWS, ["wine"]))
    if shutil.which("qemu-aarch64"):
        start = ["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"]
        found[f"ARM library, qemu {told('qemu-aarch64')}"] = dict.fromkeys(DAMPERS, by_host(ARM, start, "-ldl"))
    if shutil.which("musl-gcc"):
        found["small program, musl"] = dict.fromkeys(DAMPERS, by_host(LINUX, [], compiler="musl-gcc"))
    for name, columns in (("VDMCheck 2", FMUS[:2]), ("VDMCheck 3", FMUS[2:])):
        jar = os.environ.get(name.upper().replace(" ", ""))
        if jar:
            found[name] = dict.fromkeys(columns, checked(jar))
    return {tool.strip(): runners for tool, runners in found.items()}


def bench_importers() -> dict[str, dict[str, str]]:
    """For each importer the largest relative difference of an output to fmpy's, or why it did not run."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        todo, found = jobs(folder), {f"fmpy {version('fmpy')}": dict.fromkeys(FMUS, REFERENCE) | dict.fromkeys(SYSTEMS, "")}
        for tool, runners in tools().items():
            cells = found[tool] = dict.fromkeys(COLUMNS, "")
            for what, runner in runners.items():
                try:
                    answer = apart(runner, todo[what], Path(tempfile.mkdtemp(dir=folder)))
                    cells[what] = answer if isinstance(answer, str) else f"{todo[what].difference(answer):.1g}"
                except (RuntimeError, ValueError) as error:  # the latter: another number of rows
                    cells[what] = REFUSED + " ".join(str(error).split())
    return found


def as_table(found: Mapping[str, Mapping[str, str]]) -> str:
    """The figures in Markdown, a row for each importer, and a list of what those said that refused."""
    lines = [["importer", *COLUMNS], ["---"] * (1 + len(COLUMNS))]
    lines += [[tool, *(cell.partition(":")[0] for cell in cells.values())] for tool, cells in found.items()]
    table = "".join(f"| {' | '.join(line)} |\n" for line in lines)
    said: dict[tuple[str, str], list[str]] = {}
    for tool, cells in found.items():
        for what, cell in cells.items():
            if cell.startswith(REFUSED):
                said.setdefault((tool, cell.removeprefix(REFUSED)), []).append(what)
    notes = [f"- {' and '.join(whats)} in {tool}: {words}\n" for (tool, words), whats in said.items()]
    return "".join([table, "\n" if notes else "", *notes])
