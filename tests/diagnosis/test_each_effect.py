"""Each effect is hidden once in a damper that is off its parameter set, and three good dampers are cleared."""

from collections.abc import Collection, Mapping
from dataclasses import replace

import numpy as np
import pytest

from tests.diagnosis import small
from tests.diagnosis.look_alikes import ACTS_ON, look_alikes
from tests.diagnosis.specimen import own_law
from twintube.core.effects import EFFECTS
from twintube.core.hook_table import HOOKS
from twintube.dampers import load
from twintube.data import LoadedDataset
from twintube.diagnosis import Answer, answer
from twintube.diagnosis.changes import mechanisms, priors
from twintube.diagnosis.mechanisms import CATALOGUE

# Large ones, as in a damper that is to be replaced.
HIDDEN: dict[str, dict[str, float]] = {
    "end_stop": {"F_stop_co": 800.0, "onset_co": 0.037},
    "fluid_lag": {"tau_fluid": 0.006},
    "foam_decay": {"foam_decay_rate": 2.0},
    "gas_exhaustion": {"exhaustion": 5.0},
    "gas_redissolution": {"redissolution_rate": 1.0},
    "gas_spring": {"F_surplus": 200.0},
    "mount_compliance": {"C_mount": 5e-6},
    "oil_displacement": {"displaced_share": 1.0},
    "oil_level_error": {"level_error": -0.1},
    "oil_temperature": {"fade_heat": 6e-5},
    "position_friction": {"friction_bow": 800.0},
    "seal_leak": {"leak_film": 1.5e-6},
    "side_load_friction": {"side_load": 5.0},
    "smooth_transition": {"build_up": 0.012},
    "valve_wear": {"wear_re": 0.3},
}
IN_LOST_OIL = (
    "foam_decay",
    "gas_exhaustion",
    "gas_redissolution",
    "oil_displacement",
    "oil_level_error",
    "seal_leak",
    "smooth_transition",
)
SPEEDS = {small.INTACT: (0.3, 1.0), small.DEGRADED: (0.6, 1.3)}  # [m/s]
TURNS = 6
LONG = 12  # where heat is to show, and where nothing is


def before_and_after(
    level: float,
    changed: Mapping[str, float],
    seed: int = 0,
    catalogue: Collection[str] | None = None,
    turns: int = LONG,
) -> Answer:
    """The answer to two records as delivered and two after a change."""
    damper = load("SA8", as_published=True)
    records = []
    for i, name in enumerate(("before", "before", "after", "after")):
        worn = damper.with_(**changed) if name == "after" else damper
        run = small.run(SPEEDS[level][i % 2], level, turns=turns, damper=worn)
        seen = small.record(run, own_law(run), seed=10 * seed + i)
        records.append(replace(seen, name=f"{name}_{i}", reference=name == "before", state=name))
    return answer(LoadedDataset("Small", damper, records, []), catalogue=catalogue)


def assert_numbers_agree(found: Answer, catalogue: Collection[str]) -> None:
    """Shares are in order and sum to one, and each is its prior times its evidence."""
    assert found.changes is not None
    several = found.changes.hypotheses
    prior = priors(list(dict.fromkeys(m.effect for m in mechanisms(found.changes.search.bench, catalogue))))
    shares = [h.probability for h in several]
    assert shares == sorted(shares, reverse=True)
    assert sum(shares) == pytest.approx(1.0)
    assert sum(h.probability for h in found.named) >= 0.9
    most = max(h.log_evidence for h in several)
    own = np.array([prior(h.name) * np.exp(h.log_evidence - most) for h in several])
    assert own / own.sum() == pytest.approx(shares, abs=1e-6)


@pytest.mark.parametrize("whole", [False, pytest.param(True, marks=pytest.mark.slow)], ids=["look-alikes", "catalogue"])
@pytest.mark.parametrize("effect", HIDDEN)
def test_a_hidden_effect_is_among_what_is_named(effect: str, whole: bool) -> None:
    level = small.DEGRADED if effect in IN_LOST_OIL else small.INTACT
    catalogue = CATALOGUE if whole else look_alikes(effect)
    turns = LONG if effect == "oil_temperature" else TURNS
    found = before_and_after(level, HIDDEN[effect], catalogue=catalogue, turns=turns)
    assert_numbers_agree(found, catalogue)
    # A fill other than stated is a state.
    assert {"oil_level_error": "state"}.get(effect, effect) in {part for h in found.named for part in h.name.split("+")}
    if found.verdict == "cause":
        assert found.extended is not None and found.extended.parameters != found.damper.parameters


def test_every_effect_is_hidden() -> None:
    assert set(HIDDEN) == set(EFFECTS)


def test_every_hook_acts_on_one_part_of_the_force() -> None:
    assert sorted(hook for several in ACTS_ON.values() for hook in several) == sorted(HOOKS)


OTHER_NOISE = pytest.param(small.INTACT, 2, marks=pytest.mark.slow)


@pytest.mark.parametrize(("level", "seed"), [(small.INTACT, 1), OTHER_NOISE, (small.DEGRADED, 3)])
def test_a_good_damper_is_cleared(level: float, seed: int) -> None:
    found = before_and_after(level, {}, seed)
    assert found.verdict == "none"
    assert found.extended is None
    assert found.states[0].posterior.as_stated > 0.9
