"""
A ride of the whole car
=======================

Four dampers, each with its own state, on two road tracks of class D at 80 km/h: the rear dampers have half of
their oil. Inertias, roll centres, anti-roll bars and tyres are those of other cars or *assumed*, see :doc:`/car`.
"""

import matplotlib.pyplot as plt
import numpy as np

from twintube import load
from twintube.dampers.freed_gas import condition
from twintube.vehicle.cars import load_car
from twintube.vehicle.full.car import WHEELS
from twintube.vehicle.full.figures import ride_figures
from twintube.vehicle.full.maneuvers import Road, ride
from twintube.vehicle.full.run import full_car

front, rear = condition(load("SA7"), 1.0, 1), load("SA8")
figures, runs = {}, {}
for name, state in {"intact": condition(rear, 1.0, 1), "rear: 50 % oil, no preload": condition(rear, 0.5, 0)}.items():
    car = full_car(load_car(), [front, front, state, state])
    runs[name] = ride(car, 80.0, 30.0, Road("D", seed=1))
    figures[name] = ride_figures(car, runs[name])

figure, (loads, bars) = plt.subplots(2, 1, figsize=(9, 6.5))
place = np.arange(len(WHEELS))
for i, (name, run) in enumerate(runs.items()):
    part, colour = (run.time >= 20) & (run.time < 23), ("0.35", "tab:red")[i]
    loads.plot(run.time[part], 1e-3 * run.load[part, WHEELS.index("rear_left")], color=colour, label=name)
    bars.bar(place + 0.4 * i - 0.2, [figures[name]["dlc"][wheel] for wheel in WHEELS], 0.38, color=colour)
loads.set(xlabel="time [s]", ylabel="load of the rear left wheel [kN]")
bars.set_xticks(place, [wheel.replace("_", " ") for wheel in WHEELS])
bars.set(ylabel="DLC [1]")
figure.legend(loc="outside upper center", ncols=2)

# %%
# Comfort is the weighted vertical acceleration of ISO 2631-1.
for name, values in figures.items():
    print(f"{name}: comfort {values['comfort_m_s2']:.2f} m/s2, pitch {values['pitch_rms_deg']:.2f} deg (RMS)")
