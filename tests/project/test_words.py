"""The first pages are short and plain: lines, sentences and brackets of README and of the pages by reader."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
ROLES = ["fmu_engineer", "bench_technician", "inspection_developer", "researcher", "fleet_engineer", "ci"]
FIRST = [ROOT / "README.md", *(DOCS / f"{name}.md" for name in [*ROLES, "index"])]


def plain(path: Path) -> str:
    """The running text: without blocks, comments, pictures, and with links by their words."""
    text = path.read_text(encoding="utf-8")
    text = re.sub(r"^(```|:::).*?^\1$|<!--.*?-->|!\[.*?\]\(.*?\)", "", text, flags=re.DOTALL | re.MULTILINE)
    return re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", text)


def sentences(text: str) -> Iterator[str]:
    """Sentences and list items; the cells of tables are none."""
    for part in re.split(r"\n\s*\n|\n(?=\s*(?:- |\d+\. |\|))", text):
        if not part.lstrip().startswith("|"):
            yield from re.split(r"(?<=[.?!])\**\s+", " ".join(part.split()))


@pytest.mark.parametrize("page", FIRST, ids=lambda page: page.stem)
def test_a_sentence_has_at_most_25_words_and_no_bracket_within_a_bracket(page: Path) -> None:
    text = plain(page)
    assert not [words for words in sentences(text) if len(words.split()) > 25]
    assert not re.search(r"\([^()]*\(", re.sub(r"`[^`]*`", "", text))


def test_pages_are_short() -> None:
    assert len((ROOT / "README.md").read_text(encoding="utf-8").splitlines()) <= 90
    for name in ROLES:
        assert len((DOCS / f"{name}.md").read_text(encoding="utf-8").splitlines()) <= 120, name


def test_no_page_has_more_than_200_lines() -> None:
    assert not [page.name for page in DOCS.glob("*.md") if len(page.read_text(encoding="utf-8").splitlines()) > 200]


def test_a_word_of_the_glossary_is_used() -> None:
    rest = " ".join(path.read_text(encoding="utf-8").lower() for path in DOCS.glob("*.md") if path.stem != "glossary")
    for item in re.findall(r"^- \*\*(.+)\*\*:", (DOCS / "glossary.md").read_text(encoding="utf-8"), re.MULTILINE):
        for word in re.sub(r" \(\w+\)", "", item).split(", "):
            assert word.lower() in rest, word


def test_a_release_is_told_in_a_page() -> None:
    for part in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8").split("\n## ")[1:]:
        assert len(part.split()) <= 500, part.splitlines()[0]
