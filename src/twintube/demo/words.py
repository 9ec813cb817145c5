"""The results as sentences, each composed from the figures of the summary and with the conditions it holds under."""

from itertools import groupby
from typing import Any

from twintube.dampers.freed_gas import AS_PUBLISHED
from twintube.vehicle.ride import WINDOW

NO_RISE = 1.10  # DLC relative to intact [1] up to which no rise is claimed
SHOWN = 0.6  # oil level [1] of the sentence about models


def verdict(entry: dict[str, Any]) -> str:
    """Whether the wheel load rises at an oil level: `all` assumptions, `none`, or `some` of them."""
    low, high = entry["bands"]["all_over_intact"]
    return "none" if high <= NO_RISE else "all" if low > NO_RISE else "some"


def percent(share: float) -> str:
    """A rise, e.g. `+12 %`."""
    rounded = round(100 * (share - 1))
    return f"{rounded:+d} %" if rounded else "0 %"


def span(entries: list[dict[str, Any]]) -> str:
    """`90 % oil` or `90 to 60 % oil`."""
    first, last = (f"{100 * e['oil_level']:.0f}" for e in (entries[0], entries[-1]))
    return f"{first} % oil" if first == last else f"{first} to {last} % oil"


def speed_sentences(block: dict[str, Any]) -> list[str]:
    """Sentences about one speed."""
    texts = []
    for answer, group in groupby(block["oil_levels"], verdict):
        entries = list(group)
        low = min(e["bands"]["all_over_intact"][0] for e in entries)
        high = max(e["bands"]["all_over_intact"][1] for e in entries)
        head = f"{block['speed_kmh']:.0f} km/h, {span(entries)}: "
        if answer == "none":
            texts.append(
                head + f"the DLC rises by less than 10 % in the whole band (at most {percent(high)} relative to intact)."
            )
        elif answer == "all":
            texts.append(head + f"the DLC rises in the whole band, by {percent(low)} to {percent(high)} relative to intact.")
        else:
            texts.append(head + f"published data do not decide: {percent(low)} to {percent(high)} relative to intact, "
                         "depending on what freed gas does, road, car and damper.")  # fmt: skip
    return texts


def when(time: float) -> str:
    """The start [s] of the first window in which the damping is lost."""
    return "from the start" if time == 0 else f"after {time:.0f} s"


def failure_sentence(block: dict[str, Any]) -> str:
    """Time at which the damping is lost, with the default assumptions."""
    failed = [e for e in block["oil_levels"] if e["time_to_failure_s"] is not None]
    if not failed:
        return f"{block['speed_kmh']:.0f} km/h: the damper keeps more than half of the intact power at every level."
    times = ", ".join(f"{100 * e['oil_level']:.0f} % {when(e['time_to_failure_s'])}" for e in failed)
    conditions = f"freed gas dissolves again; windows of {WINDOW:.0f} s"
    return f"{block['speed_kmh']:.0f} km/h: half of the damper's power is lost at {times} ({conditions})."


def model_sentence(block: dict[str, Any]) -> str:
    """The default, the bare paper model and a scalar factor, at the oil level SHOWN."""
    entry = next(e for e in block["oil_levels"] if e["oil_level"] == SHOWN)
    ratios = [v / block["intact"]["dlc"] for v in (entry["dlc"], entry["bands"]["freed_gas"][AS_PUBLISHED],
                                                 entry["scalar_factor"]["dlc"])]  # fmt: skip
    return (
        f"{block['speed_kmh']:.0f} km/h, {100 * SHOWN:.0f} % oil: {percent(ratios[0])} when the gas dissolves again, "
        f"{percent(ratios[1])} with the bare paper model, {percent(ratios[2])} with the oil level as a factor of the "
        "damper's fluid force."
    )


def sentences(result: dict[str, Any]) -> list[str]:
    """All sentences."""
    texts = [
        "Bands: five roads, every way of the freed gas and both ends of every assumed value, one at "
        "a time; freed gas, damping of the links and dead length also together."
    ]
    for block in result["speeds"]:
        texts += [*speed_sentences(block), failure_sentence(block), model_sentence(block)]
    moments, level = result["moments"]["moments"], 100 * result["moments"]["oil_level"]
    powers = [f"{100 * m['power_share']:.0f} % at {m['from_s']:.0f} s" for m in moments]
    texts.append(
        f"{result['moments']['speed_kmh']:.0f} km/h, {level:.0f} % oil: the damper has {', '.join(powers)} of "
        f"the intact power; its oil goes from {moments[0]['oil_mL']:.0f} to {moments[-1]['oil_mL']:.0f} mL."
    )
    return texts
