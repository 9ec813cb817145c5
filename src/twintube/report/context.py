"""What the figures draw from: dampers, claims, loops of the model, records of the virtual rig, identified dampers."""

from collections.abc import Callable
from functools import cached_property
from pathlib import Path
from typing import Any

from tqdm import tqdm

from twintube import dampers
from twintube.arrays import Array
from twintube.claims import EVALUATORS, Claim
from twintube.dampers import Damper
from twintube.engine.simulate import Simulation, simulate, work_between
from twintube.provenance import fingerprint
from twintube.report import fitted, records
from twintube.report.records import Records, harmonic_jobs, slow_jobs
from twintube.rig.plan import amplitude
from twintube.rig.signals import BLOCKS, Signal, harmonic_block

ONE, TOP, SLOW = 1.048, 1.572, 0.05  # the paper's "1 m/s", "1.6 m/s" and slowest block [m/s]


def state(damper: Damper, level: float) -> Damper:
    """The damper at an oil level, the gas preload lost unless full, as in the paper."""
    return damper.with_(oil_level=level, gas_preload=int(level >= 1.0))


def levels(damper: Damper) -> tuple[float, ...]:
    """Intact and the two measured degraded states."""
    return (1.0, *damper.measured_levels)


def block(damper: Damper, velocity: float) -> Signal:
    """A harmonic block of the damper; slow ones are sampled no more densely than 400 times per oscillation."""
    reach = amplitude(damper)
    return harmonic_block(velocity, reach, max(5e-4, 2 * 3.1416 * reach / velocity / 400))


def loop(damper: Damper, level: float, velocity: float) -> tuple[Signal, Simulation]:
    """The block and the model's answer."""
    signal = block(damper, velocity)
    return signal, simulate(state(damper, level), signal.stroke, signal.velocity)


def works(damper: Damper, level: float, velocity: float) -> Array:
    """Works [J] of the 19 oscillations."""
    signal = block(damper, velocity)
    return work_between(state(damper, level), signal.stroke, signal.velocity, signal.marks)


class Context:
    """Shared by the figures of one report, so that nothing is computed twice."""

    def __init__(self, folder: Path, *, quick: bool = True, processes: int | None = None, progress: bool = True) -> None:
        self.folder, self.quick, self.progress = folder, quick, progress
        self.records = Records(folder / "records", processes, progress)
        self._claims: dict[str, Claim] = {}
        self._fits: dict[str, Damper] = {}

    @cached_property
    def dampers(self) -> dict[str, Damper]:
        """The eight named dampers with the published parameters of Table 9."""
        return {name: dampers.load(name) for name in dampers.names()}

    def claim(self, name: str) -> Claim:
        """A claim of `twintube.claims`, by its id."""
        if name not in self._claims:
            evaluator: Callable[..., Claim] = next(e for e in EVALUATORS if e.__name__ == name.lower())
            self._claims[name] = evaluator(self.dampers)
        return self._claims[name]

    def fit(self, name: str) -> Damper:
        """The damper identified from the virtual rig's records at the velocities that all dampers have."""
        if name not in self._fits:
            records = [self.records.get(job) for job in harmonic_jobs(name, BLOCKS)]
            slow = self.records.get(slow_jobs(name)[0])
            kept = self.folder / "identified" / f"{name}-{self._key()}.toml"
            with tqdm(total=fitted.generations(self.quick), unit="generation", desc=f"identify {name}", leave=False,
                      disable=not self.progress) as bar:  # fmt: skip

                def advance(title: str, error: float) -> None:
                    bar.set_postfix_str(f"{title}: {error:.1f}", refresh=False)
                    bar.update()

                self._fits[name] = fitted.fit(
                    self.dampers[name],
                    (slow.stroke, slow.force),
                    [r for r in records if r.gas_preload],
                    [r for r in records if not r.gas_preload],
                    kept=kept,
                    quick=self.quick,
                    progress=advance,
                )
        return self._fits[name]

    def published(self, name: str) -> Damper:
        """The published parameters of Table 9 with the F-v curve, friction and gas spring of the identified damper."""
        table = ("X_Re", "L_PV", "G_PV", "X_Co1", "X_Co2", "S_BV", "S_BVoil", "S_PV", "S_PVoil", "B", "E", "v_cav",
                 "Y_Co_cav", "Y_Re_cav")  # fmt: skip
        named = self.dampers[name].parameters
        values: dict[str, Any] = {item: getattr(named, item) for item in table}
        return self.fit(name).with_(**values)

    def _key(self) -> str:
        return f"{fingerprint(fitted.__name__)}_{fingerprint(records.__name__)}_{'quick' if self.quick else 'paper'}"
