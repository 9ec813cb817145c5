"""
Diagnose the example dataset
============================

The package brings seven records of an SA8 on a simulated bench with something in them that the model leaves out.
The diagnosis names it, and predicts the records that it was not fitted to. This takes about half a minute of
processor time.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt

from twintube import diagnose
from twintube.lab.example import write

folder = Path(tempfile.mkdtemp())
write(folder)  # as `twintube example my_example` does

answer = diagnose(folder)
print(answer.sentence)
for name, probability in list(answer.probabilities.items())[:3]:
    print(f"{probability:5.0%}  {name}")

# %%
# The error of every record, before and after; squares are held-out records.
figure, axes = plt.subplots(figsize=(9, 4))
for i, result in enumerate(answer.records):
    marker = "s" if result.split == "heldout" else "o"
    axes.plot(i, result.rms(result.base), marker, color="0.5", label="base model" if i == 0 else None)
    axes.plot(i, result.rms(result.extended), marker, color="tab:red", label="with the named cause" if i == 0 else None)
    axes.hlines(result.noise, i - 0.3, i + 0.3, color="tab:blue", label="noise" if i == 0 else None)
axes.set_xticks(range(len(answer.records)), [Path(r.record.name).stem.replace("_", "\n") for r in answer.records])
axes.set(ylabel="force error, RMS [N]", ylim=(0, None))
figure.legend(loc="outside upper center", ncols=3)
