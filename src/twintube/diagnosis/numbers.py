"""The numbers of the method: priors in physical units and numerics, each with unit, meaning and source.

None of them is a threshold. The verdict follows from the posterior; what stands here is what is known before the data.
"""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, fields
from typing import Any, TypeVar

T = TypeVar("T")


def declared(value: T, unit: str, meaning: str, source: str, most: float = math.inf) -> Any:
    """A number of the method with what a reader must know of it."""
    return field(default=value, metadata={"unit": unit, "meaning": meaning, "source": source, "most": most})


@dataclass(frozen=True)
class Numbers:
    """All numbers of the method; those in force are `numbers()`."""

    # The model's own error D
    law_sizes: tuple[float, ...] = declared(
        (0.0, 0.005, 0.01, 0.02, 0.04, 0.08, 0.16),
        "1",
        "sizes of D tried, share of the fluid force",
        "quadrature over the prior",
    )
    law_usual: float = declared(
        0.03, "1", "scale of the half-normal prior of that size", "production tolerance of dampers, +-5 to 10 % of the force"
    )
    law_octaves: float = declared(1.5, "1", "octaves of speed over which D is alike", "a valve has two or three regimes")
    law_whole: float = declared(
        2.0, "1", "D at all speeds alike, over its share within octaves", "tolerance: level 5 to 10 %, shape some per cent"
    )
    law_knee: float = declared(0.5, "1", "share of D within an octave", "the knee of a blow-off")
    law_stroke: float = declared(
        0.5, "1", "share of D that goes with the stroke", "guides and seals are alike along the tube"
    )
    law_lags: tuple[float, ...] = declared(
        (5e-4, 2e-3), "s", "lags of a damper 3 % off its law, each by its own share", "compressible oil and valves, judged"
    )
    law_late: float = declared(0.01, "1", "size of D with which such a lag goes", "hysteresis shows in every real damper")
    law_ways: tuple[float, ...] = declared(
        (1e-3, 5e-3), "m", "strokes over which its force builds up", "check valves close within millimetres, judged"
    )
    loss: float = declared(
        0.3,
        "1",
        "loss of force where oil is missing, off that of the model",
        "scatter of Table 9 between dampers of one kind",
    )
    rubbing: float = declared(0.5, "1", "friction of a damper off that of its set", "seals differ and wear, side load")
    side: float = declared(
        0.02, "1", "further friction, share of the largest force", "side load on the bench, tens of newtons"
    )
    preload: float = declared(0.1, "1", "gas force of a damper off that of its set", "filling tolerance, 20 K")
    own_sizes: tuple[float, ...] = declared(
        (0.0, 0.001, 0.003, 0.01, 0.03), "1", "sizes of a record's own error tried, share of the fluid force", "quadrature"
    )
    own_usual: float = declared(
        0.005, "1", "scale of the half-normal prior of that size", "repeatability of a bench between set-ups"
    )
    lasting_sizes: tuple[float, ...] = declared(
        (0.0, 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3),
        "1",
        "sizes of an error that lasts tried, share of the intact fluid force",
        "quadrature",
    )
    placed: float = declared(
        10.0,
        "1",
        "what lasts is larger where force is lost or comes back, per share of the step",
        "steps are placed to millimetres, judged",
    )
    timed: float = declared(
        0.01,
        "s",
        "what lasts is larger where the force is steep: 0.1 ms at a size of 1 %",
        "clocks and filters of two channels, judged",
    )
    lasting_usual: float = declared(
        0.02, "1", "scale of the half-normal prior of that size", "what moves with steps of the model: some per cent"
    )
    law_of_cause: float = declared(
        0.2, "1", "what a cause does, off its law", "the like of the loss by missing oil; a fifth, judged"
    )
    cause_ways: tuple[float, ...] = declared(
        (3e-4, 1e-3, 4e-3, 1.2e-2), "m", "strokes by which a cause may come later than by its law", "those of valves, judged"
    )
    cause_lags: tuple[float, ...] = declared((1e-3, 5e-3), "s", "times by which it may come later", "the like, judged")
    freedom: float = declared(
        4.0, "1", "degrees of freedom of Student's noise", "usual for heavy tails: Lange, Little and Taylor 1989"
    )
    lacking: float = declared(
        0.5, "1", "probability that a damper or its bench always has something that the model lacks", "judged", most=0.99
    )
    # What may have happened
    unchanged: float = declared(0.5, "1", "probability that nothing has happened", "judged", most=0.99)
    two: float = declared(0.1, "1", "probability that two causes act, where any does", "judged", most=0.99)
    other: float = declared(0.05, "1", "probability of something that is not in the catalogue", "judged", most=0.99)
    change_sizes: tuple[float, ...] = declared(
        (0.01, 0.03, 0.1, 0.3), "1", "sizes of a free change tried, share of the fluid force", "each as likely"
    )
    slight: float = declared(
        0.05,
        "1",
        "force of a cause over the noise, or over the largest one, below which it stands in the budget alone",
        "convention",
    )
    credible: float = declared(
        0.9, "1", "probability that the hypotheses in an answer hold together", "convention", most=0.99
    )
    implausible: float = declared(
        0.01,
        "1",
        "chance of a size of the model's errors below which a hypothesis that needs it is no answer",
        "convention",
        most=0.99,
    )
    # The bench
    zero: float = declared(0.002, "1", "zero of a record, share of the largest force", "load cell, 0.2 % of full scale")
    tared: float = declared(
        0.1,
        "1",
        "probability that the load cell was set to zero with the damper in it",
        "as often as a fill is misstated; judged",
        most=0.99,
    )
    gain: float = declared(0.005, "1", "gain of a record", "load cell of class 0.5")
    late: float = declared(2e-4, "s", "delay of the force channel", "filters of a measuring amplifier at 1 to 2 kHz")
    skew: float = declared(
        0.1, "1", "delay of the force channel, share of a sample", "converters that read one channel after the other, judged"
    )
    begun: float = declared(
        0.02, "1", "fluid force of a record at the temperature it begins with", "some kelvins at 0.3 %/K"
    )
    filtered: float = declared(0.1, "1", "bend of the force in a sample", "anti-alias filter near the sampling rate")
    model_noise: float = declared(
        1e-3, "1", "white error of the model, share of the largest force", "interval means against the trapezoidal rule"
    )
    # The state
    level_tolerance: float = declared(
        0.015, "1", "oil level read off the steps of the force", "dead length to 2 mm, oil filled to 1 %"
    )
    full: float = declared(
        0.25, "1", "probability that a damper whose fill nobody knows has lost no oil", "judged", most=0.99
    )
    leaking: float = declared(
        0.1,
        "1",
        "probability that a damper whose fill nobody knows has lost a part of its gas; all or none of it are as likely",
        "as often as a fill is misstated; judged",
        most=0.99,
    )
    misstated: float = declared(
        0.1,
        "1",
        "probability that a fill is not as the file says",
        "oil is lost unseen, labels are mixed up; judged",
        most=0.99,
    )
    degraded: float = declared(
        0.003,
        "1",
        "white error where states are compared, share of the largest force",
        "with oil missing the paper's model is up to 10 % off its measurement (Fig. 33)",
    )
    level_low: float = declared(0.2, "1", "least oil level sought", "below it no damper works", most=0.99)


class InForce:
    """The numbers that the diagnosis has now."""

    now = Numbers()


def numbers() -> Numbers:
    """Those in force: the usual ones, or what `priors` has put in their place."""
    return InForce.now


@contextmanager
def in_force(other: Numbers) -> Iterator[None]:
    """Within it the diagnosis of the whole process has other numbers."""
    before, InForce.now = InForce.now, other
    try:
        yield
    finally:
        InForce.now = before


def listed() -> list[dict[str, Any]]:
    """Name, value, unit, meaning and source of all numbers."""
    return [
        {
            "name": item.name,
            "value": getattr(numbers(), item.name),
            **{k: item.metadata[k] for k in ("unit", "meaning", "source")},
        }
        for item in fields(Numbers)
    ]
