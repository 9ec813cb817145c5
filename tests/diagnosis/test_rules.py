"""Thresholds of the diagnosis: one record, complete, immutable, and printed in the documentation."""

from dataclasses import FrozenInstanceError, fields
from pathlib import Path

import pytest

from twintube.diagnosis.rules import RULES
from twintube.diagnosis.rules_table import BEGIN, END, table, with_table
from twintube.fitting import averaging
from twintube.fitting.rule import listed

PAGE = Path(__file__).parents[2] / "docs" / "diagnosis_rules.md"


def test_every_rule_has_a_value_a_reason_and_what_it_was_tuned_on() -> None:
    rules = [*listed(RULES), *listed(averaging.RULES)]
    assert len({rule.name for rule in rules}) == len(rules)
    for rule in rules:
        assert rule.why and rule.tuned_on and rule.section
        assert f"| `{rule.name}` |" in table()


def test_rules_cannot_be_changed() -> None:
    with pytest.raises(FrozenInstanceError):
        RULES.alarm = 0.5  # type: ignore[misc]
    assert all(not isinstance(getattr(RULES, item.name), list) for item in fields(RULES))


def test_the_page_shows_the_current_rules() -> None:
    """Renew it with `python -m twintube.diagnosis.rules_table docs/diagnosis_rules.md`."""
    page = PAGE.read_text(encoding="utf-8")
    assert page == with_table(page)


def test_only_what_is_between_the_marks_is_replaced() -> None:
    page = with_table(f"before\n{BEGIN}\nan outdated table\n{END}\nbehind\n")
    assert page.startswith(f"before\n{BEGIN}\n") and page.endswith(f"{END}\nbehind\n")
    assert "an outdated table" not in page
    with pytest.raises(ValueError, match="needs the lines"):
        with_table("a page without marks")
