"""What is seen, in words: every sentence is made from the figures beside it and says under which conditions it stands."""

from itertools import groupby
from typing import Any

NOTHING = 1.10  # DLC over the intact one's up to which no rise is claimed [1]


def verdict(entry: dict[str, Any]) -> str:
    """Whether the wheel load shows an oil level: under every assumption, under none, or that depends."""
    low, high = entry["bands"]["all_over_intact"]
    return "none" if high <= NOTHING else "all" if low > NOTHING else "some"


def percent(share: float) -> str:
    """A rise, e.g. `+12 %`."""
    rounded = round(100 * (share - 1))
    return f"{rounded:+d} %" if rounded else "0 %"


def span(entries: list[dict[str, Any]]) -> str:
    """`90 % oil` or `90 to 60 % oil`."""
    first, last = (f"{100 * e['oil_level']:.0f}" for e in (entries[0], entries[-1]))
    return f"{first} % oil" if first == last else f"{first} to {last} % oil"


def of_speed(block: dict[str, Any]) -> list[str]:
    """Sentences about one speed."""
    found = []
    for what, group in groupby(block["oil_levels"], verdict):
        entries = list(group)
        low = min(e["bands"]["all_over_intact"][0] for e in entries)
        high = max(e["bands"]["all_over_intact"][1] for e in entries)
        head = f"{block['speed_kmh']:.0f} km/h, {span(entries)}: "
        if what == "none":
            found.append(head + f"the DLC rises by less than 10 % all over the bands (at most {percent(high)} over intact).")
        elif what == "all":
            found.append(head + f"the DLC rises all over the bands, by {percent(low)} to {percent(high)} over intact.")
        else:
            found.append(head + f"not decided by what is published: from {percent(low)} to {percent(high)} over intact, "
                         "by what becomes of the gas, by road, car and damper.")  # fmt: skip
    return found


def when(time: float) -> str:
    """The start [s] of the first window in which the damping is lost."""
    return "from the start" if time == 0 else f"after {time:.0f} s"


def of_time(block: dict[str, Any]) -> str:
    """When the damping is lost, with the default assumptions."""
    failed = [e for e in block["oil_levels"] if e["time_to_failure_s"] is not None]
    if not failed:
        return f"{block['speed_kmh']:.0f} km/h: the damper keeps more than half of the intact one's power at every level."
    times = ", ".join(f"{100 * e['oil_level']:.0f} % {when(e['time_to_failure_s'])}" for e in failed)
    return f"{block['speed_kmh']:.0f} km/h: half of the damper's power is lost at {times} (gas returns; windows of 10 s)."


def of_paper(block: dict[str, Any]) -> str:
    """The bare paper model and a scalar factor, at 60 % oil."""
    entry = next(e for e in block["oil_levels"] if e["oil_level"] == 0.6)
    over = [v / block["intact"]["dlc"] for v in (entry["dlc"], entry["bands"]["closure"]["letter"],
                                                 entry["scalar_factor"]["dlc"])]  # fmt: skip
    return (
        f"{block['speed_kmh']:.0f} km/h, 60 % oil: {percent(over[0])} with return of the gas, {percent(over[1])} with the "
        f"bare paper model, {percent(over[2])} with the oil level as a factor of the damper's fluid force."
    )


def sentences(result: dict[str, Any]) -> list[str]:
    """All of them."""
    found = [
        "Bands: five roads, every closure (what becomes of the gas), both ends of every assumed value, one at a time, "
        "closure and damping of the links together."
    ]
    for block in result["speeds"]:
        found += [*of_speed(block), of_time(block), of_paper(block)]
    shown, level = result["moments"]["moments"], 100 * result["moments"]["oil_level"]
    parts = [f"{100 * m['power_share']:.0f} % at {m['from_s']:.0f} s" for m in shown]
    found.append(
        f"{result['moments']['speed_kmh']:.0f} km/h, {level:.0f} % oil: the damper does {', '.join(parts)} of the "
        f"intact one's power; its oil goes from {shown[0]['oil_mL']:.0f} to {shown[-1]['oil_mL']:.0f} mL."
    )
    return found
