"""The examples of README.md, CONTRIBUTING.md and docs/ are run as printed, page by page, in a folder of their own.

    <!-- not run: reason -->   before a block that cannot be run here
    <!-- file: NAME -->        before a block that is the text of a file, which later blocks of the page may use

Commands within the text are not run, but their names and options are checked.
"""

import os
import re
import shlex
import shutil
import tomllib
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import click
import pytest
import typer
from typer.testing import CliRunner

from twintube.cli import app

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
RUN_ELSEWHERE = {"main": "tests/vehicle", "test": ".ci/run"}  # marks of the README's two commands
LANGUAGES = {"sh", "python", "toml", "text", "xml", "lua", "json", ""}


@dataclass(frozen=True)
class Block:
    """A fenced block with the comment in the line before it."""

    page: str
    line: int
    language: str
    mark: str
    text: str


def blocks(path: Path) -> Iterator[Block]:
    lines = path.read_text(encoding="utf-8").splitlines()
    begin, before = None, ""
    for i, line in enumerate(lines):
        if begin is None and line.startswith("```"):
            begin = i
            before = next((text for text in reversed(lines[:i]) if text.strip()), "")
        elif begin is not None and line.startswith("```"):
            mark = re.fullmatch(r"<!-- (.*) -->", before)
            language = lines[begin].removeprefix("```").strip()
            yield Block(path.name, begin + 1, language, mark[1] if mark else "", "\n".join(lines[begin + 1 : i]) + "\n")
            begin = None
    assert begin is None, f"{path.name}: line {begin}: a block without end"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> Path:
    """An empty working folder; for the page on importing, with the FMU of which it speaks."""
    monkeypatch.chdir(tmp_path)
    if request.node.callspec.params["page"].name == "import.md":
        shutil.copy(request.getfixturevalue("sa8_native"), tmp_path / "twintube_SA8.fmu")
        with zipfile.ZipFile(tmp_path / "twintube_SA8.fmu") as fmu:
            name = next(name for name in fmu.namelist() if name.endswith("/input.csv"))
            (tmp_path / "input.csv").write_bytes(fmu.read(name))
    return tmp_path


def run_shell(block: Block) -> None:
    """Every line must be a `twintube` command, with its output to a file where the line says so."""
    for line in block.text.replace("\\\n", " ").splitlines():
        words = shlex.split(line, comments=True)
        if not words:
            continue
        assert words[0] == "twintube", f"{block.page}: line {block.line}: mark the block as not run, or use twintube: {line}"
        target = words[words.index(">") + 1] if ">" in words else None
        words = words[: words.index(">")] if target else words
        done = CliRunner().invoke(app, words[1:])
        assert done.exit_code == 0, f"{block.page}: line {block.line}: {line}\n{done.output}\n{done.exception!r}"
        if target:
            Path(target).write_text(done.stdout, encoding="utf-8")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_the_blocks_of_a_page_run(page: Path, folder: Path) -> None:
    for block in blocks(page):
        where = f"{block.page}: line {block.line}"
        kind, _, detail = block.mark.partition(": ")
        assert block.language in LANGUAGES, where
        if kind == "not run":
            assert detail.strip(), f"{where}: a reason is missing"
        elif kind == "file":
            (folder / detail).parent.mkdir(parents=True, exist_ok=True)
            (folder / detail).write_text(block.text, encoding="utf-8")
        elif block.language == "sh" and kind not in RUN_ELSEWHERE:
            run_shell(block)
        elif block.language == "python":
            exec(compile(block.text, f"{page}:{block.line}", "exec"), {"__name__": "__main__"})
        if block.language == "toml":
            tomllib.loads(block.text)
    assert Path.cwd() == folder


def inline(page: Path) -> Iterator[str]:
    """The commands in the running text: `twintube ...` between backquotes."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    yield from re.findall(r"`(twintube [^`]+)`", text)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_commands_in_the_text_exist_with_their_options(page: Path) -> None:
    group = typer.main.get_command(app)
    assert isinstance(group, click.Group) or hasattr(group, "commands")
    for text in inline(page):
        words = shlex.split(text.replace("[", "").replace("]", ""), comments=True)[1:]
        if words[0].startswith("-"):
            continue
        command = group.commands.get(words[0])  # type: ignore[attr-defined]
        assert command is not None, f"{page.name}: {text}"
        known = {name for parameter in command.params for name in (*parameter.opts, *parameter.secondary_opts)}
        options = [word.split("=")[0] for word in words[1:] if word.startswith("--")]
        assert set(options) <= known | {"--help"}, f"{page.name}: {text}"


def test_every_page_is_reached_from_the_readme() -> None:
    linked: set[str] = set()
    waiting = ["README.md"]
    while waiting:
        page = waiting.pop()
        linked.add(page)
        text = (ROOT / page).read_text(encoding="utf-8")
        for target in re.findall(r"\]\(([^)#:]+\.md)(?:#[\w-]*)?\)", text):
            path = os.path.relpath((ROOT / page).parent / target, ROOT)
            assert (ROOT / path).is_file(), f"{page} links to {target}"
            if path not in linked:
                waiting.append(path)
    assert {str(path.relative_to(ROOT)) for path in PAGES} <= linked


def test_links_to_sections_lead_somewhere() -> None:
    def anchors(path: Path) -> set[str]:
        titles = re.findall(r"^#+ (.+)$", path.read_text(encoding="utf-8"), re.MULTILINE)
        return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}

    for page in PAGES:
        for target, section in re.findall(r"\]\(([^)#:]*)#([\w-]+)\)", page.read_text(encoding="utf-8")):
            assert section in anchors(page.parent / target if target else page), f"{page.name}: {target}#{section}"
