"""Bench data of dampers that differ by 2 to 6 % from their parameter set, on a bench with the usual tolerances.

law     the damper's own law: the product's kernel for oil and gas, own valves, friction and lag around it
bench   what the operator drives, and what load cell and stroke sensor make of it
causes  what may have changed between two days, with ranges of practice and where these come from
world   the worlds: `unknown_fill`, `tared_cell` and `before_after`
"""

from worlds.imperfect.world import World, before_after, tared_cell, unknown_fill, write

__all__ = ["World", "before_after", "tared_cell", "unknown_fill", "write"]
