"""
Work over oil level and velocity
================================

How much work does a worn damper do? A loop over oil levels and velocities, the work of the first and the last of nineteen
oscillations from each result, and a pivot table. F-v curve and dead length of SA8 are *assumed*.
"""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from twintube import harmonic_block, load, simulate

damper = load("SA8")
rows = []
for velocity in (0.131, 0.524, 1.048):
    block = harmonic_block(velocity)
    for oil_level in (1.0, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3):
        worn = damper.with_(oil_level=oil_level, gas_preload=oil_level == 1.0)
        work = np.diff(simulate(worn, block).work[block.marks])  # [J] of each oscillation
        rows.append({"velocity": velocity, "oil": 100 * oil_level, "first": work[0], "last": work[-1]})
works = pd.DataFrame(rows).set_index(["oil", "velocity"])
print(works.unstack("velocity").round(1))

# %%
# Divided by the work of the intact damper, it shows what a scalar factor on the force, the usual shortcut, cannot: the loss
# depends on the velocity. Above the velocity of cavitation it also grows from oscillation to oscillation, as freed gas
# collects in the chambers.
share = 100 * works / works.xs(100.0, level="oil")
figure, axes = plt.subplots(1, 2, figsize=(9, 4), sharey=True)
for ax, which in zip(axes, ("first", "last"), strict=True):
    share[which].unstack("velocity").plot(ax=ax, marker="o", title=f"{which} oscillation", legend=False)
    ax.set(xlabel="oil [%]", ylabel="work over intact [%]", ylim=(0, None))
figure.legend([f"{v} m/s" for v in share.index.unique("velocity")], loc="outside upper center", ncols=3)
