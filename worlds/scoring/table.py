"""Figures as Markdown."""

from collections import Counter, defaultdict
from typing import Any


def tables(scored: dict[str, Any]) -> str:
    """A table of figures for each world, and one of what was answered to what was hidden."""
    texts = [f"## {world or 'datasets'}\n\n{figures(groups)}" for world, groups in scored["worlds"].items()]
    return "\n\n".join([*texts, f"## Answers\n\n{answers(scored['datasets'])}"]) + "\n"


def figures(groups: dict[str, dict[str, dict[str, Any]]]) -> str:
    """The figures of a world."""
    lines = ["| of | figure | value | 95 % interval | datasets |", "|---|---|---|---|---|"]
    for group, rows in groups.items():
        for i, (name, row) in enumerate(rows.items()):
            percent = row["count"] is not None
            value, low, high = (
                f"{100 * row[key]:.1f}" if percent else f"{row[key]:.3g}" for key in ("value", "low", "high")
            )
            interval = "" if low == high == value and not percent else f"{low} to {high}"
            datasets = f"{row['count']} of {row['of']}" if percent else str(row["of"])
            unit = " %" if percent else ""
            lines.append(
                f"| {'' if i else group} | {name} | {value}{unit} | {interval}{unit if interval else ''} | {datasets} |"
            )
    return "\n".join(lines)


def answers(datasets: list[dict[str, Any]]) -> str:
    """What was answered to what was hidden, and how often that was right."""
    rows: dict[str, list[dict[str, Any]]] = defaultdict(list)
    for row in datasets:
        rows[" + ".join(row["hidden"])].append(row)
    lines = ["| hidden | datasets | right | answers |", "|---|---|---|---|"]
    for name, some in sorted(rows.items()):
        said = Counter(answer(row) for row in some).most_common()
        told = ", ".join(f"{word} {count}" for word, count in said)
        lines.append(f"| {name} | {len(some)} | {sum(row['right'] for row in some)} | {told} |")
    return "\n".join(lines)


def answer(row: dict[str, Any]) -> str:
    """The answer in a word: names, those of an ambiguous one with a question mark."""
    names = " + ".join(row["named"]) or str(row["verdict"])
    return f"({names})?" if row["verdict"] == "ambiguous" else names
