"""The challenge's outcomes as tables in Markdown: shares with 95 % intervals, over the size of the effect, and by cause."""

from collections import Counter, defaultdict
from collections.abc import Callable, Sequence

from scipy.stats import binomtest

from twintube.lab.challenge.score import (
    CLEAR,
    Outcome,
    answered,
    contradictions,
    limit,
    nameable,
    named,
    right,
    truth_first,
    verdict_of,
    wrong_name,
)

BANDS = (0.0, 0.5, 1.0, 2.0, 5.0)  # effect over noise
SIZES = {"effect_over_noise": "effect over noise", "effect_beyond_bench": "effect beyond the bench, over noise"}


def tables(outcomes: Sequence[Outcome]) -> str:
    """All tables of some outcomes."""
    known = [o for o in outcomes if o["truth"]["kind"] not in ("none", "outside")]
    sizes = (over(known, key, title) for key, title in SIZES.items())
    return "\n\n".join([shares(outcomes), *sizes, limits(known), matrix(outcomes)]) + "\n"


def shares(outcomes: Sequence[Outcome]) -> str:
    """What the aims are about."""
    healthy = [o for o in outcomes if o["truth"]["kind"] == "none"]
    outside = [o for o in outcomes if o["truth"]["kind"] == "outside"]
    known = [o for o in outcomes if o["truth"]["kind"] not in ("none", "outside")]
    clear = [o for o in known if o["truth"]["effect_over_noise"] >= CLEAR]
    beyond = [o for o in clear if o["truth"].get("effect_beyond_bench", 0.0) >= CLEAR]
    asserting = [o for o in outcomes if named(o["answer"])]
    rows: list[tuple[str, Sequence[Outcome], Callable[[Outcome], bool]]] = [
        ("false alarms where nothing is hidden", healthy, lambda o: bool(named(o["answer"]))),
        ("`none` where nothing is hidden", healthy, right),
        (f"right where effect/noise is {CLEAR} or more", clear, right),
        ("the truth first, asserted or ambiguous, of the same", clear, truth_first),
        (f"right where effect/noise beyond the bench is {CLEAR} or more", beyond, right),
        ("the truth first, asserted or ambiguous, of the same", beyond, truth_first),
        ("right of these without delays of less than a sample", list(filter(nameable, beyond)), right),
        ("the truth first, asserted or ambiguous, of the same", list(filter(nameable, beyond)), truth_first),
        ("something named that was not hidden", outcomes, wrong_name),
        ("right where something is named", asserting, right),
        ("outside the catalogue, nothing named", outside, right),
        ("contradictions between verdict and figures", outcomes, lambda o: bool(contradictions(o["answer"]))),
        ("failed", outcomes, lambda o: verdict_of(o["answer"]) == "failed"),
    ]
    lines = ["| | count | share | 95 % interval |", "|---|---|---|---|"]
    for name, some, test in rows:
        count = sum(map(test, some))
        if some:
            interval = binomtest(count, len(some)).proportion_ci()
            share = f"{100 * count / len(some):.1f} % | {100 * interval.low:.1f} to {100 * interval.high:.1f} %"
            lines.append(f"| {name} | {count} of {len(some)} | {share} |")
    return "\n".join(lines)


def over(known: Sequence[Outcome], key: str, title: str) -> str:
    """How often known causes are named, over the size of their effect."""
    lines = [f"| {title} | datasets | right | truth first | a wrong name |", "|---|---|---|---|---|"]
    for low, high in zip(BANDS, (*BANDS[1:], float("inf")), strict=True):
        some = [o for o in known if low <= o["truth"].get(key, -1.0) < high]
        band = f"{low:g} to {high:g}" if high < float("inf") else f"above {low:g}"
        figures = " | ".join(str(sum(map(test, some))) for test in (right, truth_first, wrong_name))
        lines.append(f"| {band} | {len(some)} | {figures} |")
    return "\n".join(lines)


def limits(known: Sequence[Outcome]) -> str:
    """From which size on nine of ten datasets with a cause have it named first."""
    lines = [f"| hidden | datasets | {' | '.join(SIZES.values())} |", "|---|---|---|---|"]
    rows: dict[str, list[Outcome]] = defaultdict(list)
    for o in known:
        if o["truth"]["kind"] != "pair":
            rows[o["truth"]["hidden"]].append(o)
    for name, some in sorted(rows.items()):
        words = {0.0: "any", float("inf"): "not reached"}
        figures = " | ".join(words.get(low, f"{low:g}") for low in (limit(some, size) for size in SIZES))
        lines.append(f"| {name} | {len(some)} | {figures} |")
    return "\n".join(lines)


def matrix(outcomes: Sequence[Outcome]) -> str:
    """What was answered to what was hidden."""
    rows: dict[str, list[Outcome]] = defaultdict(list)
    for o in outcomes:
        rows[o["truth"]["hidden"]].append(o)
    lines = ["| hidden | datasets | right | of those to be named | answers |", "|---|---|---|---|---|"]
    for name, some in sorted(rows.items()):
        clear = [o for o in some if nameable(o)]
        own = f"{sum(map(right, clear))} of {len(clear)}" if some[0]["truth"]["kind"] not in ("none", "outside") else ""
        answers = ", ".join(f"{word} {count}" for word, count in Counter(answered(o["answer"]) for o in some).most_common())
        lines.append(f"| {name.replace('+', ' + ')} | {len(some)} | {sum(map(right, some))} | {own} | {answers} |")
    return "\n".join(lines)
