"""
A ride of the quarter car
=========================

The rear corner of a car of the Passat class on a class D road at 50 km/h, with SA8 intact, with half of its oil,
and with the oil level as a scalar factor on the force of the intact damper. The car's values are partly *assumed*.
"""

import matplotlib.pyplot as plt
import numpy as np

from twintube import load
from twintube.dampers.freed_gas import SCALAR, condition
from twintube.vehicle.cars import load_car
from twintube.vehicle.quarter_car import static_load
from twintube.vehicle.ride import measures, ride, track

damper, route = load("SA8"), track(speed_kmh=50, seconds=40)
corner = load_car("passat_b8").corner(damper)
runs = {
    "intact": ride(damper, corner, route),
    "scalar factor 0.5": ride(condition(damper, 0.5, 0, SCALAR), corner, route),
    "50 % oil, no preload": ride(condition(damper, 0.5, 0), corner, route),
}
dlc = {name: measures(run, corner)["dlc"] for name, run in runs.items()}

figure, (loads, shares) = plt.subplots(2, 1, figsize=(9, 6.5))
for (name, run), colour in zip(runs.items(), ("0.35", "tab:blue", "tab:red"), strict=True):
    part = (run.time >= 20) & (run.time < 23)
    loads.plot(run.time[part], 1e-3 * run.wheel_load[part], color=colour, label=f"{name}: DLC {dlc[name]:.2f}")
    load_over_static = np.sort(run.wheel_load[run.time >= 5] / static_load(corner))
    shares.plot(load_over_static, np.linspace(0, 100, len(load_over_static)), color=colour)
loads.set(xlabel="time [s]", ylabel="wheel load [kN]")
shares.set(xlabel="wheel load over static load [1]", ylabel="share of the time below [%]")
figure.legend(loc="outside upper center", ncols=3)

# %%
# The DLC is the standard deviation of the wheel load over the static load, from second 5 on. What becomes of the
# gas that cavitation frees is *assumed* (``dissolves``, see :doc:`/effects`).
