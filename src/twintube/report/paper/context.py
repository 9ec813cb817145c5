"""Data of the figures: dampers, claims, loops of the model, records of the virtual rig, identified dampers."""

from collections.abc import Callable
from functools import cached_property
from pathlib import Path
from typing import Any

from twintube import dampers
from twintube.claims import EVALUATORS, Claim
from twintube.common.bars import Bar
from twintube.dampers import Damper
from twintube.provenance import fingerprint
from twintube.report.paper import fitted
from twintube.report.paper.records import Records, harmonic_jobs, slow_jobs
from twintube.rig.signals import BLOCKS


class Context:
    """Shared by the figures of one report, so that every result is computed once."""

    def __init__(self, folder: Path, *, quick: bool = True, processes: int | None = None) -> None:
        self.folder, self.quick = folder, quick
        self.records = Records(folder / "records", processes)
        self._claims: dict[str, Claim] = {}
        self._fits: dict[str, Damper] = {}

    @cached_property
    def dampers(self) -> dict[str, Damper]:
        """The eight named dampers with the published parameters of Table 9."""
        return {name: dampers.load(name, as_published=True) for name in dampers.names()}

    def claim(self, name: str) -> Claim:
        """The claim of `twintube.claims` with this id."""
        if name not in self._claims:
            evaluator: Callable[..., Claim] = next(e for e in EVALUATORS if e.__name__ == name.lower())
            self._claims[name] = evaluator(self.dampers)
        return self._claims[name]

    def fit(self, name: str) -> Damper:
        """The damper identified from the records of the virtual rig at the velocities common to all dampers."""
        if name not in self._fits:
            records = [self.records.get(job) for job in harmonic_jobs(name, BLOCKS)]
            slow = self.records.get(slow_jobs(name)[0])
            versions = f"{fingerprint(fitted.__name__)}_{fingerprint(Records.__module__)}"
            file = self.folder / "identified" / f"{name}-{versions}_{'quick' if self.quick else 'paper'}.toml"
            total = fitted.generations(self.quick)
            with Bar(total=total, unit="generation", desc=f"identify {name}", leave=False) as bar:

                def advance(title: str, error: float) -> None:
                    bar.set_postfix_str(f"{title}: {error:.1f}", refresh=False)
                    bar.update()

                self._fits[name] = fitted.fit(
                    self.dampers[name], slow, records, file=file, quick=self.quick, progress=advance
                )
        return self._fits[name]

    def published(self, name: str) -> Damper:
        """The published parameters of Table 9 with the F-v curve, friction and gas spring of the identified damper."""
        table = ("X_Re", "L_PV", "G_PV", "X_Co1", "X_Co2", "S_BV", "S_BVoil", "S_PV", "S_PVoil", "B", "E", "v_cav",
                 "Y_Co_cav", "Y_Re_cav")  # fmt: skip
        parameters = self.dampers[name].parameters
        values: dict[str, Any] = {item: getattr(parameters, item) for item in table}
        return self.fit(name).with_(**values)
