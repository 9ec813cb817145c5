"""
A damper as a table
===================

``simulate`` takes a damper's name and a block of the paper's rig. Its result is a table: a row for each sample, with units.
Here the intact SA8 moves with up to 0.524 m/s, and then with half of its oil and no gas preload.
"""

import matplotlib.pyplot as plt
import pandas as pd

from twintube import harmonic_block, load, simulate

damper, block = load("SA8"), harmonic_block(velocity=0.524)
intact = simulate(damper, block)
worn = simulate(damper.with_(oil_level="50 %", gas_preload=False), block)
print(damper, block, intact, worn, sep="\n")

# %%
# The table of a result is indexed by time. ``units`` says what the columns are in.
frame = worn.to_dataframe()
print(frame[["stroke", "velocity", "force", "work"]].describe().round(3))
print({name: worn.units[name] for name in ("stroke", "velocity", "force", "work")})

# %%
# ``plot`` shows the whole: six slow oscillations first, as on the rig, then nineteen fast ones. Where a chamber holds gas,
# the force stays away until the gas is driven out.
worn.plot()

# %%
# Several dampers side by side are a matter of pandas: the last oscillation, with the stroke in mm. Rebound is up: stroke,
# velocity and force are positive when the rod goes out.
last = slice(block.time[block.marks[-2]], block.time[block.marks[-1]])
loops = pd.concat({"intact": intact.to_dataframe()[last], "50 % oil": frame[last]}, names=["state"])
figure, ax = plt.subplots(figsize=(6.5, 4))
for state, loop in loops.groupby("state", sort=False):
    ax.plot(1e3 * loop["stroke"], loop["force"], label=state)
ax.set(xlabel="stroke [mm]", ylabel="force [N]")
figure.legend(loc="outside upper center", ncols=2)
