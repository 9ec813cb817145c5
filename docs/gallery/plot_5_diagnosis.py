"""
Diagnose the example dataset
============================

The package brings seven records of an SA8 on a simulated bench with something in them that the model leaves out.
The diagnosis names it, and predicts the records that it was not fitted to. This takes about half a minute of
processor time.
"""

from importlib.resources import files
from pathlib import Path

import matplotlib.pyplot as plt

from twintube import diagnose

folder = files("twintube.examples") / "bench_SA8"  # what `twintube example my_example` copies
answer = diagnose(Path(str(folder)))
print(answer.verdict, [hypothesis.name for hypothesis in answer.named])
for hypothesis in answer.changes.hypotheses[:3]:
    print(f"{hypothesis.probability:5.0%}  {hypothesis.name}")

# %%
# Every record predicted from all others: the error without the named cause and with it, and the noise.
figure, axes = plt.subplots(figsize=(9, 4))
at = range(len(answer.held_out))
axes.plot(at, [left.without for left in answer.held_out], "o", color="0.5", label="model as given")
axes.plot(at, [left.with_cause for left in answer.held_out], "s", color="tab:red", label="with the named cause")
axes.hlines(
    [left.noise for left in answer.held_out], [i - 0.3 for i in at], [i + 0.3 for i in at], color="tab:blue", label="noise"
)
axes.set_xticks(at, [left.record.replace("_", "\n") for left in answer.held_out])
axes.set(ylabel="force error, RMS [N]", ylim=(0, None))
figure.legend(loc="outside upper center", ncols=3)
