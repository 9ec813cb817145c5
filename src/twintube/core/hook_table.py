"""The hooks: functions `<effect>_<hook>` of an effect's file, which the model calls around the paper's equations."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Hook:
    """A function that an effect may have: what the model calls, when, and what becomes of the results of several effects."""

    arguments: str
    result: str
    joined: str  # call | chain | sum | product | most
    does: str


JOINED = {
    "call": ("", "{}", "one after the other"),
    "chain": ("", "value = {}", "each takes the result of the one before"),
    "sum": ("    value = 0.0\n", "value += {}", "sum"),
    "product": ("    value = 1.0\n", "value *= {}", "product"),
    "most": ("    value = 1\n", "value = max(value, {})", "largest"),
}  # first line, line of an effect, words
# In the order in which a step calls them.
HOOKS = {
    "derive": Hook("p: Parameters, d: Derived", "None", "call", "changes `d` after `kernel.prepare`"),
    "level": Hook("p: Parameters, value: float", "float", "chain", "true oil level [1] at the start for the level `value`"),
    "parts": Hook("p: Parameters, dt: float", "int", "most", "number of parts that a step is divided into"),
    "motion": Hook("p: Parameters, d: Derived, s: State, z: float, v0: float, v1: float, dt: float", "None", "call",
                   "sets `s.goal_z`, `s.goal_v0`, `s.goal_v1`: what the piston sees of the rod's motion"),
    "warming": Hook("p: Parameters, s: State", "float", "sum", "temperature [K] beyond that which is given from outside"),
    "scale_cavitation": Hook("p: Parameters, s: State", "float", "product", "factor [1] of the gas that cavitation frees"),
    "phases": Hook("p: Parameters, s: State, way: float, dt: float", "None", "call",
                   "changes the phases before the step, which goes over `way` [m] in `dt` [s]"),
    "flows": Hook("p: Parameters, d: Derived, s: State, f: Flow, dz: float, foaming: float", "None", "call",
                  "changes the flows `f` after `kernel.flows`, in the direction of `dz`"),
    "transition": Hook("p: Parameters, s: State, f: Flow, v: float, dz: float", "None", "call",
                       "changes `s.k_degr`, `f.k_degr`, `f.k_mean` after the flows of the step"),
    "scale_fluid": Hook("p: Parameters, s: State, v: float", "float", "product",
                        "factor [1] of the fluid force in the direction of `v`"),
    "scale_valve": Hook("p: Parameters, u: float", "float", "product",
                        "factor [1] of the intact fluid force at the speed `u` [m/s] at the valves"),
    "bypass": Hook("p: Parameters, F: float", "float", "sum",
                   "speed [m/s] past the valves at their intact force `F` [N]; agrees with `scale_valve`"),
    "scale_friction": Hook("p: Parameters, s: State, z: float, v: float", "float", "product",
                           "factor [1] of the friction at the stroke `z` and the velocity `v`"),
    "elastic": Hook("p: Parameters, s: State, z: float", "float", "sum", "force [N] added to the gas force, without work"),
    "rub": Hook("p: Parameters, z: float, v: float", "float", "sum", "force [N] added to the friction, of the sign of `v`"),
    "series": Hook("p: Parameters, s: State, F: float, dt: float", "float", "sum",
                   "speed [m/s] taken up in series with the valves while the fluid force goes to `F` [N]"),
    "felt": Hook("p: Parameters, s: State, value: float, dt: float", "float", "chain",
                 "force [N] after the step where that at the valves is `value` [N]"),
    "rebalance": Hook("p: Parameters, d: Derived, s: State, v: float, dt: float", "None", "call",
                      "sets `s.goal_v1` again after the step has changed `s.k_re` or `s.k_co`"),
    "force": Hook("p: Parameters, s: State, v: float, dz: float, dt: float", "None", "call",
                  "sets `s.F_fluid`, `s.F_valve`, `s.F_mean`, `s.W_step` of a force with memory"),
    "finish": Hook("p: Parameters, s: State, dt: float", "None", "call", "what follows from forces and work of the step"),
    "lost": Hook("p: Parameters, level: float, z: float, duration: float, way: float, square: float", "float", "sum",
                 "oil [m3] that a record takes from those after it; not called in a step"),
}  # fmt: skip
