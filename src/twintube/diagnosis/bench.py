"""Records under a simulation: what the bench and the model's own error may add to their forces, as columns with a scale."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array
from twintube.dampers import Damper
from twintube.diagnosis.discrepancy import Discrepancy, degraded, discrepancy
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.records.noise import colour, noise
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.records.seen import BENDS, DELAY, REMEMBERED, SeenRecords

LEVEL, GAS = "oil_level", "gas_preload"  # with the name of a state, what a hypothesis may have otherwise
FLOOR = 0.3  # of the largest force: drawings allow some per cent and 20 to 30 N
TURNED = 0.03  # of the largest force, above which the share of the fluid force that is left is read
LATEST = [2, 5]  # columns of `degraded` in which a loss comes latest
ALIKE = 0.05  # logarithm of the ratio of strokes, and of speeds, up to which two motions are one
REPEATING = ("harmonic", "quasi-static")  # motions whose oscillations are alike
PHASES = 32  # of an oscillation
WHOLE = 0.9  # of the samples of the longest oscillation, above which one is whole; numerics
MORE = 0.2  # numerics of a derivative
CHANNELS = 7  # contributions of the measuring channels to a single record, the first of its own ones
UNIFORM = 12.0**-0.5  # standard deviation of what lies anywhere within 1
TURN = 0.01  # [m/s] speed at which friction has turned


class Bench(SeenRecords):
    """The records of a dataset, simulated, and the contributions to their forces."""

    def __init__(
        self,
        damper: Damper,
        records: Sequence[PreparedRecord],
        usual: Mapping[str, float] | None = None,
        fills: Sequence[str] = (),
    ) -> None:
        """`fills` are the names of the states of filling of the records."""
        super().__init__(damper, records, usual)
        self.labels = {name: np.array([one == name for one in fills]) for name in dict.fromkeys(fills)}
        for name, which in self.labels.items():
            self.fills |= {f"{LEVEL}:{name}": (0, which), f"{GAS}:{name}": (1, which)}
        self.measured = np.concatenate([r.force for r in records])
        self.peak = max(r.peak for r in records)
        self.delayed = float(np.hypot(numbers().late, numbers().skew * np.median([r.period for r in records])))
        self.zero = numbers().zero * self.peak
        self.slices = [slice(a, b) for a, b in zip(self.starts[:-1], self.starts[1:], strict=True)]
        self.noisy(np.concatenate([r.noise for r in records]))
        self.days = np.zeros((len(self.z), 0))  # [N] friction, each time the cell was set to zero with the damper in it
        self.fulls: dict[bytes, tuple[Array, Array, Array]] = {}
        self.law: Discrepancy = discrepancy(self.v, float(np.abs(self.z).max()), FLOOR * self.peak)
        p = self.damper.parameters
        rebound, compression = (np.interp(s * self.v, (0.0, *v), (0.0, *f)) for s, v, f in (
            (1.0, p.v_re, p.F_re), (-1.0, p.v_co, p.F_co)
        ))  # fmt: skip
        self.intact = np.where(self.v >= 0.0, rebound, compression)

    def noisy(self, noise: Array) -> None:
        """Take `noise` (n,) [N] for that of the mean forces."""
        edges = np.concatenate([r.edges for r in self.records])
        self.sigma = np.sqrt(noise**2 + edges**2 + (numbers().model_noise * self.peak) ** 2)

    def with_edges(self, edges: Sequence[Array]) -> None:
        """Take errors (n,) [N] at the steps of the force of each record for further noise."""
        self.records = [replace(r, edges=own) for r, own in zip(self.records, edges, strict=True)]
        self.noisy(np.concatenate([r.noise for r in self.records]))

    def noise_in(self, left: Array) -> Array:
        """Noise (n,) [N] of the mean forces, from what does not repeat in the errors (n,) [N] that a model leaves."""
        alike = colour(self.records, np.split(left, self.starts[1:-1]))
        records = [replace(r, colour=alike) for r in self.records]
        return np.concatenate([noise(r, left[at]) for r, at in zip(records, self.slices, strict=True)])

    def at_usual(self, values: Mapping[str, float]) -> None:
        """Simulate with these values where no others are given."""
        self.usual = dict(values)

    def in_state(self, which: NDArray[np.bool_], preload: float, oil_level: float, tared: bool) -> None:
        """Let the records `which` (r,) be in a state, and put right a load cell that was `tared`."""
        self.states[which, 0], self.states[which, 1] = oil_level, preload
        if tared:
            without, friction = self.tared(self.measured, which, preload).T
            inside, force = np.repeat(which, np.diff(self.starts)), self.with_states(self.states)
            left, leaves = (abs(float(np.mean((x - force)[inside]))) for x in (self.measured, without))
            # Another zero, of which neither is near, is no tare: it is left for the search of causes.
            if leaves < left:
                self.measured, self.days = without, np.column_stack([self.days, friction])
        self.simulated = lru_cache(REMEMBERED)(self.simulate)

    @property
    def at_rest(self) -> tuple[float, float]:
        """By how much [N] the gas pushes out the rod of a damper at rest, and the standard deviation [N] of its friction."""
        return self.damper.parameters.F_0, 2.0 * UNIFORM * self.damper.parameters.F_FrS

    def tared(self, errors: Array, which: NDArray[np.bool_], preload: float | Array) -> Array:
        """Errors (n,) [N] where the cell was set to zero with the damper in it, in the records `which` (r,); (n, 2).

        What it read then is lost: the force of the gas, and friction, which at rest is anywhere between its limits. The
        second column is the latter, of size one.
        """
        gas, friction = self.at_rest
        inside = np.repeat(which, np.diff(self.starts))
        pressed = np.repeat(preload * self.states[:, 2], np.diff(self.starts))
        return np.column_stack([errors - gas * pressed * inside, friction * inside])

    def with_states(self, states: Array) -> Array:
        """Forces (n,) [N] of the records in other states (r, 4), measurement included."""
        return self.observed(*self.simulate(self.damping({}), states), {})

    def full(self, states: Array) -> tuple[Array, Array, Array]:
        """Forces and friction in them (n,) [N] with all oil and the preload of states (r, 4), and what channels may change.

        These contributions (n, 5) [N] are a delay by a part of a sample, a mean instead of a point, and three bends.
        """
        key = states[:, 1].tobytes()
        if key not in self.fulls:
            filled = states.copy()
            filled[:, 0] = 1.0
            rows = self.rows()
            rows[0]["F_FrS"] *= 1.0 + MORE
            mean, point = self.simulate(self.damping({}), filled)
            force = self.observed(mean, point, {})
            friction = (self.sampled(rows, (), None, filled)[1] - force) / MORE
            self.fulls[key] = force, friction, self.channels(filled)
        return self.fulls[key]

    def channels(self, states: Array) -> Array:
        """What the channels may change (n, 5) [N]: a delay by a part of a sample, a mean instead of a point, three bends."""
        mean, point = self.simulate(self.damping({}), states)
        now, by = self.usual.get(DELAY, 0.0), self.delayed
        late, early = (self.observed(*self.simulate(self.damping({DELAY: now + x}), states), {}) for x in (by, -by))
        parts = self.parts_of_samples(mean, point)
        sampling = [UNIFORM * parts["sample_mean"], *(numbers().filtered * parts[name] for name in BENDS)]
        return np.column_stack([0.5 * (late - early), *sampling])

    def loss(self, states: Array) -> Array:
        """Force (n,) [N] that missing oil takes away, friction apart, which rises with it."""
        rows = self.rows()
        rows[0]["oil_loss_gain"] = 0.0
        return np.asarray(self.sampled(rows, (), None, states)[1] - self.full(states)[0])

    def fluid(self, force: Array, friction: Array, states: Array) -> Array:
        """The fluid part (n,) [N] of a simulated force, gas and `friction` (n,) [N] taken off."""
        p = self.damper.parameters
        preload = np.repeat(states[:, 1] * states[:, 2], np.diff(self.starts))
        return np.asarray(force - preload * (p.c_gas * self.z - p.F_0) - friction)

    def once(self) -> NDArray[np.bool_]:
        """What is compared (n,) of one oscillation of each record that repeats, its last whole one, and of all others."""
        out = self.used.copy()
        for record, at in zip(self.records, self.slices, strict=True):
            inside = self.used[at] & (record.cycle >= 0)
            if record.measurement in REPEATING and inside.any():
                count = np.bincount(record.cycle[inside])
                out[at] = inside & (record.cycle == np.flatnonzero(count > WHOLE * count.max())[-1])
        return out

    def motions(self) -> list[list[int]]:
        """The records of each motion: what a model gets wrong in one it gets wrong in another like it."""
        groups: list[list[int]] = []
        for i, record in enumerate(self.records):
            for group in groups:
                first = self.records[group[0]]
                sizes = (np.abs(record.stroke).max() / np.abs(first.stroke).max(), record.top_speed / first.top_speed)
                if record.measurement == first.measurement and np.all(np.abs(np.log(sizes)) < ALIKE):
                    group.append(i)
                    break
            else:
                groups.append([i])
        return groups

    def repeating(self, i: int) -> Array:
        """Contributions (n, p) [N] of size one to record `i` that are the same in each oscillation of a motion."""
        at, record = self.slices[i], self.records[i]
        if record.measurement not in REPEATING:
            return np.zeros((len(record.time), 0))
        z, v = self.z[at], self.v[at]
        phase = np.arctan2(v / record.top_speed, z / np.abs(z).max()) * PHASES / (2.0 * np.pi)
        apart = np.abs((phase[:, None] - np.arange(PHASES) + PHASES / 2.0) % PHASES - PHASES / 2.0)
        return np.asarray(np.maximum(0.0, 1.0 - apart) * np.hypot(self.intact[at], FLOOR * self.peak)[:, None])

    def contributions(self, states: Array, known: bool = False) -> list[tuple[Array, Array, Array]]:
        """For each record shared (n, k) and own (n, m) contributions of size one [N], and those of what lasts (n,) [N].

        Where the fill is `known`, the channels see the steps of its force; else other levels stay alike.
        """
        # All but the loss is that of the full damper: levels that do not differ in it are alike to the last digit.
        (whole, friction, channels), loss = self.full(states), self.loss(states)
        channels = self.channels(states) if known else channels
        fluid = self.fluid(whole + loss, friction, states)
        turn = np.clip(1.0 - np.abs(loss) / np.maximum(self.intact, TURNED * self.peak), 0.0, 1.0)
        p = self.damper.parameters
        rubs = float(np.hypot(numbers().rubbing * p.F_FrS, numbers().side * self.peak))
        out = []
        for at in self.slices:
            z, v = (0.5 * (x[at] + np.concatenate([x[at][:1], x[at][:-1]])) for x in (self.z, self.v))
            F, along = (whole + loss)[at], z / self.law.span
            law = self.law.columns(z, v, fluid[at], self.t[at], turn[at])
            one, rubbing = np.ones_like(F), np.tanh(v / TURN)
            rub = rubs / p.F_FrS * friction[at]
            # Without preload some gas is left, too.
            gas = numbers().preload * np.column_stack([p.c_gas * z - p.F_0, p.c_gas * z])
            lost = degraded(self.z[at], v, loss[at])
            n = numbers()
            zero = self.zero
            channel = channels[at].copy()
            if not known:
                channel[:, 0] += self.delayed * np.gradient(loss[at], self.t[at])
            still = np.column_stack([rub, rub * along, rub * (1.5 * along**2 - 0.5), gas, lost, zero * one, channel])
            # Oil and load cell get warm within a record.
            passed = (self.elapsed[at] - 0.5 * self.elapsed[at].max()) / max(1e-9, 0.5 * self.elapsed[at].max())
            warm = [n.begun * fluid[at], n.begun * fluid[at] * passed, zero * passed]
            others = [zero * along, zero * rubbing]
            bench = np.column_stack([zero * one, n.gain * F, channel, *warm, *others])
            # Steps of the state itself apart, how steep the force is does not depend on the state.
            lasts = np.hypot(self.intact[at], FLOOR * self.peak) + n.timed * np.abs(np.gradient(whole[at], self.t[at]))
            lasts += n.placed * np.abs(lost[:, LATEST]).sum(axis=1)
            out.append((np.hstack([still, law]), np.hstack([bench, self.law.own(z, v, fluid[at], turn[at])]), lasts))
        return out
