"""From every equation of the paper to its line and back."""

import re
from pathlib import Path

from typer.testing import CliRunner

from twintube.cli import app

ROOT = Path(__file__).parents[2]
KERNEL = ROOT / "src" / "twintube" / "core" / "kernel"


def expanded(text: str) -> set[int]:
    """The numbers of `14, 15 and 27-29`."""
    found: set[int] = set()
    for first, last in re.findall(r"(\d+)(?:-(\d+))?", text):
        found |= set(range(int(first), int(last or first) + 1))
    return found


def tags() -> dict[int, set[str]]:
    """The files of the kernel in which each equation is tagged, as `Eq. 22` or `Eq. 23, 24` or `Eq. 27-29`."""
    found: dict[int, set[str]] = {}
    for path in KERNEL.glob("*.py"):
        for match in re.finditer(r"Eq\. (\d+(?:-\d+)?(?:(?:, | and )\d+(?:-\d+)?)*)", path.read_text(encoding="utf-8")):
            for number in expanded(match.group(1)):
                found.setdefault(number, set()).add(path.name)
    return found


def test_equations_1_to_41_are_tagged_in_the_kernel() -> None:
    assert set(tags()) == set(range(1, 42))


def test_every_command_in_the_docs_exists() -> None:
    known = set(re.findall(r"^  ([\w-]+) ", CliRunner().invoke(app, ["--help"]).output, re.MULTILINE))
    for path in [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]:
        used = set(re.findall(r"`twintube (\w[\w-]*)", path.read_text(encoding="utf-8")))
        assert used <= known, (path.name, used - known)


def test_no_path_of_a_machine_is_committed() -> None:
    pattern = re.compile(r"/(home|root|tmp|Users)/[a-z]")
    for path in [*ROOT.glob("src/**/*.py"), *ROOT.glob("*.md"), *ROOT.glob("docs/*.md"), *ROOT.glob("*.py")]:
        assert not pattern.search(path.read_text(encoding="utf-8")), path
