"""What becomes of freed gas: long blocks with a rest tell its ways apart, and by more than the usual blocks do."""

from dataclasses import replace
from pathlib import Path

import pytest

from twintube.core import effects
from twintube.dampers.freed_gas import GAS
from twintube.diagnosis import Diagnosis, diagnose
from twintube.lab.blind_trials.trials import Trial, trial, write

BLOCKS = (0.524, 1.048, 1.572)
V_RECOVERY, SECONDS = 1.08, 10.0  # [m/s], [s] of the long blocks: the recovery plan's velocity for SA8


def measured(kind: str, seed: int, recovery: bool) -> Trial:
    """Records of SA8 with a way of the freed gas hidden, down to 56 % oil: blocks, and the recovery records that tell most or none."""
    hidden = trial(kind, seed, blocks=BLOCKS, recover=(V_RECOVERY,) if recovery else (), seconds=SECONDS)

    def kept(file: str, level: float) -> bool:
        usual = recovery or not file.endswith("_rest.parquet")
        return (
            usual
            and level > 0.4
            and not file.endswith("rest_180s_slow.parquet")
            and (level > 0.8 or "rest_10s." not in file)
        )

    return replace(hidden, records=[r for r in hidden.records if kept(r.file, r.oil_level)])


def rival(answer: Diagnosis, kind: str) -> float:
    """Held-out gain of the best other way in the first round, relative to that of the hidden one."""
    gains = {t.effect: t.heldout_gain for t in answer.tried if t.round == 1 and t.effect in GAS}
    return max((gain for name, gain in gains.items() if name != kind), default=0.0) / gains[kind]


@pytest.mark.slow
@pytest.mark.parametrize("kind", GAS)
def test_recovery_records_name_the_hidden_way(kind: str, tmp_path: Path) -> None:
    answer = diagnose(write(measured(kind, 701, True), tmp_path))
    assert (answer.verdict, [cause.effect for cause in answer.causes]) == ("cause", [kind])
    assert effects.active(answer.extended.parameters) == (kind,)
    assert rival(answer, kind) < 0.25


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["oil_displacement", "gas_exhaustion"])
def test_recovery_records_set_the_ways_further_apart_than_blocks(kind: str, tmp_path: Path) -> None:
    """Where all other numbers of the damper are known, blocks alone name the way too; a rival explains more of them."""
    alone, together = (
        diagnose(write(measured(kind, 701, recovery), tmp_path / str(recovery))) for recovery in (False, True)
    )
    assert [cause.effect for cause in alone.causes] == [kind]
    assert rival(together, kind) < rival(alone, kind)
