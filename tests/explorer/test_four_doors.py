"""One block, four doors: the command's FMU, Python's FMU, `simulate` and the explorer do the same work."""

from pathlib import Path

import fmpy
import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid
from typer.testing import CliRunner

from tests.explorer.test_module import REFERENCE, Native
from tests.explorer.wasm import Module
from twintube import build_fmu, harmonic_block, load, simulate
from twintube.cli import app
from twintube.dampers.freed_gas import AS_PUBLISHED, DEFAULT
from twintube.explorer.content import content

LEVEL = 0.6
BLOCK = harmonic_block(1.048, dt=2e-3)
# The stroke to which the velocity leads: so an FMU with input derivatives moves, step by step.
STROKE = cumulative_trapezoid(BLOCK.velocity, BLOCK.time, initial=0.0) + BLOCK.stroke[0]
RECORD = (BLOCK.time, STROKE, BLOCK.velocity)


def explored(way: str) -> float:
    """Work [J] of the explorer: the values that its page sends to the module."""
    known = content([])
    shown = next(damper for damper in known["dampers"] if damper["name"] == "SA8")
    values = dict(zip(known["parameters"], shown["values"], strict=True)) | known["ways"][way]["parameters"]
    values |= {"oil_level": LEVEL, "gas_preload": 0}
    reals = {REFERENCE[name]: value for name, value in values.items() if name not in known["integers"]}
    integers = {REFERENCE[name]: int(value) for name, value in values.items() if name in known["integers"]}
    module = Module()
    return float(module.record(module.unit(reals, integers), *RECORD, [REFERENCE["work"]])[0, -1])


@pytest.mark.parametrize(("option", "published"), [([], False), (["--as-published"], True)])
def test_one_block_does_the_same_work_behind_four_doors(option: list[str], published: bool, tmp_path: Path) -> None:
    damper = load("SA8", as_published=published).with_(oil_level=LEVEL, gas_preload=0)
    expected = simulate(damper, STROKE, BLOCK.velocity, BLOCK.time).work[-1]
    arguments = ["fmu", "SA8", "--oil-level", str(LEVEL), "--gas-lost", "--platform", fmpy.platform, *option]
    built = CliRunner().invoke(app, [*arguments, "--output", str(tmp_path / "command.fmu")])
    assert built.exit_code == 0, built.output
    python = build_fmu(damper, tmp_path / "python.fmu", platforms=(fmpy.platform,))
    for fmu in (tmp_path / "command.fmu", python):
        work = Native(fmu).record(None, *RECORD, [REFERENCE["work"]])[0, -1]
        assert work == pytest.approx(expected, rel=1e-9), fmu.name
    known = content([])
    assert known["freedGas"] == DEFAULT
    assert explored(AS_PUBLISHED if published else known["freedGas"]) == pytest.approx(expected, rel=1e-6)


def test_the_ways_differ_by_more_than_the_doors() -> None:
    works = [
        simulate(
            load("SA8", as_published=published).with_(oil_level=LEVEL, gas_preload=0), *np.array(RECORD)[[1, 2, 0]]
        ).work[-1]
        for published in (False, True)
    ]
    assert works[0] > 1.05 * works[1]
