"""The truths of other worlds in the form of truth.json that `worlds.scoring.truth` reads; what they tell beside it stays."""

from collections.abc import Mapping
from typing import Any, Final

from twintube.lab.blind_trials import trials
from twintube.lab.challenge.catalogue import CAUSES
from worlds.scoring.truth import OUTSIDE

ALSO_FITS: Final = {"oil_level_error": ("state",)}  # another fill than the file states, whatever it is called
FAULTS: Final = {name for name, cause in CAUSES.items() if cause.kind == "fault"} | {"time_base", "clamp_inertia"}
# Names of the first collection for what the others call differently.
FORMER_NAMES: Final = {"none_cut": "none", "sensor_saturation": "clipping"}


def kind_of(causes: list[str], outside: bool) -> str:
    """The kind of what is hidden: a pair, and other parameters of the model, are an effect unless all are faults."""
    if causes == ["none"]:
        return "none"
    if outside:
        return "outside"
    if causes == ["oil_level_error"]:
        return "state"
    return "fault" if set(causes) <= FAULTS else "effect"


def entry(
    world: str, seed: int, damper: str, causes: list[str], *, outside: bool, told: Mapping[str, Any]
) -> dict[str, Any]:
    """The entries of truth.json; `told` is the world's own truth, whose figures are taken over where they have the names."""
    kind = kind_of(causes, outside)
    return {
        **told, "world": world, "seed": seed, "damper": damper, "kind": kind,
        "causes": [OUTSIDE + name for name in causes] if outside else causes,
        "also_fits": [other for name in causes for other in ALSO_FITS.get(name, ())],
    }  # fmt: skip


def of_generator(world: str, told: Mapping[str, Any]) -> dict[str, Any]:
    """A truth of challenge or workshop."""
    return entry(world, told["seed"], told["damper"], list(told["causes"]), outside=told["kind"] == "outside", told=told)


def of_trial(trial: trials.Trial) -> dict[str, Any]:
    """The truth of a blind trial."""
    causes, outside = trial.kind.split("+"), trial.kind in trials.OUTSIDE
    told = {"parameters": trial.truth, "strength": trial.strength}
    return entry("blind_trials", trial.seed, trial.damper, causes, outside=outside, told=told)


def of_collection(world: str, told: Mapping[str, Any]) -> dict[str, Any]:
    """A truth of the collection of sixteen datasets, whose causes may have a rate behind an @."""
    name = str(told["cause"]).split("@", maxsplit=1)[0]
    name = FORMER_NAMES.get(name, name)
    outside = CAUSES[name].kind == "outside" if name in CAUSES else False
    return entry(world, -1, "", [name], outside=outside, told=told)
