"""
A EUSAMA plate bench
====================

The rear corner on a plate that shakes it with 6 mm from 25 Hz down: the smallest force on the plate, while it
coasts to rest, over the static one is the EUSAMA figure. Beside it stands that of a damper whose force is scaled
by the oil level.
"""

import matplotlib.pyplot as plt
import numpy as np

from twintube import load
from twintube.inspection import INTACT, METHODS, Condition, Plate
from twintube.inspection.benches import DT, on_plate, plate_motion
from twintube.inspection.corner import inspected
from twintube.vehicle.cars import load_car
from twintube.vehicle.quarter_car import static_load

damper, car = load("SA8"), load_car("passat_b8")
corner, motion = car.corner(damper), plate_motion(Plate(), DT)

figure, (shaken, verdicts) = plt.subplots(1, 2, figsize=(10, 4.2), width_ratios=(3, 2))
for state, label, colour in ((INTACT, "intact", "0.35"), (Condition(0.5, 0), "50 % oil, no preload", "tab:red")):
    run = on_plate(state.applied(damper), corner, motion)
    shaken.plot(run.time, 100 * run.wheel_load / static_load(corner), color=colour, label=label, lw=0.5)
shaken.set(xlabel="time on the plate [s]", ylabel="wheel load over static load [%]")
for line in shaken.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2).get_lines():
    line.set_linewidth(2)

levels = np.array([1.0, 0.8, 0.6, 0.5, 0.4, 0.3])
states = [Condition(level, int(level == 1.0)) for level in levels]
entries = inspected(damper, car, states, ("eusama",))
verdicts.plot(100 * levels, [entry.figure for entry in entries], "o-", color="tab:red", label="full model")
verdicts.plot(100 * levels, [entry.scalar_figure for entry in entries], "s:", color="tab:blue", label="scalar factor")
verdicts.axhline(METHODS["eusama"].limit, color="0.35", lw=1, ls="--", label="limit")
verdicts.set(xlabel="oil [%]", ylabel="EUSAMA [%]")
verdicts.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)

# %%
# The bench sees nothing before the force collapses on it, see :doc:`/inspection`. Limits differ between sources;
# 40 % is used here.
