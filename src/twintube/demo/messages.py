"""What each picture says, as a sentence with the figures of the run."""

from itertools import takewhile
from typing import Any

from twintube.demo.style import drawn
from twintube.demo.words import NO_RISE, percent, verdict
from twintube.report.common.framed import oil
from twintube.vehicle.ride import WINDOW

Span = tuple[float, float]


def over_oil_level(result: dict[str, Any]) -> str:
    """From which oil level down the wheel load fluctuates more under every assumption, and how much."""
    name = result["damper"]
    upwards = zip(*(reversed(block["oil_levels"]) for block in result["speeds"]), strict=True)
    sure = list(takewhile(lambda entries: all(verdict(e) == "all" for e in entries), upwards))
    if not sure:
        return f"At no oil level does {name} raise the wheel-load fluctuation by more than {percent(NO_RISE)} in every case"
    bands = [e["bands"]["all_over_intact"] for entries in sure for e in entries]
    least, most = (percent(share).removeprefix("+") for share in (min(b[0] for b in bands), max(b[1] for b in bands)))
    return (
        f"With {oil(sure[-1][0]['oil_level'])} and less, {name} lets the wheel load fluctuate "
        f"{least.removesuffix(' %')} to {most} more than intact, over the shaded band"
    )


def development(result: dict[str, Any]) -> str:
    """When the damping power is first below half, at the highest oil level at which it ever is."""
    name, block = result["damper"], result["speeds"][-1]
    speed = f"at {block['speed_kmh']:.0f} km/h"
    lost = next((e for e in drawn(block) if e["time_to_failure_s"] is not None), None)
    if lost is None:
        return f"{name} keeps more than half of its damping power for {result['seconds']:.0f} s {speed} at every level drawn"
    return (
        f"{speed[0].upper()}{speed[1:]}, {name} with {oil(lost['oil_level'])} has less than half of the intact damping "
        f"power for the first time {window(lost['time_to_failure_s'])}"
    )


def window(start: float) -> str:
    """The window that begins at a time [s] of the ride."""
    return f"between {start:.0f} and {start + WINDOW:.0f} s"


def failure(result: dict[str, Any]) -> str:
    """What the freed gas does to the time until the damping is lost, for the ride that is shown in detail."""
    table, shown = result["time_to_failure"], result["moments"]
    row, column = table["speeds_kmh"].index(shown["speed_kmh"]), table["oil_levels"].index(shown["oil_level"])
    found = [rows[row][column] for rows in table["freed_gas_ways"].values()]
    times = [f"not within {table['seconds']:.0f} s" if t is None else window(t) for t in found]
    where = f"{result['damper']} with {oil(shown['oil_level'])} at {shown['speed_kmh']:.0f} km/h"
    lost = f"{where} first has less than half of the intact damping power"
    if len(set(times)) == 1:
        return f"{lost} {times[0]}, whatever the freed gas does"
    return f"{lost} {', '.join(times[:-1])} or {times[-1]}: the freed gas decides"


def bands(bars: dict[float, dict[str, Span]], speed: float) -> str:
    """Which assumption moves the rise most, and how far; `bars` are DLC over intact [1] by oil level and assumption."""
    every = [(level, name, ends) for level, row in bars.items() for name, ends in row.items()]
    level, name, (low, high) = max(every, key=lambda item: item[2][1] - item[2][0])
    return (
        f"Most depends on {name}: with {oil(level)} at {speed:.0f} km/h the rise of the DLC "
        f"lies anywhere between {percent(low)} and {percent(high)}"
    )


def off_road(shares: Span, where: str) -> str:
    """For how much of the ride the wheel is in the air; `shares` [1] of the lossy and the intact damper."""
    lossy, intact = (f"{100 * share:.1f} %" for share in shares)
    return f"{where}: the wheel is off the road for {lossy} of the ride, for {intact} with the intact damper"


def loops(powers: list[float], where: str) -> str:
    """How the damper's power over that of the intact one [1] falls."""
    first, *rest = (f"{100 * power:.0f} %" for power in powers)
    return f"{where}: the damping power falls from {first} of the intact damper's to {' and '.join(rest)}"


def volumes(gas: Span, where: str) -> str:
    """How much of the working chambers gas and foam fill [1], in the first and the last window."""
    first, last = (f"{100 * share:.0f} %" for share in gas)
    return f"{where}: gas and foam fill {first} of the working chambers in the first {WINDOW:.0f} s, {last} in the last"


def spectrum(grown: list[tuple[str, float, float]], where: str) -> str:
    """How the resonances grow: name, frequency [Hz] and density over that of the intact damper at that frequency [1]."""
    (body, low, at_body), (wheel, high, at_wheel) = grown
    return (
        f"{where} has {short(at_body)} times the wheel-load density of intact at {low:.3g} Hz, the resonance of its {body}, "
        f"and {short(at_wheel)} times at {high:.3g} Hz, that of its {wheel}"
    )


def short(number: float) -> str:
    """A number with two significant digits."""
    return f"{float(f'{number:.2g}'):g}"
