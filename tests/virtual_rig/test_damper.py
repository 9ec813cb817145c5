"""The virtual damper: independent of `twintube`, component lengths that fit, a reserve that also holds gas."""

import ast
from pathlib import Path

import numpy as np
import pytest

from twintube.dampers import load
from twintube.lab import virtual_rig
from twintube.lab.virtual_rig import run, virtual_damper
from twintube.lab.virtual_rig.dimensions import DIMENSIONS, Lengths, is_strut

STRUTS = ["SA1", "SA3", "SA5", "SA7"]  # front dampers (Table 1)
LONGEST = 0.075  # [m]
MONOTUBE = 20e5  # [Pa] lowest filling pressure of a monotube damper (kfz-tech.de), which a twin tube does not need


def test_no_module_imports_the_model():
    modules = sorted(Path(virtual_rig.__file__).parent.glob("**/*.py"))
    assert len(modules) > 5
    for path in modules:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            imported = [item.name for item in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom):
                assert node.level == 0
                imported.append(node.module or "")
            # Of its own, the atomic writers, the type of arrays, and the compiled library, which holds its equations too.
            allowed = ("twintube.lab.virtual_rig", "twintube.common.", "twintube.native.library")
            foreign = [name for name in imported if not name.startswith(allowed)]
            assert not any(name.split(".")[0] == "twintube" for name in foreign), path.name


@pytest.mark.parametrize("name", DIMENSIONS)
def test_dimensions_are_the_published_ones(name):
    published = load(name).parameters
    for item, value in DIMENSIONS[name]._asdict().items():
        assert value == pytest.approx(getattr(published, item)), item


def test_struts_and_rear_dampers_differ():
    for name, dimensions in DIMENSIONS.items():
        assert is_strut(dimensions.D_PR) == (name in STRUTS)
    strut, rear = virtual_damper("SA7"), virtual_damper("SA8")
    assert strut.lengths.total > rear.lengths.total
    assert strut.forces != rear.forces


@pytest.mark.parametrize("name", DIMENSIONS)
@pytest.mark.parametrize("amplitude", [0.045, LONGEST])
def test_strokes_and_oil_fit(name, amplitude):
    damper = virtual_damper(name)
    phase = np.linspace(0, 2 * np.pi, 601)
    r = run(damper, phase * amplitude / 0.1, amplitude * np.sin(phase))
    reserve = damper.A_3 * damper.height_3
    assert 0.5 < r.oil[2, 0] / reserve <= 0.66
    assert r.oil[2].max() < 0.9 * reserve
    assert r.pressure[2].max() < MONOTUBE
    assert r.pressure[2].min() > 2e5  # the rod does not pull the preload out


def test_lengths_decide_on_the_room_for_oil():
    short, long = virtual_damper(), virtual_damper(lengths=Lengths(0.02, 0.03, 0.04, 0.02))
    assert long.half == pytest.approx((0.331 - 0.11) / 2)
    assert long.reserve_oil > short.reserve_oil and long.height_3 > short.height_3


def test_changes_are_taken():
    assert virtual_damper("SA1", overhang=0.03).overhang == 0.03
    assert virtual_damper("SA1", preload=4e5).preload == 4e5
    stiff = virtual_damper(forces=virtual_damper("SA7").forces)
    assert stiff.base_crack != virtual_damper().base_crack


def test_unknown_damper_is_refused():
    with pytest.raises(ValueError, match="SA8"):
        virtual_damper("SA9")
