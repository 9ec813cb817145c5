"""Short communication steps: the share whose force lies beyond those of the steps around it, over step, noise and oil."""

import tempfile
from pathlib import Path

import fmpy
import numpy as np
from tqdm import tqdm

from twintube.dampers import load, names
from twintube.demo.damper_fmu import DamperFmu
from twintube.fmu import build_fmu

AMPLITUDE, FREQUENCY = 0.04, 1.5  # [m], [Hz]
USUAL = 1e-3  # [s]
SHORT = (0.0, 1e-6, 3e-6, 1e-5, 5e-5, 1e-4)  # [s]
NOISES = (0.0, 20e-6)  # [m] of the stroke that is set
LEVELS = (0.3, 0.4, 0.5, 0.56, 0.6, 0.7, 0.8, 0.9, 1.0)
CYCLES, SETTLED = 4, 1  # of the motion, and those of them that do not count
BEYOND = 50.0  # [N]


def beyond_neighbours(damper: DamperFmu, short: float, noise: float, seed: int = 1) -> float:
    """Share of the steps of `short` [s], one among three to seven usual ones, whose force is off by more than BEYOND.

    `noise` [m] is that of the stroke.
    """
    random = np.random.default_rng(seed)
    w, time, forces, marks = 2.0 * np.pi * FREQUENCY, 0.0, [], []
    while time < CYCLES / FREQUENCY:
        for length in [USUAL] * int(random.integers(3, 8)) + [short]:
            stroke = AMPLITUDE * np.sin(w * time) + noise * random.standard_normal()
            forces.append(damper.step(float(stroke), float(AMPLITUDE * w * np.cos(w * time)), length))
            time += length
        if time > SETTLED / FREQUENCY:
            marks.append(len(forces) - 1)
    force, at = np.array(forces), np.array(marks[:-1])
    before, after = force[at - 1], force[at + 1]
    off = np.maximum(np.minimum(before, after) - force[at], force[at] - np.maximum(before, after))
    return float(np.mean(off > BEYOND))


def bench_short_steps() -> dict[str, dict[str, float]]:
    """Share of the short steps that are off [%], the worst of all dampers, by oil level, noise and step."""
    found: dict[str, dict[str, float]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for name in tqdm(names(), unit="damper", leave=False):
            fmu = build_fmu(load(name), Path(folder) / f"{name}.fmu", platforms=(fmpy.platform,))
            for level in LEVELS:
                for noise in NOISES:
                    row = found.setdefault(f"{100 * level:.0f} % oil, noise {1e6 * noise:g} um", {})
                    for short in SHORT:
                        with DamperFmu(fmu, oil_level=level, gas_preload=0) as damper:
                            share = 100.0 * beyond_neighbours(damper, short, noise)
                        head = f"{1e6 * short:g} us"
                        row[head] = round(max(row.get(head, 0.0), share), 1)
    return found
