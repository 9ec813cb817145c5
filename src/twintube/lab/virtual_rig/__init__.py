"""A virtual damper rig with physics of its own: the truth that is not the model of `twintube`.

Pressures from oil and gas masses, turbulent orifices, check and blow-off valves, bubbles, Henry's law, oil temperature.
Nothing comes from `twintube`, no equation and no value, so that it can contradict that model; both use published dimensions.
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
