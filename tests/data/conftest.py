"""A dataset folder with one good record, made to be spoilt."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

Columns = dict[str, Any]
RECORD = '[[record]]\nfile = "{}"\nmeasurement = "harmonic"\noil_level = 0.56\ngas_preload = false\n'


def good(n: int = 1501, dt: float = 0.002) -> Columns:
    """Three seconds at 1 Hz, 30 mm, a damper with friction, with the noise of sensors."""
    rng = np.random.default_rng(1)
    t = np.arange(n) * dt
    z, v = 30 * np.sin(2 * np.pi * t), 60 * np.pi * np.cos(2 * np.pi * t)
    force = 4.0 * v + 50 * np.tanh(v / 5) + rng.normal(0, 2, n)
    return {
        "time [s]": t,
        "stroke [mm]": z + rng.normal(0, 0.005, n),
        "velocity [mm/s]": v + rng.normal(0, 0.5, n),
        "force [N]": force,
    }


def as_csv(columns: Columns) -> str:
    rows = zip(*columns.values(), strict=True)
    cells = [",".join(x if isinstance(x, str) else f"{x:.7g}" for x in row) for row in rows]
    return "\n".join([",".join(columns), *cells, ""])


@pytest.fixture
def folder(tmp_path: Path) -> Callable[..., Path]:
    """Make a dataset folder: records by file name, as columns or as text; `top` goes to the head of dataset.toml."""

    def make(records: dict[str, Any], top: str = 'damper = "SA8"', toml: str | None = None) -> Path:
        for name, content in records.items():
            if content is not None:
                (tmp_path / name).write_text(content if isinstance(content, str) else as_csv(content), encoding="utf-8")
        text = f'title = "Test"\n{top}\n' + "".join(RECORD.format(name) for name in records) if toml is None else toml
        (tmp_path / "dataset.toml").write_text(text)
        return tmp_path

    return make
