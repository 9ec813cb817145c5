"""The values of a search, generation by generation, in a file of JSON lines: a killed run resumes to its own result.

The optimiser repeats its own cheap moves and reads the expensive values from the journal, so that the result is that of an
uninterrupted run, whatever the optimiser.
"""

import hashlib
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from twintube.common.arrays import Array
from twintube.common.files import write_text

Objective = Callable[[Array], Array]


class Journal:
    """An objective that remembers its values in a file, and the best of them."""

    def __init__(self, objective: Objective, path: Path | None, progress: Callable[[float], None] | None) -> None:
        self.objective, self.path, self.progress = objective, path, progress
        self.known: list[dict[str, Any]] = []
        if path is not None:
            path.parent.mkdir(parents=True, exist_ok=True)
        if path is not None and path.exists():
            for line in path.read_text(encoding="utf-8").splitlines():
                try:
                    self.known.append(json.loads(line))
                except json.JSONDecodeError:
                    break  # the line that was being written when the run was killed
            write_text(path, "".join(json.dumps(entry) + "\n" for entry in self.known))
        self.generation = 0
        self.evaluations = 0
        self.x, self.error = np.array([]), np.inf
        self.trace: list[float] = []

    def __call__(self, X: Array) -> Array:
        """Values (m,) of a generation X (m, k)."""
        X = np.atleast_2d(X)
        digest = hashlib.sha256(np.ascontiguousarray(X).tobytes()).hexdigest()[:16]
        if self.generation < len(self.known) and self.known[self.generation]["x"] == digest:
            values = np.array(self.known[self.generation]["f"])
        else:
            del self.known[self.generation :]  # a journal of another run: what follows does not belong to this one
            values = self.objective(X)
            self.known.append({"x": digest, "f": values.tolist()})
            if self.path is not None:
                with self.path.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(self.known[-1]) + "\n")
        self.generation += 1
        self.evaluations += len(X)
        best = int(np.argmin(values))
        if values[best] < self.error:
            self.x, self.error = X[best].copy(), float(values[best])
        self.trace.append(self.error)
        if self.progress is not None:
            self.progress(self.error)
        return values
