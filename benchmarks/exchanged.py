"""`python -m benchmarks.exchanged`: how often the monitor refuses drives as they are, and with exchanged channels.

The drives are those of random cars, half with four good dampers and half with what the study draws. Every exchange of two
wheels, of left and right and of front and rear is made in the wheel speeds, in the wheel accelerations and in both.
"""

import json
import re
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Annotated, Any, Final

import typer
from tqdm import tqdm

from twintube.cli.base import standalone
from twintube.driving import plausible
from twintube.driving.channels import PLACES, channel_name
from twintube.driving.draws import PER_CAR, REFERENCES, draw
from twintube.driving.drives import driven
from twintube.driving.scenes import scene
from twintube.driving.signals import Signals
from twintube.driving.spectra import SENSORS, Spectra, spectra
from twintube.errors import InputError

SEED: Final = 9001  # of the cars and drives; no other study has it
# The names of the wheels whose channels a wheel gets, in the order of PLACES.
EXCHANGES: Final = {
    "fl and fr": ("fr", "fl", "rl", "rr"),
    "rl and rr": ("fl", "fr", "rr", "rl"),
    "fl and rl": ("rl", "fr", "fl", "rr"),
    "fr and rr": ("fl", "rr", "rl", "fr"),
    "fl and rr": ("rr", "fr", "rl", "fl"),
    "fr and rl": ("fl", "rl", "fr", "rr"),
    "left and right": ("fr", "fl", "rr", "rl"),
    "front and rear": ("rl", "rr", "fl", "fr"),
}
WHICH: Final = {"wheel speeds": ("speed",), "wheel accelerations": ("accel",), "both": SENSORS}


def exchanged(signals: Signals, some: Spectra, order: tuple[str, ...], sensors: tuple[str, ...]) -> tuple[Signals, Spectra]:
    """A drive whose wheels have the channels of others."""
    pairs = [(sensor, place, other) for sensor in sensors for place, other in zip(PLACES, order, strict=True)]
    values = {channel_name(sensor, place): signals.values[channel_name(sensor, other)] for sensor, place, other in pairs}
    amplitude = {f"{sensor}_{place}": some.amplitude[f"{sensor}_{other}"] for sensor, place, other in pairs}
    return (
        replace(signals, values={**signals.values, **values}),
        replace(some, amplitude={**some.amplitude, **amplitude}),
    )


def answer(signals: Signals, some: Spectra) -> str:
    """Why the monitor refuses a drive: the beginning of the reason; empty where it judges."""
    try:
        plausible.check_units(signals)
        plausible.check_drive(some, signals)
    except InputError as error:
        return str(error)
    return ""


def reason(text: str, channels: set[str]) -> str:
    """A refusal in words, and of exchanged `channels` whether they are those that are named."""
    if not text:
        return "judged"
    if "exchanged" not in text:
        return next((kind for kind in ("too smooth", "too short", "unrelated") if kind in text), "another")
    named = set(re.findall(r"wheel_(?:speed|accel)_\w+", text))
    return f"exchanged, {'these' if named == channels else 'these or others' if named > channels else 'others'} named"


def without_accelerations(signals: Signals) -> Signals:
    """What the bus of most cars shows."""
    return replace(signals, values={name: each for name, each in signals.values.items() if "wheel_accel" not in name})


def of_a_drive(seconds: float, number: int) -> Counter[tuple[str, str, str, str]]:
    """Of one drive: by sensors, what is exchanged, in which order, and what the monitor says."""
    found: Counter[tuple[str, str, str, str]] = Counter()
    drawn = draw(number, seconds, SEED)
    try:
        whole = driven(scene(drawn.vehicle, drawn.conditions, drawn.wear))
        plausible.check_turns(whole)
    except InputError as error:
        return Counter({("all", "none", "none", f"not driven: {str(error)[:40]}"): 1})
    for have, change in (("with accelerations", identity), ("wheel speeds alone", without_accelerations)):
        signals = change(whole)
        some = spectra(signals)
        said = reason(answer(signals, some), set())
        found[have, "nothing", "as named", said] += 1
        if said != "judged":
            continue
        for which, sensors in WHICH.items():
            if have == "with accelerations" or sensors == ("speed",):
                for name, order in EXCHANGES.items():
                    text = answer(*exchanged(signals, some, order, sensors))
                    channels = {
                        channel_name(sensor, place)
                        for sensor in sensors
                        for place, other in zip(PLACES, order, strict=True)
                        if place != other
                    }
                    found[have, which, name, reason(text, channels)] += 1
    return found


def identity(signals: Signals) -> Signals:
    """A drive as it is."""
    return signals


def numbers(drives: int) -> Iterator[int]:
    """Of each car a drive with four good dampers, then one as the study draws it."""
    for i in range(drives):
        car, second = divmod(i, 2)
        yield car * PER_CAR + REFERENCES * second


def main(
    drives: Annotated[int, typer.Option(metavar="N", min=1, help="Drives, two of each car.")] = 100,
    seconds: Annotated[float, typer.Option(metavar="S", min=30.0, help="Length of a drive.")] = 60.0,
    processes: Annotated[int, typer.Option(metavar="N", min=1)] = 1,
    json_file: Annotated[Path | None, typer.Option("--json", metavar="FILE", help="Write all figures to this file.")] = None,
) -> None:
    """Exchange channels, and count what the monitor says."""
    total: Counter[tuple[str, str, str, str]] = Counter()
    task: Callable[[int], Counter[tuple[str, str, str, str]]] = partial(of_a_drive, seconds)
    with ProcessPoolExecutor(processes) as pool:
        for each in tqdm(pool.map(task, numbers(drives)), total=drives, unit="drive"):
            total += each
    rows: list[dict[str, Any]] = [
        dict(zip(("sensors", "exchanged", "order", "said"), key, strict=True)) | {"drives": count}
        for key, count in sorted(total.items())
    ]
    if json_file is not None:
        json_file.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    for row in rows:
        typer.echo("  ".join(map(str, row.values())))


if __name__ == "__main__":
    standalone(main)()
