"""Expressions of the subset in C, with the meaning that Python gives them.

Where both differ Python's counts: `/` of whole numbers, `//`, `%`, chains of comparisons, `min` and `max` with NaN, the
order in which calls happen. Where Python raises (division by zero, root of a negative number) C gives inf or NaN.
"""

import ast
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NoReturn

from twintube.native.kinds import BOOL, FLOAT, INT, SIZES, Kind, constant, refuse
from twintube.native.mathematics import MATH, MATH_CONSTANTS, ROUNDED
from twintube.native.terms import AND, ATOM, CHOICE, COMPARED, OR, PRODUCT, SUM, UNARY, Function, Known, Term, number, quiet

OPERATORS = {ast.Add: ("+", SUM), ast.Sub: ("-", SUM), ast.Mult: ("*", PRODUCT), ast.Div: ("/", PRODUCT)}
HELPED = {ast.FloorDiv: "floor_div", ast.Mod: "modulo"}  # of whole numbers
COMPARISONS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!="}


@dataclass
class Expressions:
    """Expressions of one function; `local` are its names, `roots` the argument behind each that is a reference."""

    known: Known
    path: str
    local: dict[str, Kind] = field(default_factory=dict)
    roots: dict[str, str] = field(default_factory=dict)
    written: set[str] = field(default_factory=set)

    def refuse(self, node: ast.AST, what: str) -> NoReturn:
        """Raise SubsetError at a node."""
        refuse(self.path, node, what)

    def term(self, node: ast.expr) -> Term:  # noqa: PLR0911 - a return for each kind
        """An expression."""
        match node:
            case ast.Constant(value=bool() as value):
                return Term("true" if value else "false", BOOL)
            case ast.Constant(value=int() | float() as value):
                return number(value)
            case ast.Name(id=name):
                return self.name(node, name)
            case ast.Attribute(value=ast.Name(id="math"), attr=name) if name in MATH_CONSTANTS:
                return Term(MATH_CONSTANTS[name], FLOAT)
            case ast.Attribute():
                return self.attribute(node)
            case ast.Subscript():
                return self.subscript(node)
            case ast.BinOp():
                return self.operation(node)
            case ast.UnaryOp():
                return self.signed(node)
            case ast.BoolOp(op=op, values=values):
                sign, level = ("||", OR) if isinstance(op, ast.Or) else ("&&", AND)
                parts = [self.condition(value) for value in values]
                # Brackets around `&&` in `||`, for readers.
                return Term(f" {sign} ".join(part.within(COMPARED) for part in parts), BOOL, level)
            case ast.Compare():
                return self.comparison(node)
            case ast.IfExp():
                return self.choice(node)
            case ast.Call():
                return self.call(node)
        self.refuse(node, f"`{ast.unparse(node)}`")

    def name(self, node: ast.expr, name: str) -> Term:
        """A local name or a constant."""
        if name in self.local:
            return Term(name, self.local[name])
        if name in self.known.constants:
            self.known.used.add(name)
            kind = INT if isinstance(self.known.constants[name], int) else FLOAT
            return Term(f"{self.known.types.prefix}{name}", kind)
        self.refuse(node, f"`{name}`, which has no value here, or several")

    def number(self, node: ast.expr) -> Term:
        """An expression that is a number."""
        found = self.term(node)
        if not found.kind.number:
            self.refuse(node, f"`{ast.unparse(node)}` as a number")
        return found

    def whole(self, node: ast.expr) -> Term:
        """An expression that is a whole number."""
        found = self.term(node)
        if found.kind != INT:
            self.refuse(node, f"`{ast.unparse(node)}` as a whole number")
        return found

    def condition(self, node: ast.expr) -> Term:
        """An expression that is true or false; Python has other truths, which C has not."""
        found = self.term(node)
        if found.kind != BOOL:
            self.refuse(node, f"`{ast.unparse(node)}` as a condition: write a comparison")
        return found

    def attribute(self, node: ast.Attribute) -> Term:
        """A field of a record or bundle; a record in an array is reached by a dot."""
        if node.attr == "shape":
            self.refuse(node, "the shape of an array but for `shape[0]`")
        of = self.term(node.value)
        if of.kind.word not in ("record", "bundle"):
            self.refuse(node, f"`{ast.unparse(node)}`")
        found = self.known.types.members(of.kind).get(node.attr)
        if found is None:
            self.refuse(node, f"`{ast.unparse(node)}`: {of.kind.of} has no such field")
        if of.text.startswith("&"):
            return Term(f"{of.text[1:]}.{node.attr}", found.kind)
        return Term(f"{of.within(ATOM)}->{node.attr}", found.kind)

    def subscript(self, node: ast.Subscript) -> Term:
        """An element, a row, or a record of an array."""
        if isinstance(node.value, ast.Attribute) and node.value.attr == "shape":
            return self.size(node, node.value.value, node.slice)
        of = self.term(node.value)
        places = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        at = [self.whole(place) for place in places]
        if any(term.text.startswith("-") for term in at):
            self.refuse(node, f"`{ast.unparse(node)}`: a place from the end")
        if of.kind.word == "fixed" and len(at) == 1:
            return Term(f"{of.within(ATOM)}[{at[0].text}]", FLOAT)
        if of.kind.word == "records" and len(at) == 1:
            return Term(f"&{of.within(ATOM)}[{at[0].text}]", Kind("record", of.kind.of), UNARY)
        if of.kind.word != "array" or len(at) not in (1, of.kind.rank) or of.kind.rank > len(at) + 1:
            self.refuse(node, f"`{ast.unparse(node)}`")
        return self.element(of, at)

    def element(self, of: Term, at: Sequence[Term]) -> Term:
        """An element of an array, or the row of a table."""
        place = at[0]
        for size, term in zip(SIZES[1:], at[1:], strict=False):
            place = Term(f"{place.within(PRODUCT)} * {of.text}.{size} + {term.within(PRODUCT)}", INT, SUM)
        if len(at) == of.kind.rank:
            return Term(f"{of.text}.data[{place.text}]", FLOAT if of.kind.of == "float" else INT)
        row = Kind("array", of.kind.of, of.kind.rank - 1)
        columns = f"{of.text}.columns"
        start = f"{at[0].within(PRODUCT)} * {columns}"
        return Term(f"({self.known.types.c_name(row).strip()}){{{of.text}.data + {start}, {columns}}}", row)

    def size(self, node: ast.expr, of: ast.expr, place: ast.expr) -> Term:
        """The length of an array along one of its directions."""
        array = self.term(of)
        match place:
            case ast.Constant(value=int() as i) if array.kind.word == "array" and 0 <= i < array.kind.rank:
                return Term(f"{array.text}.{SIZES[i]}", INT)
        self.refuse(node, f"`{ast.unparse(node)}`")

    def operation(self, node: ast.BinOp) -> Term:
        """Arithmetic of two numbers."""
        self.in_order([node.left, node.right])
        left, right = self.number(node.left), self.number(node.right)
        kind = INT if (left.kind, right.kind) == (INT, INT) else FLOAT
        operator = type(node.op)
        if operator in HELPED and kind == INT:
            return Term(f"{self.helper(HELPED[operator])}({left.text}, {right.text})", INT)
        if operator not in OPERATORS:
            self.refuse(node, f"`{ast.unparse(node)}`")
        sign, level = OPERATORS[operator]
        first = left.within(level)
        if operator is ast.Div:
            first = f"(double){left.within(UNARY)}" if kind == INT else first
            kind = FLOAT
        return Term(f"{first} {sign} {right.within(level + 1)}", kind, level)

    def signed(self, node: ast.UnaryOp) -> Term:
        """`-x` and `not x`."""
        if isinstance(node.op, ast.Not):
            return Term(f"!{self.condition(node.operand).within(UNARY)}", BOOL, UNARY)
        if not isinstance(node.op, ast.USub):
            self.refuse(node, f"`{ast.unparse(node)}`")
        of = self.number(node.operand)
        return Term(f"-{of.within(ATOM)}", of.kind, UNARY)

    def comparison(self, node: ast.Compare) -> Term:
        """A chain of comparisons; what stands between two is read twice in C, so it must be without a call."""
        parts = [node.left, *node.comparators]
        self.in_order(parts)
        if len(parts) > 2 and any(isinstance(item, ast.Call) for part in parts[1:-1] for item in ast.walk(part)):
            self.refuse(node, f"a call between two comparisons, `{ast.unparse(node)}`")
        terms = [self.term(part) for part in parts]
        for operator, left, right in zip(node.ops, terms[:-1], terms[1:], strict=True):
            truths = left.kind == right.kind == BOOL and isinstance(operator, ast.Eq | ast.NotEq)
            if type(operator) not in COMPARISONS or not (truths or (left.kind.number and right.kind.number)):
                self.refuse(node, f"`{ast.unparse(node)}`")
        single = [
            f"{left.within(SUM)} {COMPARISONS[type(operator)]} {right.within(SUM)}"
            for operator, left, right in zip(node.ops, terms[:-1], terms[1:], strict=True)
        ]
        return Term(" && ".join(single), BOOL, COMPARED if len(single) == 1 else AND)

    def choice(self, node: ast.IfExp) -> Term:
        """`a if condition else b`."""
        test, first, second = self.condition(node.test), self.term(node.body), self.term(node.orelse)
        if first.kind.whole or (first.kind != second.kind and not (first.kind.number and second.kind.number)):
            self.refuse(node, f"`{ast.unparse(node)}`: a choice but of numbers or truths")
        kind = first.kind if first.kind == second.kind else FLOAT
        return Term(f"{test.within(OR)} ? {first.within(OR)} : {second.within(CHOICE)}", kind, CHOICE)

    def call(self, node: ast.Call) -> Term:
        """A call of a function of the sources, of `math`, or of the few built in."""
        if node.keywords or any(isinstance(argument, ast.Starred) for argument in node.args):
            self.refuse(node, f"arguments by name or a list of them, `{ast.unparse(node)}`")
        self.in_order(node.args)
        match node.func:
            case ast.Attribute(value=ast.Name(id="math"), attr=name):
                return self.mathematics(node, name)
            case ast.Name(id="len") if len(node.args) == 1:
                return self.size(node, node.args[0], ast.Constant(0))
            case ast.Name(id="int" | "float" | "abs" | "min" | "max" as name):
                return self.built_in(node, name)
            case ast.Name(id=name) if name in self.known.functions:
                return self.own(node, self.known.functions[name])
        self.refuse(node, f"a call of `{ast.unparse(node.func)}`")

    def mathematics(self, node: ast.Call, name: str) -> Term:
        """A function of `math`; of constants Python's result, as a compiler may round otherwise."""
        value = constant(node, self.known.constants)
        if value is not None:
            return number(value)
        arguments = [self.number(argument) for argument in node.args]
        if name in ROUNDED and len(arguments) == 1:
            return Term(f"(int64_t){name}({arguments[0].text})", INT, UNARY)
        if MATH.get(name) != len(arguments):
            self.refuse(node, f"a call of `math.{name}` with {len(arguments)} arguments")
        return Term(f"{name}({', '.join(argument.text for argument in arguments)})", FLOAT)

    def built_in(self, node: ast.Call, name: str) -> Term:
        """`int`, `float`, `abs`, `min` and `max` of numbers."""
        arguments = [self.number(argument) for argument in node.args]
        kind = INT if all(argument.kind == INT for argument in arguments) else FLOAT
        if name in ("min", "max") and len(arguments) > 1:
            helper = self.helper(name if kind == FLOAT else f"whole_{name}")
            text = arguments[0].text
            for argument in arguments[1:]:
                text = f"{helper}({text}, {argument.text})"
            return Term(text, kind)
        if len(arguments) != 1 or name in ("min", "max"):
            self.refuse(node, f"`{ast.unparse(node)}`")
        if name == "abs":
            return Term(f"{'fabs' if kind == FLOAT else self.helper('whole_abs')}({arguments[0].text})", kind)
        if (name == "int") == (kind == INT):
            return arguments[0]
        return Term(
            f"({'int64_t' if name == 'int' else 'double'}){arguments[0].within(UNARY)}",
            INT if name == "int" else FLOAT,
            UNARY,
        )

    def own(self, node: ast.Call, function: Function) -> Term:
        """A call of a function of the sources; notes which arguments of this function it changes."""
        if len(node.args) != len(function.arguments):
            self.refuse(node, f"{len(node.args)} arguments for `{function.name}`, which has {len(function.arguments)}")
        texts = []
        for i, (argument, (name, kind)) in enumerate(zip(node.args, function.arguments, strict=True)):
            term = self.term(argument)
            if term.kind != kind and (term.kind, kind) != (INT, FLOAT):
                self.refuse(argument, f"`{ast.unparse(argument)}` for `{name}` of `{function.name}`: another type")
            if i in function.writes:
                self.write(argument)
            texts.append(term.text)
        return Term(f"{self.known.types.prefix}{function.name}({', '.join(texts)})", function.result)

    def in_order(self, parts: Sequence[ast.expr]) -> None:
        """Refuse parts whose order counts, as C has none: a call that changes records beside what reads them."""
        for changing in parts:
            if self.changes(changing) and not all(part is changing or quiet(part) for part in parts):
                self.refuse(changing, f"`{ast.unparse(changing)}` changes its arguments: give it a statement of its own")

    def changes(self, node: ast.expr) -> bool:
        """Whether an expression calls a function that changes something."""
        called = (item.func.id for item in ast.walk(node) if isinstance(item, ast.Call) and isinstance(item.func, ast.Name))
        return any(self.known.functions[name].writes for name in called if name in self.known.functions)

    def write(self, node: ast.expr) -> None:
        """Note that what an expression refers to is changed."""
        root = self.root(node)
        if root is not None:
            self.written.add(root)

    def root(self, node: ast.expr) -> str | None:
        """The argument that an expression refers to."""
        while isinstance(node, ast.Attribute | ast.Subscript):
            node = node.value
        return self.roots.get(node.id) if isinstance(node, ast.Name) else None

    def helper(self, name: str) -> str:
        """The name of a function of the head in C."""
        self.known.used.add(name)
        return f"{self.known.types.prefix}{name}"
