"""
Loops of worn dampers
=====================

Force over stroke and over velocity of SA8 with all oil, and without gas preload at 80 to 30 % of it: the last of
19 oscillations of 0.524 m/s. The block begins with six slow oscillations, as on the paper's rig.
"""

import matplotlib.pyplot as plt

from twintube import harmonic_block, load, simulate

damper, block = load("SA8"), harmonic_block(velocity=0.524)
last = slice(block.marks[-2], block.marks[-1] + 1)

figure, (over_stroke, over_velocity) = plt.subplots(1, 2, figsize=(9, 4), sharey=True)
for oil_level, preload in ((1.0, 1), (0.8, 0), (0.6, 0), (0.5, 0), (0.4, 0), (0.3, 0)):
    worn = damper.with_(oil_level=oil_level, gas_preload=preload)
    force = simulate(worn, block.stroke, block.velocity, block.time).force[last]
    label = "intact" if preload else f"{oil_level:.0%} oil"
    over_stroke.plot(1e3 * block.stroke[last], force, label=label, color=plt.cm.inferno(0.9 * (1 - oil_level)))
    over_velocity.plot(block.velocity[last], force, color=plt.cm.inferno(0.9 * (1 - oil_level)))
over_stroke.set(xlabel="stroke [mm]", ylabel="force [N]", title="F-s")
over_velocity.set(xlabel="velocity [m/s]", title="F-v")
figure.legend(loc="outside upper center", ncols=6)

# %%
# Rebound is up: stroke, velocity and force are positive when the rod goes out. Where a chamber holds gas the force
# collapses until the gas is driven out; with less oil that takes a longer way. At 80 % the oil fills both working
# chambers all the time: that loop differs from the intact one by the lost preload and by friction only.
