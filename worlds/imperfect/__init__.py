"""Bench data of dampers that differ by 2 to 6 % from their parameter set, on a bench with the usual tolerances.

law     the damper's own law: the product's kernel for oil and gas, own valves, friction and lag around it
bench   what the operator drives, and what load cell and stroke sensor make of it
causes  what may have changed between two days, with ranges of practice and where these come from
world   the two worlds: `unknown_fill` and `before_after`
files   dataset and truth on disk
"""

from worlds.imperfect.files import write
from worlds.imperfect.world import WORLDS, World, before_after, make, unknown_fill

__all__ = ["WORLDS", "World", "before_after", "make", "unknown_fill", "write"]
