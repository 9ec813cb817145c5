"""The translation to C: it means what Python means, and refuses what it does not know with file and line."""

import math
import random
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tests.native.translated import in_c, in_python
from twintube.native.kinds import SubsetError
from twintube.native.translate import Equations, translated

SOURCE = '''
LIMIT = 3
START, STEP = 0.25, 2.0 * 0.5


class Pair:
    pass


def floor(a: int, b: int) -> int:
    return a // b


def rest(a: int, b: int) -> int:
    return a % b


def share(a: int, b: int) -> float:
    return a / b


def greatest(a: float, b: float, c: float) -> float:
    return max(a, b, c)


def least(a: float, b: float) -> float:
    return min(a, b)


def between(a: float, b: float, c: float) -> bool:
    return a < b <= c != a


def truth(a: bool, b: bool, c: bool) -> bool:
    return a and not b or b and (a or c) or not (a or c)


def brackets(a: float, b: float, c: float) -> float:
    return a - (b - c) + a / (b / (1.0 + c * c)) - -a * -(b + c) + (a if b > c else -b if c > 0.0 else c)


def toward_zero(x: float) -> int:
    return int(x) + 10 * math.ceil(x) + 100 * math.floor(x)


def once(n: int) -> int:
    """The end of a range is computed before the loop."""
    turns = 0
    last = n
    for i in range(1, last + 1, 2):
        last = 0
        turns += i
    for i in range(last + 4, -1, -1):
        turns = 2 * turns + i
    return turns


def early(x: float) -> float:
    """A name that only branches give a value; loops that end early.

    With a second part of the docstring.
    """
    # Above the first statement.
    if x > 1.0:
        found = x * x  # beside it
    elif x > 0.0:
        found = x
    else:
        return -1.0
    n = 0
    while True:
        n += 1
        if n == 5:
            continue
        if n > 7:
            break
        found += START * n
    return found * STEP + LIMIT


def two(x: float, n: int) -> tuple[float, int, bool]:
    return x / 3.0, n * LIMIT, x > 0.0


def taken(x: float, n: int) -> float:
    part, count, positive = two(x, n)
    _, twice, _ = two(part, count)
    return part + twice if positive else -part - twice


def mathematics(x: float, y: float) -> float:
    total = math.sin(x) + math.cos(y) + math.tan(x) * math.atan2(x, y) + math.exp(-abs(x)) + math.tanh(y)
    total += math.sqrt(x * x + y * y) + math.log(1.0 + x * x) + math.copysign(1.0, y) + math.pow(2.0 + x * x, y)
    return total + math.pi + math.log(2.0) + abs(-LIMIT)
'''
REALS = [0.0, -0.0, 1.0, -1.0, 0.1, -0.3, 2.5, -7.25, 1e-9, 123.456, -1e3]
WHOLES = [*range(-9, 10), 1000, -1001]


@pytest.fixture(scope="module")
def both(tmp_path_factory: pytest.TempPathFactory) -> tuple[SimpleNamespace, dict[str, Any]]:
    python = in_python(SOURCE)
    entries = [name for name, value in python.items() if callable(value) and name not in ("Pair", "two")]
    return in_c(SOURCE, entries, tmp_path_factory.mktemp("c")), python


def same(a: Any, b: Any) -> bool:
    """To the bit, sign of zero and NaN included; and of one type."""
    if type(a) is not type(b):
        return False
    return bool(np.float64(a).tobytes() == np.float64(b).tobytes() or (math.isnan(a) and math.isnan(b)))


@pytest.mark.parametrize("name", ["floor", "rest", "share"])
def test_whole_numbers_are_divided_as_python_divides(name: str, both: tuple[SimpleNamespace, dict[str, Any]]) -> None:
    c, python = both
    for a in WHOLES:
        for b in WHOLES:
            if b != 0:
                assert same(getattr(c, name)(a, b), python[name](a, b)), (a, b)


def test_min_and_max_take_the_first_of_equals_and_of_what_is_no_number(both: tuple[SimpleNamespace, dict[str, Any]]) -> None:
    c, python = both
    values = [*REALS, math.nan, math.inf]
    for a in values:
        for b in values:
            assert same(c.least(a, b), python["least"](a, b)), (a, b)
            for third in (math.nan, -0.0, 5.0):
                assert same(c.greatest(a, b, third), python["greatest"](a, b, third)), (a, b, third)


@pytest.mark.parametrize("name", ["between", "brackets"])
def test_comparisons_choices_and_brackets(name: str, both: tuple[SimpleNamespace, dict[str, Any]]) -> None:
    c, python = both
    for a in REALS:
        for b in filter(None, REALS):
            for third in REALS:
                assert same(getattr(c, name)(a, b, third), python[name](a, b, third)), (a, b, third)


def test_conditions(both: tuple[SimpleNamespace, dict[str, Any]]) -> None:
    c, python = both
    for bits in range(8):
        values = [bool(bits & 1), bool(bits & 2), bool(bits & 4)]
        assert c.truth(*values) is python["truth"](*values)


@pytest.mark.parametrize("name", ["toward_zero", "early"])
def test_rounding_branches_and_loops(name: str, both: tuple[SimpleNamespace, dict[str, Any]]) -> None:
    c, python = both
    for x in REALS:
        assert same(getattr(c, name)(x), python[name](x)), x


def test_ranges(both: tuple[SimpleNamespace, dict[str, Any]]) -> None:
    c, python = both
    for n in range(-3, 12):
        assert c.once(n) == python["once"](n)


def test_several_results_and_functions_of_math(both: tuple[SimpleNamespace, dict[str, Any]]) -> None:
    c, python = both
    for x in REALS:
        for n in WHOLES:
            assert same(c.taken(x, n), python["taken"](x, n)), (x, n)
        for y in (0.5, -1.5, 3.0):
            assert same(c.mathematics(x, y), python["mathematics"](x, y)), (x, y)


def test_comments_docstrings_and_constants_are_kept() -> None:
    text = translated(Equations({"source.py": SOURCE}, ["early"], prefix="t_")).text
    for said in ("/* Above the first statement. */", "/* beside it */", "With a second part of the docstring. */"):
        assert said in text
    assert "static const int64_t t_LIMIT = 3;" in text and "static const double t_STEP = 1.0;" in text


ARRAYS = '''
from dataclasses import dataclass


@dataclass
class Point:
    """A record."""

    x: float = var("", "", "m", "place", default=0.0)
    n: int = var("", "", "1", "number", integer=True, default=0)
    curve: tuple[float, ...] = var("", "", "1", "curve", size=2 + 1)


class Several(NamedTuple):
    """Arrays together."""

    values: Vector
    table: Table
    places: Counts
    factor: int


def sums(several: Several, points: Sequence[Point], stack: Stack, out: Table) -> int:
    """Rows, elements, records in an array, arrays in a bundle."""
    values = several.values
    for i in range(len(several.table)):
        row = out[i]
        p = points[i]
        p.x += curved(p.curve, several.places[i]) * several.factor
        points[i].n = several.places[i]
        for j in range(several.table.shape[1]):
            row[j] = several.table[i, j] * values[j] + points[i].x + stack[i % 2, j, 1]
        row[0], row[1] = row[2] + 1.0, values[0]
        fill(out[i], len(row) - 1, i)
    return len(values) + stack.shape[2]


def curved(curve: tuple[float, ...], at: int) -> float:
    return curve[at] + curve[0]


def fill(row: Vector, at: int, i: int) -> None:
    row[at] -= i
'''


def test_records_rows_and_bundles(tmp_path: Path) -> None:
    c = in_c(ARRAYS, ["sums"], tmp_path)
    dtype = np.dtype([("x", float), ("n", np.int64), ("curve", float, (3,))], align=True)
    random_ = np.random.default_rng(1)
    values, table, stack = random_.random(4), random_.random((3, 4)), random_.random((2, 4, 2))
    places, out = np.array([2, 0, 1]), np.zeros((3, 4))
    points = np.zeros(3, dtype)
    points["curve"] = random_.random((3, 3))
    plain = [SimpleNamespace(x=0.0, n=0, curve=tuple(row.tolist())) for row in points["curve"]]
    text = "class NamedTuple: pass\ndef var(*_, **__): pass\n" + ARRAYS[ARRAYS.index("def sums") :]
    expected = np.zeros((3, 4))
    several = SimpleNamespace(values=values, table=table, places=places, factor=7)
    result = in_python(text)["sums"](several, plain, stack, expected)
    assert c.sums((values, table, places, 7), points, stack, out) == result
    assert out.tobytes() == expected.tobytes()
    assert points["x"].tolist() == [p.x for p in plain] and points["n"].tolist() == [p.n for p in plain]


def body(text: str, arguments: str = "x: float, n: int", result: str = "float") -> str:
    return f"def other(s: Pair) -> float:\n    s.a = 1.0\n    return s.a\n\n\ndef f({arguments}) -> {result}:\n    {text}\n"


PAIR = 'from dataclasses import dataclass\n@dataclass\nclass Pair:\n    a: float = var("", "", "1", "a", default=0.0)\n'
REFUSED = {
    "x ** 2": body("return x ** 2"),
    "`x` as a condition": body("return 1.0 if x else 0.0"),
    "a place from the end": body("return x[-1]", "x: Vector"),
    "a loop over `[1, 2]`": body("for i in [1, 2]:\n        x += i\n    return x"),
    "`y`, which has no value here": body("return y"),
    "argument `x` of Any": body("return x", "x: Any"),
    "argument `x` of no type": body("return x", "x"),
    "argument `double`, a word of C": body("return double", "double: float"),
    "the arguments of `f`": body("return x", "x: float = 1.0"),
    "a call of `math.hypot` with 2 arguments": body("return math.hypot(x, x)"),
    "a call of `print`": body("print(x)\n    return x"),
    "`import os`": body("import os\n    return x"),
    "float where int is": body("n = x\n    return n"),
    "2 arguments for `other`": body("return other(x, n)"),
    "changes its arguments: give it a statement of its own": body("return s.a + other(s)", "s: Pair"),
    "a value that is changed before it is read": body("x, y = 1.0, x\n    return x"),
    "`i` is changed": body("for i in range(n):\n        i += 1\n    return x"),
    "the counter `x`, which is a name already": body("for x in range(n):\n        n += 1\n    return 1.0"),
    "a step of a range that is no number": body("for i in range(0, n, n):\n        x += i\n    return x"),
    "`n += x`": body("n += x\n    return x"),
    "`x % 2.0`": body("return x % 2.0"),
    "a choice but of numbers or truths": body("v = s if x > 0.0 else t\n    return v.a", "s: Pair, t: Pair, x: float"),
    "has no such field": body("return s.b", "s: Pair"),
    "`(x, x)`": body("return x, x"),
    "the result of `f`": body("return s", "s: Pair", "Pair"),
    "a call between two comparisons": body("return x < abs(x) < 2.0", "x: float", "bool"),
    "arguments by name": body("return max(x, key=n)"),
    "`f` calls itself": body("return f(x, n)"),
    "refers to something else already": body("row = t[0]\n    row = t[1]\n    return row[0]", "t: Table"),
}


@pytest.mark.parametrize("message", REFUSED)
def test_what_is_outside_the_subset_is_refused_with_its_place(message: str) -> None:
    with pytest.raises(SubsetError) as refused:
        translated(Equations({"folder/a.py": PAIR + REFUSED[message]}, ["f"]))
    place, _, text = str(refused.value).partition(": ")
    assert message in text
    assert place.startswith("folder/a.py:") and int(place.split(":")[1]) > 8


def test_a_name_of_two_functions_or_values_is_refused() -> None:
    with pytest.raises(SubsetError, match=r"b.py:1: `f`, which is also a function of a.py"):
        translated(Equations({"a.py": body("return x"), "b.py": "def f(x: float) -> float:\n    return x\n"}, ["f"]))
    with pytest.raises(SubsetError, match="`LIMIT`, which has no value here, or several"):
        translated(Equations({"a.py": f"LIMIT = 1\n{body('return x + LIMIT')}", "b.py": "LIMIT = 2\n"}, ["f"]))


class Draw:
    """A random function of the subset; nothing that Python refuses can happen in it."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.reals, self.wholes = ["a", "b", "s.x", "v[0]", "v[j]"], ["n", "k", "s.m"]
        self.lines: list[str] = []

    def real(self, depth: int) -> str:
        pick = self.random.choice
        if depth == 0:
            return pick([*self.reals, repr(round(self.random.uniform(-3, 3), 2)), "LIMIT", f"{pick(self.wholes)} / 7"])
        x, y = self.real(depth - 1), self.real(depth - 1)
        forms = [
            f"{x} + {y}", f"({x}) - ({y})", f"({x}) * ({y})", f"({x}) / (1.5 + abs({y}))", f"-({x})", f"min({x}, {y})",
            f"max({x}, {y}, 0.5)", f"math.sin({x})", f"math.tanh({x})", f"math.exp(-abs({x}))", f"math.sqrt(abs({x}))",
            f"(({x}) if {self.truth(depth - 1)} else {y})", f"helper({x}, {self.whole(depth - 1)})", f"float({self.whole(depth - 1)})",
            f"math.log(1.0 + abs({x}))",
        ]  # fmt: skip
        return pick(forms)

    def whole(self, depth: int) -> str:
        pick = self.random.choice
        if depth == 0:
            return pick([*self.wholes, str(self.random.randint(-9, 9)), "PARTS"])
        x, y = self.whole(depth - 1), self.whole(depth - 1)
        forms = [
            f"(({x}) + ({y})) % 1000", f"(({x}) - ({y})) % 77", f"(({x}) * ({y})) % 1001", f"({x}) // 3", f"({x}) % -7",
            f"min({x}, {y})", f"max({x}, {y})", f"abs({x})", f"int(math.tanh({self.real(depth - 1)}) * 50.0)",
            f"math.ceil(3.0 * math.sin({self.real(depth - 1)}))", f"(({x}) if {self.truth(depth - 1)} else {y})",
        ]  # fmt: skip
        return pick(forms)

    def truth(self, depth: int) -> str:
        x, y = self.real(max(0, depth - 1)), self.real(max(0, depth - 1))
        forms = [
            f"({x}) < ({y})",
            f"-2.0 <= ({self.random.choice(self.reals)}) < ({y})",
            f"{self.whole(0)} != {self.whole(0)}",
        ]
        if depth > 0:
            forms += [f"not ({self.truth(depth - 1)})", f"({self.truth(depth - 1)} or {self.truth(depth - 1)}) and n > 0"]
        return self.random.choice(forms)

    def statements(self, indent: str, depth: int) -> None:
        for _ in range(self.random.randint(1, 4)):
            self.statement(indent, depth)

    def statement(self, indent: str, depth: int) -> None:
        kind = self.random.randint(0, 9 if depth > 0 else 6)
        if kind <= 1:
            self.lines.append(f"{indent}{self.random.choice(self.reals)} = {self.real(2)}")
        elif kind == 2:
            self.lines.append(
                f"{indent}{self.random.choice(self.reals)} {self.random.choice('+-*')}= math.tanh({self.real(2)})"
            )
        elif kind == 3:
            self.lines.append(f"{indent}{self.random.choice(self.wholes)} = {self.whole(2)}")
        elif kind == 4:
            self.lines.append(f"{indent}a, k = twice({self.real(1)}, {self.whole(1)})")
        elif kind == 5:
            self.lines.append(f"{indent}b, n = {self.random.choice(['a', 's.x'])} * 0.5, k % 9")
        elif kind == 6:
            self.lines.append(f"{indent}s.x = change(s, {self.real(1)})")
        elif kind == 7:
            self.lines.append(f"{indent}if {self.truth(2)}:")
            self.statements(indent + "    ", depth - 1)
            if self.random.random() < 0.6:
                self.lines.append(f"{indent}elif {self.truth(1)}:")
                self.statements(indent + "    ", depth - 1)
                self.lines.append(f"{indent}else:")
                self.statements(indent + "    ", depth - 1)
        else:
            counter = f"i{depth}"
            self.lines.append(
                f"{indent}for {counter} in range({self.whole(1)} % 5, {self.random.choice(['6', 'abs(k) % 8'])}):"
            )
            self.statements(indent + "    ", depth - 1)
            self.lines.append(f"{indent}    b = math.tanh(b) + {counter}")
            if self.random.random() < 0.3:
                self.lines += [f"{indent}    if {self.truth(1)}:", f"{indent}        break"]

    def function(self, name: str) -> str:
        self.lines = [f"def {name}(s: Rec, v: Vector, a: float, b: float, n: int, k: int) -> float:", "    j = n % 3"]
        self.statements("    ", 2)
        self.lines.append(f"    return {self.real(2)}")
        return "\n".join(self.lines) + "\n"


COMMON = """
LIMIT, PARTS = 1.75, 5


@dataclass
class Rec:
    x: float = var("", "", "1", "x", default=0.0)
    m: int = var("", "", "1", "m", integer=True, default=0)


def helper(x: float, n: int) -> float:
    return x * 0.5 if n % 2 == 0 else x / (2.0 + abs(n))


def twice(x: float, n: int) -> tuple[float, int]:
    return helper(x, n), n % 50


def change(s: Rec, x: float) -> float:
    s.m = (s.m + 1) % 13
    return math.tanh(s.x + x)


"""


@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.slow) for seed in (1, 2))])
def test_random_functions_give_the_bits_of_the_interpreter(seed: int, tmp_path: Path) -> None:
    names = [f"f{i}" for i in range(60)]
    source = COMMON + "\n\n".join(Draw(1000 * seed + i).function(name) for i, name in enumerate(names))
    c = in_c("from dataclasses import dataclass\n" + source, names, tmp_path, warnings=())  # what is drawn may be silly
    python = in_python(source[source.index("def helper") :] + "\nLIMIT, PARTS = 1.75, 5\n")
    dtype = np.dtype([("x", float), ("m", np.int64)], align=True)
    drawn = random.Random(seed)
    for name in names:
        for _ in range(20):
            given = [drawn.uniform(-5, 5), drawn.uniform(-5, 5), drawn.randint(-20, 20), drawn.randint(-20, 20)]
            start = [drawn.uniform(-2, 2) for _ in range(3)]
            s, v = SimpleNamespace(x=0.3, m=4), list(start)
            row, values = np.array([(0.3, 4)], dtype), np.array(start)
            expected = python[name](s, v, *given)
            found = getattr(c, name)(row, values, *given)
            assert same(found, float(expected)), (name, given)
            assert row.item() == (s.x, s.m) or math.isnan(s.x)
            assert np.array_equal(values, np.array(v), equal_nan=True)
