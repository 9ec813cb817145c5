"""The inspection methods: what each figure is, its limit, where both come from and how sure that is."""

from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

from twintube.dampers import ParameterError
from twintube.inspection import tiring
from twintube.words import listed

EUSAMA_CLASSES = ((20.0, "poor"), (40.0, "weak"), (60.0, "fair"), (float("inf"), "good"))  # up to, and its name


@dataclass(frozen=True)
class Method:
    """One method; a figure on the wrong side of the limit fails."""

    name: str
    title: str
    figure: str  # what it is, in words
    unit: str
    limit: float
    low_fails: bool  # a figure below the limit fails, otherwise one above
    source: str
    certainty: str

    def passed(self, figure: float) -> bool:
        """Whether a damper with this figure passes."""
        return figure >= self.limit if self.low_fails else figure <= self.limit

    @property
    def rule(self) -> str:
        """The limit in words."""
        return f"fails {'below' if self.low_fails else 'above'} {self.limit:g}{' ' + self.unit if self.unit else ''}"


METHODS: Final = MappingProxyType({item.name: item for item in (
    Method(
        "eusama", "EUSAMA adhesion",
        "smallest vertical plate force of the coast over the static force, times 100", "%", 40.0, True,
        "EUSAMA recommendation: 6 mm peak to peak, up to 25 Hz; classes 0-20, 21-40, 41-60 and above 60",
        "figure sure; the limit in use is 20 or 40, and sources differ on the classes",
    ),
    Method(
        "phase_shift", "minimum phase shift",
        "smallest angle by which the plate force leads the plate's height, one per cycle, from 2 Hz to the wheel's "
        "resonance",
        "deg", 35.0, True,
        "EGEA SPECSUS2018 after Tsymberov, SAE 960735: fails below 35 deg between the resonances of body and wheel "
        "(public slides of 2017 and 2019)",
        "limit sure; how a tester finds the window is not published: the window is a reading, see those of other windows",
    ),
    Method(
        "damping_ratio", "damping ratio of the wheel",
        "Lehr's damping ratio at the wheel's resonance, fitted to the force of the cycles around it", "", 0.1, True,
        "used by testers beside EUSAMA; the limit 0.1 is quoted without a primary source",
        "unsure: neither the way to the figure nor the limit is published; here a fit of a single mass to the plate run",
    ),
    Method(
        "push_down", "push-down",
        "logarithmic decrement of the body per cycle after release, from the first swing beyond rest", "", 1.4, True,
        "rocking by hand; the limit is assumed: half of the push is left in the first swing beyond rest",
        "method old and still in use, judged by eye; limit assumed",
    ),
    Method(
        "bump", "slow speed bump",
        "root mean square of the axle's vertical acceleration behind the bump, over that of the intact damper",
        "", 2.0, False,
        "Schramm, Zwosta and Prokop, measurement 3 of Table 3 at 8 km/h, proposed there for inspection",
        "a proposal, in no regulation; bump of 50 mm assumed, limit assumed so that about 5 % of intact dampers fail",
    ),
    Method(
        "tiring", "tiring of the damper",
        "root mean square of the damper's velocity on a plate at 12 Hz: largest of the half seconds of 20 s over the first; "
        "plates of 6, 8 and 10 mm in turn",
        "", tiring.LIMIT, False,
        "proposed here; no tester has it",
        "unsure: rests on the speed of cavitation and on how much gas it frees; limit: above what the heat of the run does "
        "to an intact damper",
    ),
)})  # fmt: skip


# Those of `twintube inspect` where none is named: `tiring`, with two or three runs of 20 s for every damper, takes about as
# long as all others.
USUAL: Final = tuple(name for name in METHODS if name != "tiring")


def method(name: str) -> Method:
    """A method by its name; raises ParameterError."""
    if name not in METHODS:
        raise ParameterError(f"method {name}: must be one of {listed(METHODS)}")
    return METHODS[name]


def eusama_class(figure: float) -> str:
    """The class of a EUSAMA figure [%] in words."""
    return next(name for top, name in EUSAMA_CLASSES if figure <= top)
