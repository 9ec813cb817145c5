"""
A block of 19 oscillations
==========================

Above the velocity of cavitation the work falls from oscillation to oscillation, as freed gas collects in the
chambers. SA8 with 60 % of its oil, without gas preload, at 1.048 m/s, by the paper's equations alone.
"""

import matplotlib.pyplot as plt
import numpy as np

from twintube import harmonic_block, load, simulate

damper, block = load("SA8"), harmonic_block(velocity=1.048)
worn = simulate(damper.with_(oil_level=0.6, gas_preload=0), block.stroke, block.velocity)
intact = simulate(damper, block.stroke, block.velocity, block.time)

measured = slice(block.marks[0], block.marks[-1] + 1)
time = block.time[measured] - block.time[block.marks[0]]
work, intact_work = (np.diff(run.work[block.marks]) for run in (worn, intact))

figure, (forces, factor, bars) = plt.subplots(3, 1, figsize=(9, 7.5))
forces.plot(time, intact.force[measured], color="0.75", label="intact")
forces.plot(time, worn.force[measured], color="tab:red", label="60 % oil, no preload")
forces.set(ylabel="force [N]")
forces.legend(loc="upper center", ncols=2, bbox_to_anchor=(0.5, 1.22))
factor.plot(time, worn.k_degr[measured], color="tab:blue")
factor.set(xlabel="time in the block [s]", ylabel="k_degr [1]")
bars.bar(np.arange(1, 20), work / intact_work, color="tab:red")
bars.set(xlabel="oscillation", ylabel="work over intact [1]", xticks=range(1, 20))

# %%
# ``k_degr`` is the force of the fluid over that of the intact damper at the same velocity. A scalar factor, the usual
# shortcut, is one number for all of the picture.
first, last = work[[0, -1]] / intact_work[[0, -1]]
print(f"work over intact: {first:.2f} in the first oscillation, {last:.2f} in the last")
