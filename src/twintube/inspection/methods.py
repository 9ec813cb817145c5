"""The inspection methods: what each figure is, its limit, where both come from and how sure that is."""

from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

from twintube.common.words import listed
from twintube.dampers import ParameterError
from twintube.inspection import tiring

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
        "smallest plate force of the coast over the static force", "%", 40.0, True,
        "EUSAMA: 6 mm peak to peak, up to 25 Hz; classes 0-20, 21-40, 41-60, above 60",
        "figure sure; the limit in use is 20 or 40",
    ),
    Method(
        "phase_shift", "minimum phase shift",
        "smallest angle by which the plate's force leads its height, from 2 Hz to the wheel's resonance",
        "deg", 35.0, True,
        "EGEA SPECSUS2018 after Tsymberov, SAE 960735 (public slides of 2017 and 2019)",
        "limit sure; the window is not published",
    ),
    Method(
        "damping_ratio", "damping ratio of the wheel",
        "Lehr's damping ratio, fitted around the wheel's resonance", "", 0.1, True,
        "in use beside EUSAMA; no primary source for 0.1",
        "unsure: neither figure nor limit is published; here a fit of a single mass",
    ),
    Method(
        "push_down", "push-down",
        "logarithmic decrement of the body after release", "", 1.4, True,
        "rocking by hand; half of the push left in the first swing",
        "in use, judged by eye; limit assumed",
    ),
    Method(
        "bump", "slow speed bump",
        "RMS of the axle's acceleration behind the bump, over the intact damper's",
        "", 2.0, False,
        "Schramm, Zwosta and Prokop, measurement 3 of Table 3 at 8 km/h",
        "a proposal; bump of 50 mm and limit assumed, so that about 5 % of intact dampers fail",
    ),
    Method(
        "tiring", "tiring of the damper",
        "RMS of the damper's velocity at 12 Hz: largest of the half seconds of 20 s over the first; "
        "plates of 6, 8 and 10 mm in turn",
        "", tiring.LIMIT, False,
        "proposed here; no tester has it",
        "unsure: rests on cavitation and its gas; limit: above what heat does to an intact damper whose force fades by "
        "0.3 to 0.6 % per kelvin",
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
