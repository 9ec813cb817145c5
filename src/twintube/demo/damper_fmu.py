"""Instances of FMUs of dampers."""

from pathlib import Path

from twintube.fmu.instance import Instance

INPUTS = ("stroke", "velocity")
OUTPUTS = ("force", "force_fluid", "force_friction", "force_gas", "work", "k_degr")
VOLUMES = tuple(f"V{chamber}.{phase}" for chamber in (1, 2, 3) for phase in ("oil", "gas", "foam"))


class DamperFmu(Instance):
    """The FMU of a damper initialised at stroke 0 with the given start values; raises FmuError."""

    def __init__(self, fmu: Path, **start_values: float) -> None:
        super().__init__(fmu, start_values, (*INPUTS, *OUTPUTS, *VOLUMES))
        self._inputs, self._force = self.buffer(*INPUTS), self.buffer("force")
        self._outputs, self._volumes = self.buffer(*OUTPUTS), self.buffer(*VOLUMES)

    def step(self, stroke: float, velocity: float, dt: float) -> float:
        """Force [N] after the step of `dt` [s] from `stroke` [m] at `velocity` [m/s]; raises FmuError if refused."""
        values = self._inputs[2]
        values[0] = stroke
        values[1] = velocity
        self.advance(self._inputs, dt)
        return self.read(self._force)[0]

    def outputs(self) -> dict[str, float]:
        """Forces [N], dissipated work [J] and k_degr after the last step."""
        return dict(zip(OUTPUTS, self.read(self._outputs), strict=True))

    def volumes(self) -> list[float]:
        """The nine phase volumes [m3] in the order of VOLUMES."""
        return list(self.read(self._volumes))
