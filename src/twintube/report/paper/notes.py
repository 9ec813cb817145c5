"""Names of assumed values and stand-ins, the same in pictures, page and JSON."""

from twintube.report.common.style import STAND_IN

FV = "F-v curve"
FRICTION = "friction"
GAS = "gas spring"
REACH = "maximum stroke"
BLOCKS = "block velocities"
DEAD = "dead length (calibrated)"
DRIVES = "strokes of the drives (quarter car, road, obstacles)"
HARMONIC = (FV, FRICTION, GAS, DEAD, REACH, BLOCKS)
SHAPES = (DEAD, REACH)
VIRTUAL = (STAND_IN,)


def lines(assumed: tuple[str, ...], stand_ins: tuple[str, ...] = (), model: str = "") -> list[str]:
    """The notes under a plot."""
    texts = [f"{text[0].upper()}{text[1:]}." for text in stand_ins]
    if model:
        texts.append(f"Model: {model}.")
    if assumed:
        texts.append(f"Assumed (unpublished): {', '.join(assumed)}.")
    return texts
