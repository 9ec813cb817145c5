"""The wordings of what is assumed and what stands in, used in pictures, page and JSON alike."""

from twintube.report.style import STAND_IN

FV = "F-v curve"
FRICTION = "friction"
GAS = "gas spring"
REACH = "maximum stroke"
BLOCKS = "block velocities"
DEAD = "dead length (calibrated)"
DRIVES = "strokes of the drives (quarter car, road, obstacles)"
VEHICLE = (FV, FRICTION, GAS, DEAD, REACH, DRIVES)
HARMONIC = (FV, FRICTION, GAS, DEAD, REACH, BLOCKS)
SHAPES = (DEAD, REACH)
VIRTUAL = (STAND_IN,)


def lines(assumed: tuple[str, ...], stand_ins: tuple[str, ...] = (), model: str = "") -> list[str]:
    """The small lines under a plot."""
    found = [f"{text[0].upper()}{text[1:]}." for text in stand_ins]
    if model:
        found.append(f"Model: {model}.")
    if assumed:
        found.append(f"Assumed (unpublished): {', '.join(assumed)}.")
    return found
