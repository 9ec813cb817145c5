"""The documentation site: every page is in a toctree, links lead somewhere, equations lead to lines, commands and names exist.

Blocks that are run, links between Markdown pages and commands within the text are tested in test_docs_examples.py.
"""

import ast
import importlib
import re
import shlex
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

import pytest

from tests.project.test_docs_examples import PAGES, ROOT, blocks, check_options
from tests.project.test_traceability import tags as tags_of_files
from twintube.common.extras import extra_of
from twintube.core.hook_table import HOOKS
from twintube.diagnosis.numbers import listed

DOCS = ROOT / "docs"
GALLERY = sorted((DOCS / "gallery").glob("*.py"))
MADE = {"examples/index"}  # in the toctree, but written while building


def in_toctrees() -> list[str]:
    text = (DOCS / "index.md").read_text(encoding="utf-8")
    bodies = re.findall(r"^:::\{toctree\}\n(.*?)^:::$", text, re.MULTILINE | re.DOTALL)
    return [line for body in bodies for line in body.splitlines() if line and not line.startswith(":")]


def pages() -> set[str]:
    return {path.stem for pattern in ("*.md", "*.rst") for path in DOCS.glob(pattern)} - {"index"}


def test_every_page_is_in_one_toctree() -> None:
    listed = in_toctrees()
    assert len(listed) == len(set(listed))
    assert set(listed) - MADE == pages() - MADE
    assert set(listed) >= MADE
    assert GALLERY and (DOCS / "gallery" / "README.rst").is_file()


def test_links_to_files_lead_somewhere() -> None:
    for page in PAGES:
        for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
            assert (page.parent / target).exists(), f"{page.name}: {target}"
    for page in [*GALLERY, DOCS / "gallery" / "README.rst", *DOCS.glob("*.rst")]:
        for target in re.findall(r":doc:`/([^`]+)`", page.read_text(encoding="utf-8")):
            assert target in pages(), f"{page.name}: {target}"


def extension(name: str) -> Any:
    """A module of the documentation that needs no Sphinx."""
    sys.path.insert(0, str(DOCS / "_ext"))
    try:
        return importlib.import_module(name)
    finally:
        sys.path.remove(str(DOCS / "_ext"))


@pytest.fixture(scope="module")
def tags() -> Any:
    return extension("tags")


def test_the_page_of_commands_names_those_of_the_program() -> None:
    page = (DOCS / "commands.md").read_text(encoding="utf-8")
    named = [
        name for line in re.findall(r"^- \*\*.*?\*\*: (.+)$", page, re.MULTILINE) for name in re.findall(r"`([^`]+)`", line)
    ]
    assert named == list(extension("command_names").known())


def test_the_site_shows_the_numbers_of_the_diagnosis_and_the_hooks_of_effects() -> None:
    tables = extension("tables")
    page, effects = (
        tables.written((DOCS / f"{name}.md").read_text(encoding="utf-8")) for name in ("diagnosis_method", "effects")
    )
    for entry in listed():
        assert re.search(rf"^\| `{entry['name']}` \| .+ \| {re.escape(entry['meaning'])} \|", page, re.MULTILINE), entry[
            "name"
        ]
    for name, hook in HOOKS.items():
        assert re.search(rf"^\| `{name}` \| .+ \| {re.escape(hook.does)} \|$", effects, re.MULTILINE), name


def test_the_site_shows_the_variables_with_range_unit_and_source() -> None:
    page = extension("tables").written((DOCS / "variables.md").read_text(encoding="utf-8"))
    assert "\n- `stroke` z, -0.5..0.5 m: stroke, positive in rebound (rod out), 0 in the middle\n" in page
    assert (
        "\n- `degradation.X_Re`, 0..1: oil share of the piston valve's mixed flow, rebound, *Table 9, equation 22*\n" in page
    )
    assert not re.search(r"^- `[^`]+`: ", page, re.MULTILINE), "a range, or a unit"


def test_every_equation_is_on_the_page_of_the_model_and_leads_to_its_lines(tags: Any) -> None:
    page = (DOCS / "model.md").read_text(encoding="utf-8")
    shown = [
        number for argument in re.findall(r"^:::\{equation\} (.+)$", page, re.MULTILINE) for number in tags.numbers(argument)
    ]
    assert sorted(shown) == list(range(1, 42))
    found = tags.places()
    assert set(found) == set(shown)
    for number, places in found.items():
        assert {f"{place.file}.py" for place in places} == tags_of_files()[number] - {"__init__.py"}
        for place in places:
            cited = [n for match in tags.TAG.finditer(place.text) for n in tags.numbers(match[1])]
            assert number in cited or place.text.lstrip().startswith("def "), (number, place)
            assert 0 < place.end - place.line + 1 <= tags.LONGEST


def unrun_commands(page: Path) -> Iterator[str]:
    """Lines of blocks that are not run, and indented ones, that call `twintube`."""
    text = page.read_text(encoding="utf-8")
    for block in blocks(page):
        if block.language == "sh" and block.mark.startswith("not run"):
            yield from block.text.replace("\\\n", " ").splitlines()
    yield from re.findall(r"^    (twintube .+)$", text, re.MULTILINE)


def test_commands_that_are_not_run_exist_with_their_options() -> None:
    seen = 0
    for page in PAGES:
        for line in unrun_commands(page):
            words = shlex.split(line, comments=True)
            if not words or Path(words[0]).name != "twintube" or words[1].startswith("-"):
                continue
            seen += 1
            check_options(words[1:], f"{page.name}: {line}")
    assert seen


def resolved(name: str) -> Any:
    """What a dotted name stands for."""
    parts = name.split(".")
    for i in range(len(parts), 0, -1):
        try:
            found = importlib.import_module(".".join(parts[:i]))
        except ModuleNotFoundError:
            continue
        for part in parts[i:]:
            found = getattr(found, part)
        return found
    raise AssertionError(name)


def modules_named() -> set[tuple[str, str]]:
    """Dotted names of this package in the pages, with their page."""
    named = re.compile(r"(?<![\w./-])twintube(?:\.[A-Za-z_]\w*)+")
    return {(page.name, name) for page in PAGES for name in named.findall(page.read_text(encoding="utf-8"))}


@pytest.mark.parametrize(("page", "name"), sorted(modules_named()))
def test_modules_that_pages_name_exist(page: str, name: str) -> None:
    resolved(name)


def test_the_extra_for_the_documentation_brings_what_modules_import() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    brought = re.findall(r"\w+", project["optional-dependencies"]["docs"][0])
    for path in (ROOT / "src" / "twintube").rglob("*.py"):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            names = [item.name for item in node.names] if isinstance(node, ast.Import) else []
            names += [node.module] if isinstance(node, ast.ImportFrom) and node.module else []
            for name in names:
                assert extra_of(name) in (None, *brought), f"{path.name}: {name}"


def test_the_interface_page_names_what_exists_and_is_documented() -> None:
    module, count = "", 0
    for line in (DOCS / "api.rst").read_text(encoding="utf-8").splitlines():
        if match := re.match(r"\.\. currentmodule:: (.+)", line):
            module = match[1]
        elif match := re.fullmatch(r"   ([A-Za-z_.]+)", line):
            count += 1
            assert resolved(f"{module}.{match[1]}").__doc__, line
    import twintube

    assert count > 50
    text = (DOCS / "api.rst").read_text(encoding="utf-8")
    assert all(re.search(rf"^   {name}$", text, re.MULTILINE) for name in twintube.__all__ if name != "__version__")


@pytest.mark.parametrize("path", GALLERY, ids=lambda path: path.stem)
def test_an_example_has_a_title_labelled_axes_and_imports_what_exists(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    tree = ast.parse(text)
    title, rule = (ast.get_docstring(tree) or "").splitlines()[:2]
    assert rule == "=" * len(title)
    assert "ylabel=" in text
    for label in re.findall(r'[xy]label="([^"]+)"', text):
        assert label == "oscillation" or re.search(r"\[.+\]$", label), f"{label}: a unit"
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("twintube"):
            for name in node.names:
                resolved(f"{node.module}.{name.name}")


class Links(HTMLParser):
    """Anchors of a page, what it links to and what it loads."""

    def __init__(self) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.links: set[str] = set()
        self.loads: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        self.anchors |= {given[name] or "" for name in ("id", "name") if name in given}
        if "href" in given:
            (self.links if tag == "a" else self.loads).add(given["href"] or "")
        if "src" in given:
            self.loads.add(given["src"] or "")


@pytest.mark.slow
def test_the_site_is_built_without_warning_and_its_links_lead_somewhere(tmp_path: Path) -> None:
    pytest.importorskip("sphinx_gallery")
    command = [sys.executable, "-m", "sphinx", "-q", "-b", "html", "-W", "--keep-going", "-d", str(tmp_path / "trees")]
    done = subprocess.run([*command, str(DOCS), str(tmp_path / "html")], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    read: dict[Path, Links] = {}
    for path in (tmp_path / "html").rglob("*.html"):
        read[path.resolve()] = Links()
        read[path.resolve()].feed(path.read_text(encoding="utf-8"))
    for path, found in read.items():
        for load in found.loads:
            assert not urlsplit(load).netloc, f"{path.name} loads {load}"
        for link in found.links | found.loads:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            assert target.exists(), f"{path.name}: {link}"
            # From the code of a name that another package passes on, viewcode leads to the page of the name only.
            if parts.fragment and target in read and "_modules" not in path.parts:
                assert unquote(parts.fragment) in read[target].anchors, f"{path.name}: {link}"
