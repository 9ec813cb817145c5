"""What becomes of freed gas: long blocks with a rest tell the closures apart, and by more than the usual blocks do."""

from dataclasses import replace
from pathlib import Path

import pytest

from twintube.core import effects
from twintube.dampers.closures import GAS
from twintube.diagnosis import Diagnosis, diagnose
from twintube.lab.blind_trials.trials import Trial, trial, write

BLOCKS = (0.524, 1.048, 1.572)
V_RECOVERY, SECONDS = 1.08, 10.0  # [m/s], [s] of the long blocks: the recovery plan's velocity for SA8


def measured(kind: str, seed: int, recovery: bool) -> Trial:
    """Records of SA8 with a closure hidden, down to 56 % oil: blocks, and the recovery records that tell most or none."""
    found = trial(kind, seed, blocks=BLOCKS, recover=(V_RECOVERY,) if recovery else (), seconds=SECONDS)

    def kept(file: str, level: float) -> bool:
        usual = recovery or not file.endswith("_rest.parquet")
        return (
            usual
            and level > 0.4
            and not file.endswith("rest_180s_slow.parquet")
            and (level > 0.8 or "rest_10s." not in file)
        )

    return replace(found, records=[one for one in found.records if kept(one.file, one.oil_level)])


def rival(found: Diagnosis, kind: str) -> float:
    """Held-out gain of the best other closure in the first round, relative to that of the hidden one."""
    gains = {one.effect: one.heldout_gain for one in found.tried if one.round == 1 and one.effect in GAS}
    return max((gain for name, gain in gains.items() if name != kind), default=0.0) / gains[kind]


@pytest.mark.slow
@pytest.mark.parametrize("kind", GAS)
def test_recovery_records_name_the_hidden_closure(kind: str, tmp_path: Path) -> None:
    found = diagnose(write(measured(kind, 701, True), tmp_path))
    assert (found.verdict, [cause.effect for cause in found.causes]) == ("cause", [kind])
    assert effects.active(found.extended.parameters) == (kind,)
    assert rival(found, kind) < 0.25


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["oil_displacement", "gas_exhaustion"])
def test_recovery_records_set_the_closures_further_apart_than_blocks(kind: str, tmp_path: Path) -> None:
    """Where all other numbers of the damper are known, blocks alone name the closure too; a rival explains more of them."""
    alone, together = (
        diagnose(write(measured(kind, 701, recovery), tmp_path / str(recovery))) for recovery in (False, True)
    )
    assert [cause.effect for cause in alone.causes] == [kind]
    assert rival(together, kind) < rival(alone, kind)
