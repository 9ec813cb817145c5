"""
Build an FMU and run it
=======================

SA8 as a native FMI 2.0 FMU, driven by fmpy through slow oscillations and then faster ones, with two sets of start
values.
"""

import tempfile
from pathlib import Path

import fmpy
import matplotlib.pyplot as plt
import numpy as np

from twintube import build_fmu

# %%
# The build compiles nothing and downloads nothing: the package has the libraries. Here it takes that of the
# present platform only; by default all that there are.
folder = Path(tempfile.mkdtemp())
fmu = build_fmu("SA8", folder, platforms=[fmpy.platform])

# %%
# Inputs are stroke and velocity at the start of a communication step. Six slow oscillations come first: a degraded
# damper must be preconditioned before its force means anything.
AMPLITUDE, STEP = 0.03, 1e-3  # [m], [s]
time = np.arange(0, 30, STEP)
frequency = np.where(time < 24, 0.25, 3.0)  # [Hz]
angle = np.concatenate([[0.0], np.cumsum(2 * np.pi * frequency[:-1] * STEP)])
stroke = AMPLITUDE * np.sin(angle)
velocity = np.gradient(stroke, STEP)
given = np.array(list(zip(time, stroke, velocity, strict=True)), dtype=[(n, float) for n in ("time", "stroke", "velocity")])


def run(**start_values: float) -> np.ndarray:
    """Force and degradation factor over time, from these start values."""
    return fmpy.simulate_fmu(
        str(fmu),
        input=given,
        output=["force", "k_degr"],
        start_values=start_values,
        output_interval=STEP,
        stop_time=time[-1],
    )


intact, worn = run(), run(oil_level=0.5, gas_preload=0)

figure, (forces, factor) = plt.subplots(2, 1, figsize=(9, 5.5), sharex=True)
for result, label, colour in ((intact, "intact", "0.35"), (worn, "50 % oil, no preload", "tab:red")):
    part = result["time"] > 23.5
    forces.plot(result["time"][part], result["force"][part], label=label, color=colour)
    factor.plot(result["time"][part], result["k_degr"][part], color=colour)
forces.set(ylabel="force [N]")
factor.set(xlabel="time [s]", ylabel="k_degr [1]")
figure.legend(loc="outside upper center", ncols=2)
