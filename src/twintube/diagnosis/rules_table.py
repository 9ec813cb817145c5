"""The table of all thresholds in the docs; `python -m twintube.diagnosis.rules_table docs/diagnosis_rules.md` renews it."""

import sys
from pathlib import Path

from twintube.diagnosis.rules import RULES
from twintube.files import write_text
from twintube.fitting import averaging
from twintube.fitting.rule import markdown

BEGIN, END = "<!-- rules: begin -->", "<!-- rules: end -->"


def table() -> str:
    """All thresholds as Markdown, with those of the smoothed force, which identification uses as well."""
    return markdown(RULES, averaging.RULES)


def with_table(page: str) -> str:
    """The page with the current table between its marks; raises ValueError where a mark is missing."""
    if BEGIN not in page or END not in page:
        raise ValueError(f"the page needs the lines {BEGIN} and {END}")
    before, rest = page.split(BEGIN, 1)
    return f"{before}{BEGIN}\n{table()}{END}{rest.split(END, 1)[1]}"


if __name__ == "__main__":
    file = Path(sys.argv[1])
    write_text(file, with_table(file.read_text(encoding="utf-8")))
