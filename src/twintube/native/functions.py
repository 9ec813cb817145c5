"""Statements and functions of the subset in C, with the comments of the source."""

import ast
from collections.abc import Sequence
from dataclasses import dataclass, field

from twintube.native.expressions import Expressions
from twintube.native.kinds import BOOL, FLOAT, INT, NONE, Kind
from twintube.native.layout import folded, remark
from twintube.native.source import TAKEN, Source, first_stores, steady
from twintube.native.terms import Function, Known, Term

INDENT = "    "
OPERATIONS = {ast.Add: "+=", ast.Sub: "-=", ast.Mult: "*=", ast.Div: "/="}


@dataclass
class Writer:
    """Writes one function."""

    source: Source
    known: Known
    function: Function
    lines: list[str] = field(default_factory=list)
    above: dict[str, Kind] = field(default_factory=dict)  # declared at the top
    counters: set[str] = field(default_factory=set)  # of the loops around
    depth: int = 1
    said: int = 0  # line up to which comments are written
    fresh: int = 0  # names of its own

    def __post_init__(self) -> None:
        self.expressions = Expressions(self.known, self.source.path)
        for name, kind in self.function.arguments:
            self.expressions.local[name] = kind
            if kind.whole:
                self.expressions.roots[name] = name
        self.direct = {id(store) for store in first_stores(self.source.node)}

    def written(self) -> frozenset[int]:
        """The numbers of the arguments that the function changes."""
        return frozenset(i for i, (name, _) in enumerate(self.function.arguments) if name in self.expressions.written)

    def text(self, *, exported: bool) -> str:
        """The whole function."""
        body = list(self.source.node.body)
        head = []
        if isinstance(body[0], ast.Expr) and isinstance(body[0].value, ast.Constant):
            head = remark(str(body[0].value.value))
            self.said = body[0].end_lineno or 0
            del body[0]
        else:
            self.said = body[0].lineno - 1
        self.block(body)
        kinds = [f"{self.known.types.c_name(kind)}{name}" for name, kind in self.function.arguments]
        prefix = self.known.types.prefix
        result = self.known.types.c_name(self.function.result, self.function.name)
        opening = (
            f"{'EXPORTED' if exported else 'static'} {result}{prefix}{self.function.name}({', '.join(kinds) or 'void'})"
        )
        top = [f"{INDENT}{self.known.types.c_name(kind)}{name};" for name, kind in self.above.items()]
        unused = [
            f"{INDENT}(void){name};"
            for name, _ in self.function.arguments
            if not any(isinstance(item, ast.Name) and item.id == name for part in body for item in ast.walk(part))
        ]
        return "\n".join([*head, *folded(opening), "{", *top, *unused, *self.lines, "}", ""])

    def put(self, text: str, node: ast.stmt | None = None) -> None:
        """A line, with the comment that stands beside the statement."""
        if node is not None:
            last = getattr(node, "test", node).end_lineno or 0
            at = self.source.comments.get(node.lineno) or self.source.comments.get(last)
            if at is not None and not at[0]:
                text += f" /* {at[1]} */"
        self.lines += folded(INDENT * self.depth + text)

    def block(self, statements: Sequence[ast.stmt]) -> None:
        """Statements one after the other, each below the comments above it."""
        for statement in statements:
            above = (self.source.comments.get(line, (False, "")) for line in range(self.said + 1, statement.lineno))
            said = [words for alone, words in above if alone]
            if said:
                self.lines += [INDENT * self.depth + line for line in remark("\n".join(said))]
            self.said = max(self.said, statement.lineno)
            self.statement(statement)

    def inner(self, opening: str, statements: Sequence[ast.stmt], node: ast.stmt | None = None) -> None:
        """A block in braces below its opening line."""
        self.put(f"{opening} {{", node)
        self.depth += 1
        self.block(statements)
        self.depth -= 1

    def statement(self, node: ast.stmt) -> None:
        """One statement."""
        match node:
            case ast.Assign(targets=[target], value=value):
                self.assign(node, target, value)
            case ast.AnnAssign(target=target, value=ast.expr() as value):
                self.assign(node, target, value)
            case ast.AugAssign():
                self.change(node)
            case ast.Expr(value=ast.Call() as call):
                self.put(f"{self.expressions.term(call).text};", node)
            case ast.Return():
                self.leave(node)
            case ast.If():
                self.decide(node)
            case ast.While(test=test, body=body, orelse=[]):
                self.inner(f"while ({self.expressions.condition(test).text})", body, node)
                self.put("}")
            case ast.For(orelse=[]):
                self.count(node)
            case ast.Break():
                self.put("break;", node)
            case ast.Continue():
                self.put("continue;", node)
            case ast.Pass():
                pass
            case _:
                self.expressions.refuse(node, f"`{ast.unparse(node).splitlines()[0]}`")

    def decide(self, node: ast.If) -> None:
        """`if` with all its branches."""
        self.inner(f"if ({self.expressions.condition(node.test).text})", node.body, node)
        while len(node.orelse) == 1 and isinstance(node.orelse[0], ast.If) and node.orelse[0].col_offset == node.col_offset:
            node = node.orelse[0]
            self.inner(f"}} else if ({self.expressions.condition(node.test).text})", node.body, node)
        if node.orelse:
            self.inner("} else", node.orelse)
        self.put("}")

    def count(self, node: ast.For) -> None:
        """`for i in range(...)`; the end is computed once, and nobody but the loop changes the counter."""
        match node:
            case ast.For(target=ast.Name(id=name), iter=ast.Call(func=ast.Name(id="range"), args=[*given], keywords=[])):
                pass
            case _:
                self.expressions.refuse(node, f"a loop over `{ast.unparse(node.iter)}`: only over a range")
        if name in self.expressions.local or name in TAKEN:
            self.expressions.refuse(node, f"the counter `{name}`, which is a name already")
        step = 1
        if len(given) == 3:
            match given.pop():
                case (
                    ast.Constant(value=int() as step) | ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=int() as step))
                ):
                    step = -step if isinstance(node.iter.args[2], ast.UnaryOp) else step  # type: ignore[attr-defined]
                case _:
                    step = 0
        if step == 0:
            self.expressions.refuse(node, "a step of a range that is no number")
        first = self.expressions.whole(given[0]).text if len(given) == 2 else "0"
        last = self.expressions.whole(given[-1])
        end = last.text
        if not (isinstance(given[-1], ast.Constant) or steady(given[-1], node.body, self.known.constants)):
            end = self.named("end")
            self.put(f"const int64_t {end} = {last.text};")
        self.expressions.local[name] = INT
        self.counters.add(name)
        forward = "++" if step == 1 else "--" if step == -1 else f" += {step}" if step > 0 else f" -= {-step}"
        self.inner(
            f"for (int64_t {name} = {first}; {name} {'<' if step > 0 else '>'} {end}; {name}{forward})", node.body, node
        )
        self.put("}")
        self.counters.discard(name)
        del self.expressions.local[name]

    def named(self, word: str) -> str:
        """A name that nothing else has."""
        self.fresh += 1
        return f"{word}_{self.fresh}_"

    def change(self, node: ast.AugAssign) -> None:
        """`x += y` and its like."""
        target, value = self.place(node, node.target), self.expressions.number(node.value)
        if not isinstance(node.target, ast.Name):
            self.expressions.in_order([node.value, node.target])
        if type(node.op) not in OPERATIONS or (target.kind == INT and (value.kind != INT or isinstance(node.op, ast.Div))):
            self.expressions.refuse(node, f"`{ast.unparse(node)}`")
        self.put(f"{target.text} {OPERATIONS[type(node.op)]} {value.text};", node)

    def place(self, node: ast.stmt, target: ast.expr) -> Term:
        """A number that is changed: a local one, a field or an element."""
        if isinstance(target, ast.Name) and (target.id in self.counters or target.id not in self.expressions.local):
            self.expressions.refuse(node, f"`{target.id}` is changed, which has no value here or counts a loop")
        found = self.expressions.term(target)
        if not found.kind.number and found.kind != BOOL:
            self.expressions.refuse(node, f"`{ast.unparse(target)}` is changed, which is no number")
        self.expressions.write(target)
        return found

    def assign(self, node: ast.stmt, target: ast.expr, value: ast.expr) -> None:
        """`x = y`, several at once, or the results of a function."""
        match target, value:
            case ast.Tuple(elts=targets), ast.Tuple(elts=values) if len(targets) == len(values):
                self.independent(node, targets, values)
                for i, (one, its) in enumerate(zip(targets, values, strict=True)):
                    self.single(node, one, self.expressions.term(its), its, said=i == 0)
            case ast.Tuple(elts=targets), ast.Call():
                self.results(node, targets, self.expressions.term(value))
            case ast.Tuple(), _:
                self.expressions.refuse(node, f"`{ast.unparse(node)}`")
            case _:
                self.single(node, target, self.expressions.term(value), value)

    def independent(self, node: ast.stmt, targets: Sequence[ast.expr], values: Sequence[ast.expr]) -> None:
        """Refuse values that an assignment before theirs changes: Python computes them all first."""
        for i, target in enumerate(targets):
            for later in values[i + 1 :]:
                parts = [part for part in ast.walk(later) if isinstance(part, ast.Name | ast.Attribute | ast.Subscript)]
                if any(ast.unparse(part) == ast.unparse(target) for part in parts) or (
                    isinstance(target, ast.Subscript)
                    and any(
                        isinstance(p, ast.Subscript) and ast.unparse(p.value) == ast.unparse(target.value) for p in parts
                    )
                ):
                    self.expressions.refuse(node, f"`{ast.unparse(node)}`: a value that is changed before it is read")
        self.expressions.in_order(values)

    def results(self, node: ast.stmt, targets: Sequence[ast.expr], call: Term) -> None:
        """Take the results of a function apart."""
        if call.kind.word != "results" or len(call.kind.parts) != len(targets):
            self.expressions.refuse(node, f"`{ast.unparse(node)}`")
        whole = self.named("got")
        function = call.text.split("(")[0].removeprefix(self.known.types.prefix)
        self.put(f"const {self.known.types.c_name(call.kind, function)}{whole} = {call.text};", node)
        for i, (target, kind) in enumerate(zip(targets, call.kind.parts, strict=True)):
            if not (isinstance(target, ast.Name) and target.id == "_"):
                self.single(node, target, Term(f"{whole}.r{i}", kind), ast.Constant(0), said=False)

    def single(self, node: ast.stmt, target: ast.expr, value: Term, tree: ast.expr, *, said: bool = True) -> None:
        """One value to one place."""
        beside = node if said else None
        if not isinstance(target, ast.Name):
            if isinstance(target, ast.Subscript):
                self.expressions.in_order([tree, target.slice])
            place = self.place(node, target)
            self.fits(node, place.kind, value.kind)
            self.put(f"{place.text} = {value.text};", beside)
            return
        name = target.id
        if name in self.counters or name in TAKEN or value.kind.word in ("none", "results", "records", "bundle"):
            self.expressions.refuse(node, f"`{ast.unparse(node)}`")
        known = self.expressions.local.get(name)
        if known is None:
            self.expressions.local[name] = value.kind
            if value.kind.whole:
                root = self.expressions.root(tree)
                if root is not None:
                    self.expressions.roots[name] = root
            if id(target) in self.direct:
                self.put(f"{self.known.types.c_name(value.kind)}{name} = {value.text};", beside)
                return
            self.above[name] = value.kind
        elif known.whole:
            self.expressions.refuse(node, f"`{name}` refers to something else already")
        else:
            self.fits(node, known, value.kind)
        self.put(f"{name} = {value.text};", beside)

    def fits(self, node: ast.stmt, wanted: Kind, given: Kind) -> None:
        """Refuse a value of another type; a whole number may become a real one."""
        if wanted != given and (wanted, given) != (FLOAT, INT):
            self.expressions.refuse(node, f"`{ast.unparse(node)}`: {given.word} where {wanted.word} is")

    def leave(self, node: ast.Return) -> None:
        """`return`, with a value, several or none."""
        result = self.function.result
        match node.value:
            case None if result == NONE:
                self.put("return;", node)
            case ast.Tuple(elts=values) if result.word == "results" and len(values) == len(result.parts):
                self.expressions.in_order(values)
                terms = [self.expressions.term(value) for value in values]
                for term, kind in zip(terms, result.parts, strict=True):
                    self.fits(node, kind, term.kind)
                kind_name = self.known.types.c_name(result, self.function.name).strip()
                self.put(f"return ({kind_name}){{{', '.join(term.text for term in terms)}}};", node)
            case ast.expr() as value if result.word != "results":
                term = self.expressions.term(value)
                self.fits(node, result, term.kind)
                self.put(f"return {term.text};", node)
            case _:
                self.expressions.refuse(node, f"`{ast.unparse(node)}` from a function of {result.word}")
