"""The page is a single file that loads nothing, and contains all its input."""

import re
from html.parser import HTMLParser

import pytest

from twintube.report.common import html_page
from twintube.report.common.html_page import Finding, Headline, Picture, Section, Table, mark, readable

PNG = b"\x89PNG\r\n\x1a\n0000"


class Page(HTMLParser):
    """Collects what a browser would load, and whether all elements are closed."""

    def __init__(self) -> None:
        super().__init__()
        self.loads: list[str] = []
        self.open: list[str] = []
        self.anchors: set[str] = set()
        self.links: list[str] = []

    def handle_starttag(self, tag, attrs):
        table = dict(attrs)
        self.loads += [table[a] for a in ("src", "srcset", "data", "poster") if a in table]
        if tag == "link":
            self.loads.append(table.get("href", ""))
        if tag == "a":
            self.links.append(table["href"])
        if "id" in table:
            self.anchors.add(table["id"])
        if tag not in ("meta", "img", "br", "link", "source", "input"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def parsed(text: str) -> Page:
    page = Page()
    page.feed(text)
    assert not page.open
    return page


@pytest.fixture(scope="module")
def text() -> str:
    finding = Finding("work < force & more", "does not hold", [("Source", "Section 1")], {"a_b": {"SA1": [1.0, 2.0]}})
    section = Section("one", "Figure 1", "does not hold", "0 of 1", ["A paragraph"], [Picture(PNG, "a picture")], [finding],
                      [Table(("x", "y"), [("1", "2")], "A table")], [("Remark", "none")])  # fmt: skip
    sections = [section, Section("two", "Without verdict")]
    return html_page.Page("A title", sections, ["A lead"], [Table(("h",), [("c",)])], foot="the foot").html


def test_it_is_self_contained(text):
    page = parsed(text)
    assert page.loads and all(uri.startswith("data:image/png;base64,") for uri in page.loads)
    assert not re.search(r"https?://|@import|url\(", text)
    assert "<script" not in text


def test_contents_lead_to_the_sections(text):
    page = parsed(text)
    assert page.links == ["#one", "#two"] and {"one", "two"} <= page.anchors


def test_the_page_contains_its_input(text):
    for content in ("A title", "A lead", "A paragraph", "0 of 1", "A table", "the foot", 'alt="a picture"', "SA1: 1.0, 2.0"):
        assert content in text
    assert "work &lt; force &amp; more" in text


def test_an_answer_comes_first_and_the_rest_folds():
    step, picture = "Run `twintube check`.", Picture(PNG, "loops")
    headline = Headline("The oil gets hot.", "cause named", "found", "Very likely (95 %).", step, picture)
    page = html_page.Page("A title", [Section("one", "Numbers", text=["Inside"])], headline=headline).html
    before, _, after = page.partition("<details>")
    for said in ("The oil gets hot.", "cause named", "Very likely (95 %).", "<code>twintube check</code>", 'alt="loops"'):
        assert said in before
    assert "Inside" in after and parsed(page).links == []


def test_verdicts_have_marks(text):
    assert text.count('class="badge no"') == 3  # contents, section, finding
    assert mark("holds") == "yes" and mark("not checkable") == "open"


def test_numbers_as_text():
    assert readable({"at_60": [1.0, 0.5], "x": {"y": True}}) == "at 60: 1.0, 0.5; x (y: true)"
    assert readable([]) == "none"


def test_a_page_is_written_with_its_pictures(tmp_path):
    page = html_page.Page("A title", [Section("one", "Numbers", pictures=[Picture(PNG, "loops", name="loops")])])
    assert page.write(tmp_path) == [tmp_path / "loops.png", tmp_path / "report.html"]
    assert (tmp_path / "loops.png").read_bytes() == PNG and (tmp_path / "report.html").read_text() == page.html
