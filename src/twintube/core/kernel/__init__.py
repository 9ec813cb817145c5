"""The only source of the model's equations: typed plain Python, standard library only.

The interpreter runs it inside the Python FMU, C of it is compiled for records and swarms, and it is kept to a subset
(scalars, records, if/while, `math`) that translates to C. Numbers in comments such as "Eq. 22" are the paper's.

    prepare     what follows from the parameters            forces.py, prepare.py
    fill        the state at the start
    step        one time step                               step.py
    temper      factors at a temperature                    temperature.py
    rebound, compression: flows of all phases and k_degr    rebound.py, compression.py
"""

from twintube.core.kernel.compression import compression
from twintube.core.kernel.forces import fluid_force, stribeck
from twintube.core.kernel.prepare import fill, pour, prepare
from twintube.core.kernel.rebound import rebound
from twintube.core.kernel.step import step
from twintube.core.kernel.temperature import temper

__all__ = ["compression", "fill", "fluid_force", "pour", "prepare", "rebound", "step", "stribeck", "temper"]
