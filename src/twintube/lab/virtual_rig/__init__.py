"""A virtual damper rig with its own physics, independent of the model of `twintube`.

Pressures from oil and gas masses, turbulent orifices, check and blow-off valves, bubbles, Henry's law, oil temperature.
No equation and no value comes from `twintube`, so that the rig can contradict the model; both use published dimensions.
"""

from twintube.lab.virtual_rig.damper import VirtualDamper, virtual_damper
from twintube.lab.virtual_rig.records import DatasetRecord, Measured, measured, write_dataset
from twintube.lab.virtual_rig.rig import VirtualRecord, run

__all__ = [
    "DatasetRecord",
    "Measured",
    "VirtualDamper",
    "VirtualRecord",
    "measured",
    "run",
    "virtual_damper",
    "write_dataset",
]
