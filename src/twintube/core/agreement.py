"""Whether a velocity belongs to its stroke: a rule of both kinds of FMU, of the car's roads and of `simulate`.

In the kernel's subset of Python, so that the native FMU and the library run the translation.

From one communication point to the next the stroke changes by the integral of the velocity. What the two differ by is summed
up as a way: an error of sign, unit or connection goes on growing with the stroke's way, those of right inputs do not.
"""

from dataclasses import dataclass

from twintube.core.variables import var

# Way [m] to each side that does not count: several times the resolution of a usual stroke sensor, so that noise,
# interpolation between samples and a delay of less than a sample are not taken for a way.
PLAY = 0.002
# Way [m] from which on a difference is worth a warning.
NOTABLE = 0.02
# Share of the way by which the two may part. A forgotten motion ratio, mostly 0.5 to 0.8, parts them by more, a turned sign
# by twice the way. A calibration is right within some hundredths, and straight lines between samples miss a fifth of a sine
# only where a period has hardly four of them.
SHARE = 0.2
# Way [m] at which half of all that was is forgotten, so that an error that comes late is found. It holds some swings of a
# car's body, over which motions too fast for the step (the wheel's at 40 ms) even out, and after that much way without a
# difference a jump of 30 mm still is the share that counts: 0.03 / SHARE - 0.03. A doubt of twice this way is forgotten too,
# as no difference could exceed it: after a long rest with noise the next motion counts.
REMEMBERED = 0.12
# A difference that no velocity [m/s] within the bounds of `Inputs` leads over in the step is a jump, whatever went before.
HIGHEST_SPEED = 20.0
# Above every number [SI] of a record: far more than the fastest motion goes in the longest step.
FARTHEST = 1e17


@dataclass(slots=True)
class Agreement:
    """How far stroke and velocity went and parted: `at_...` is the place within the play, `way_...` the way beyond it."""

    stroke: float = var("agreement", "", "m", "stroke at the last communication point", default=0.0)
    velocity: float = var("agreement", "", "m/s", "velocity at the last communication point", default=0.0)
    change: float = var("agreement", "", "m/s", "change of the velocity to there", default=0.0)
    step: float = var("agreement", "", "s", "length of the step from there", default=0.0)
    at_stroke: float = var("agreement", "", "m", "place of the stroke", default=0.0)
    at_led: float = var("agreement", "", "m", "place that the velocity led to", default=0.0)
    at_apart: float = var("agreement", "", "m", "difference of the two", default=0.0)
    way_stroke: float = var("agreement", "", "m", "way of the stroke", default=0.0)
    way_led: float = var("agreement", "", "m", "way that the velocity led", default=0.0)
    way_apart: float = var("agreement", "", "m", "way of their difference", default=0.0)
    doubt: float = var("agreement", "", "m", "way that the velocity's course between the points can hide", default=0.0)


def within_play(place: float) -> float:
    """The end of the play [m] where a place is beyond it, else the place."""
    if place > PLAY:
        return PLAY
    return -PLAY if place < -PLAY else place


def parted(a: Agreement, stroke: float, velocity: float, step: float) -> int:
    """1 where the ways up to this communication point do not belong together, else 0; `step` [s] is that to the next one.

    Where the velocity rises or falls all the way to the next point, the trapezoid misses at most half a step times its
    change. That covers a velocity that only comes with the first step, and one that is the mean of the coming step. Where it
    turns in between, the change itself changes.
    """
    way = stroke - a.stroke
    led = 0.5 * a.step * (a.velocity + velocity)
    jumped = abs(way - led) > NOTABLE + HIGHEST_SPEED * a.step
    change = velocity - a.velocity
    a.doubt += 0.5 * a.step * (abs(change) + abs(change - a.change))
    # What changes in no time, at the start or between two steps, says nothing of the course.
    a.change = change if a.step > 0.0 else 0.0
    a.stroke = stroke
    a.velocity = velocity
    a.step = step
    place = a.at_stroke + way
    a.at_stroke = within_play(place)
    a.way_stroke += abs(place - a.at_stroke)
    place = a.at_led + led
    a.at_led = within_play(place)
    a.way_led += abs(place - a.at_led)
    place = a.at_apart + way - led
    a.at_apart = within_play(place)
    a.way_apart += abs(place - a.at_apart)
    whole = max(a.way_stroke, a.way_led)
    if jumped or (whole >= NOTABLE and a.way_apart > a.doubt + SHARE * whole):
        return 1
    if whole > REMEMBERED or a.doubt > 2.0 * REMEMBERED:
        a.way_stroke *= 0.5
        a.way_led *= 0.5
        a.way_apart *= 0.5
        a.doubt *= 0.5
    return 0


def ways(a: Agreement) -> tuple[float, float, float]:
    """Of the stroke, that the velocity led, and of their difference [m], with what is within the play: for a message."""
    return a.way_stroke + abs(a.at_stroke), a.way_led + abs(a.at_led), a.way_apart + abs(a.at_apart)


def followed(a: Agreement) -> int:
    """1 where a restored record can come from following inputs, else 0."""
    if abs(a.at_stroke) > PLAY or abs(a.at_led) > PLAY or abs(a.at_apart) > PLAY:
        return 0
    if a.step < 0.0 or a.way_stroke < 0.0 or a.way_led < 0.0 or a.way_apart < 0.0 or a.doubt < 0.0:
        return 0
    sums = a.way_stroke + a.way_led + a.way_apart + a.doubt
    return 1 if abs(a.stroke) + abs(a.velocity) + abs(a.change) + a.step + sums < FARTHEST else 0
