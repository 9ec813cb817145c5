"""What `tiring` says of one damper beyond its figure: whether it can be judged, its runs, and what a rest brings back."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from twintube.dampers import Damper
from twintube.inspection.benches import Setting
from twintube.inspection.tiring import LIMIT, REST, RETURNED, Tired, not_judged, returned, runs, twice
from twintube.vehicle.quarter_car import Car

COMES_BACK = "oil loss: heat would have stayed"
STAYS = "heat, or freed gas that has not dissolved in the rest"


@dataclass(frozen=True)
class Watched:
    """One damper on the plates in turn, and rested where one tired it."""

    not_judged: Mapping[str, str]  # why, by way of the freed gas; empty where it is judged
    runs: tuple[Tired, ...]  # of the first way
    rested: Mapping[str, tuple[Tired, Tired]]  # by way: the run that tired it, and the one after the rest

    @property
    def as_json(self) -> dict[str, Any]:
        """For JSON, beside figure and verdict."""
        return {
            "not_judged": next(iter(self.not_judged.values())) or None,
            "not_judged_ways": {name: why for name, why in self.not_judged.items() if why},
            "runs": [
                {"amplitude_m": run.plate.amplitude, "peak_velocity_m_s": run.peak, "first_m_s": float(run.answer[0]),
                 "largest_m_s": float(run.answer.max()), "last_m_s": float(run.answer[-1]), "growth": run.growth,
                 "force_growth": run.force_growth,
                 "contact_lost_share": run.contact_lost, "work_J": run.work}
                for run in self.runs
            ],
            "after_rest": {
                "rest_s": REST,
                "freed_gas_ways": {
                    name: {"first_over_first": float(again.answer[0] / first.answer[0]),
                           "returned_share": returned(first, again), "says": says(first, again)}
                    for name, (first, again) in self.rested.items()
                },
            },
        }  # fmt: skip


def says(first: Tired, again: Tired) -> str:
    """What the rest tells."""
    return COMES_BACK if returned(first, again) > RETURNED else STAYS


def watched(by_way: Mapping[str, Damper], car: Car, setting: Setting, dt: float) -> Watched:
    """The damper as each way of the freed gas makes it; raises InputError if a piston leaves its tube."""
    found = {name: runs(damper, car, setting.shaker, dt, fade=setting.fade) for name, damper in by_way.items()}
    first = next(iter(by_way))
    rested = {
        name: twice(by_way[name], car, several[-1].plate, dt, setting.fade)
        for name, several in found.items()
        if several[-1].growth > LIMIT
    }
    why = {name: not_judged(by_way[name], car, several, dt) for name, several in found.items()}
    return Watched(why, tuple(found[first]), rested)
