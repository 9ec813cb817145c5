"""The table of hooks on the page about effects: `python docs/_ext/hook_table.py` writes it into docs/effects.md."""

from pathlib import Path

from twintube.core.hook_table import with_hooks

PAGE = Path(__file__).parents[1] / "effects.md"

if __name__ == "__main__":
    PAGE.write_text(with_hooks(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
