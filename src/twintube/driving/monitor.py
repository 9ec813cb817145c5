"""The answer of the monitor: for each damper a probability, a state, and what speaks for it."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from twintube.common.arrays import Array
from twintube.driving import plausible
from twintube.driving.channels import NAMES, PLACES
from twintube.driving.features import OF_A_WHEEL, OF_THE_BODY, minutes
from twintube.driving.model import FLEET, LIKELIER, REFERENCE, SIGNS, Model, sensors_of, shipped
from twintube.driving.sheet import NEEDED, SAME, length
from twintube.driving.signals import Signals
from twintube.driving.spectra import Spectra, coherence, density, spectra
from twintube.errors import InputError

REPLACE: Final = 0.99  # probability: of a hundred dampers replaced, one is good
FINE, UNCLEAR, WATCH, WORN_OUT = "fine", "cannot tell", "watch", "replace"
STATES: Final = {
    FINE: "damps more than 95 of 100 worn dampers, and is likelier good than worn: at most 50 %",
    UNCLEAR: "unlike the good and the worn dampers of the training, further off than 99 of 100 good ones; or between: more "
    "than 1 in 20 worn dampers and more than 1 in 100 good ones look the same; or by wheel speeds without references, which "
    "call nothing",
    WATCH: "damps less than 99 of 100 good dampers: above the limit",
    WORN_OUT: "has lost its damping: above the limit, and 99 % or more",
}


@dataclass(frozen=True)
class Watched:
    """What the monitor says of one damper."""

    place: str
    probability: float  # that it is worn [1], a worn one taken as likely as a good one before the drive
    limit: float  # that 1 in 100 good dampers passes; 1 where nothing is called
    damping: float  # damping ratio of wheel hop over that of the reference or the fleet
    parts: dict[str, float]  # what each feature adds to the log odds
    difference: dict[str, float]  # from what is usual
    distance: float = 0.0  # from all that was trained, in deviates of a normal distribution: below 0 it is usual
    far: float = np.inf  # that 1 in 100 good dampers passes
    fine: float = LIKELIER  # below it lie at most 1 in 20 worn dampers

    @property
    def unlike(self) -> bool:
        """Whether it is neither like the good dampers nor like the worn ones of the training."""
        return self.distance > self.far

    @property
    def state(self) -> str:
        """One of STATES."""
        if self.unlike:
            return UNCLEAR
        if self.probability < self.fine:
            return FINE
        if self.probability <= self.limit:
            return UNCLEAR
        return WORN_OUT if self.probability >= REPLACE else WATCH


@dataclass(frozen=True)
class Answer:
    """What the monitor says of a drive."""

    dampers: tuple[Watched, ...]
    way: str  # REFERENCE or FLEET
    sensors: str  # one of model.SETS
    seconds: float  # usable
    windows: int
    all_windows: int
    left_out: dict[str, int]
    speed: float  # [m/s] mean
    coherence: float  # front to rear, at wheel hop
    delay: tuple[float, float]  # [s] from front to rear wheels: by wheelbase over speed, and as seen
    frequency: Array  # [Hz]
    density: dict[str, Array]  # of the wheel speed over its mean, by place
    usual: dict[str, Array]  # the same of the reference; empty without one

    @property
    def worst(self) -> Watched:
        """The damper with the highest probability."""
        return max(self.dampers, key=lambda each: each.probability)

    @property
    def unlike(self) -> list[Watched]:
        """The dampers that are too far from the training to be judged."""
        return [each for each in self.dampers if each.unlike]

    def of(self, state: str) -> list[Watched]:
        """The dampers in a state."""
        return [each for each in self.dampers if each.state == state]

    @property
    def as_json(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "compared_with": self.way,
            "sensors": self.sensors,
            "usable_s": self.seconds,
            "windows": {"usable": self.windows, "all": self.all_windows, "left_out": self.left_out},
            "mean_speed_m_per_s": self.speed,
            "front_rear_coherence": self.coherence,
            "front_rear_delay_s": dict(zip(("expected", "seen"), self.delay, strict=True)),
            "dampers": {
                each.place: {
                    "name": NAMES[each.place].replace("wheel", "damper"),
                    "state": each.state,
                    "probability_worn": each.probability,
                    "limit": each.limit,
                    "fine_below": each.fine,
                    "distance": {"value": each.distance, "limit": each.far},
                    "damping_ratio_over_usual": each.damping,
                    "features": {
                        name: {
                            "meaning": meaning(name),
                            "factor_of_usual": float(np.exp(value)),
                            "adds_to_log_odds": each.parts.get(name, 0.0),
                        }
                        for name, value in each.difference.items()
                    },
                }
                for each in self.dampers
            },
        }


def meaning(name: str) -> str:
    """A feature in words."""
    sensor, _, what = name.partition("_")
    if name in OF_THE_BODY:
        return OF_THE_BODY[name]
    return f"{OF_A_WHEEL[what]}, by {'wheel speed' if sensor == 'speed' else 'wheel acceleration'}"


def prepared(signals: Signals, where: str = "") -> Spectra:
    """The spectra of a drive that can be judged; raises InputError that says `where` it lies."""
    try:
        for name in NEEDED:
            length(signals.car, name)
        plausible.check_channels(signals)
        some = spectra(signals)
        plausible.check_drive(some, signals)
    except InputError as error:
        raise InputError(f"{where}: {error}" if where else str(error)) from error
    return some


def check_same_car(car: dict[str, Any], other: dict[str, Any], where: str) -> None:
    """Raise InputError where the data sheets of a drive and its reference are those of two cars."""
    for name in NEEDED:
        if abs(float(other[name]) / float(car[name]) - 1.0) > SAME:
            raise InputError(
                f"{where}: car.{name} = {other[name]:g}: must be {car[name]:g} as in the drive, of the same car"
            )


def shown_at(frequency: Array, some: Spectra, place: str) -> Array:
    """The density of a wheel speed at the frequencies of another raster."""
    return np.interp(frequency, some.frequency, density(some.amplitude[f"speed_{place}"]), right=np.nan)


def watch(
    signals: Signals, references: Sequence[Signals] = (), names: Sequence[str] = (), model: Model | None = None
) -> Answer:
    """Judge the dampers of a drive against drives of the same car in its good state, else against the fleet.

    `names` are those of the drive and of the references, for messages. Raises InputError where a drive cannot be judged.
    """
    known = model or shipped()
    names = names or ["the drive", *(f"reference {i + 1}" for i in range(len(references)))]
    some = prepared(signals, names[0])
    others = [prepared(each, name) for each, name in zip(references, names[1:], strict=True)]
    for each, name in zip(references, names[1:], strict=True):
        check_same_car(dict(signals.car), dict(each.car), name)
    rows, usual = minutes(some), [minutes(other) for other in others]
    sensors = sensors_of([*rows, *(row for each in usual for row in each)])
    way = REFERENCE if usual else FLEET
    dampers = []
    for place in PLACES:
        difference = known.difference(rows, place, usual)
        table = known.table(way, sensors, place)
        dampers.append(
            Watched(
                place, table.probability(difference), table.limit, float(np.exp(difference.values["speed_damping"])),
                table.parts(difference), {name: difference.values[name] for name in SIGNS if name in difference.values},
                known.distance(way, sensors, place, difference), table.far, table.fine,
            )
        )  # fmt: skip
    expected = float(np.mean(some.delay))
    power = {place: density(some.amplitude[f"speed_{place}"]) for place in PLACES}
    beside = {
        place: np.mean([shown_at(some.frequency, each, place) for each in others], axis=0) for place in PLACES if others
    }
    return Answer(
        tuple(dampers), way, sensors, 2.0 * (len(some) + 1), len(some), some.all_windows, dict(some.left_out),
        float(np.mean(some.speed)), coherence(some, "speed"), (expected, expected / plausible.followed(some)),
        some.frequency, power, beside,
    )  # fmt: skip
