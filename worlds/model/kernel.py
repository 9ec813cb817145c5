"""The paper's kernel compiled by numba, function by function, for loops of the worlds that take it apart.

Without a cache on disk, which would not see a change of the kernel.
"""

import ast
from functools import cache
from types import ModuleType

from twintube.core import sources
from twintube.core.variables import FV_POINTS
from worlds.bench.plan import with_numba


@cache
def kernel() -> ModuleType:
    """The functions of the kernel's files, without their types; records are rows of structured arrays."""
    module = ModuleType("kernel")
    vars(module).update(FV_POINTS=FV_POINTS, njit=with_numba)
    parts = ["import math"]
    for text in sources.kernel_texts().values():
        for node in ast.parse(text).body:
            if isinstance(node, ast.FunctionDef):
                node.returns = None
                for argument in node.args.args:
                    argument.annotation = None
                parts.append(f"@njit\n{ast.unparse(node)}")
            elif isinstance(node, ast.Assign):
                parts.append(ast.unparse(node))
    exec(compile("\n\n".join(parts), "kernel", "exec"), vars(module))
    return module
