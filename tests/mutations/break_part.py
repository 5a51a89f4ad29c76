"""Single breaks of a module's source: a sign, a constant, an operator, a comparison, two arguments.

A break is a change of a few letters in one place, so the page can show the line before and after.
Left alone is what calculates nothing: texts and all that is raised, annotations, decorators,
``__repr__`` and ``__str__``, f-strings, imports, blocks for type checkers, the `stacklevel` of a
warning, and the `strict` of a `zip`, which only guards. Left alone is also what surely does the
same: the two arguments of a maximum, the two axes that are swapped, the -1 of a reshape, the sign
of a difference whose size is taken.
"""

import ast
from types import CodeType
from typing import NamedTuple

_SWAPS = {
    "sin": "cos", "sinh": "cosh", "arcsin": "arccos", "tan": "sin", "arctan": "arcsin",
    "min": "max", "minimum": "maximum", "argmin": "argmax", "any": "all", "floor": "ceil",
    "zeros": "ones", "zeros_like": "ones_like", "real": "imag", "radians": "degrees",
    "deg2rad": "rad2deg",
}  # fmt: skip
SWAPPED_NAMES = {**{there: here for here, there in _SWAPS.items()}, **_SWAPS}

_OPERATORS: dict[type[ast.operator], tuple[str, str]] = {
    ast.Add: ("+", "-"), ast.Sub: ("-", "+"), ast.Mult: ("*", "/"), ast.Div: ("/", "*"),
    ast.FloorDiv: ("//", "%"), ast.Mod: ("%", "//"), ast.Pow: ("**", "*"), ast.MatMult: ("@", "*"),
    ast.BitAnd: ("&", "|"), ast.BitOr: ("|", "&"),
}  # fmt: skip
_TURNED_ROUND = (ast.Sub, ast.Div, ast.MatMult, ast.Pow)  # these do not commute
_COMPARISONS: dict[type[ast.cmpop], tuple[str, tuple[str, ...]]] = {
    ast.Lt: ("<", ("<=", ">=")), ast.LtE: ("<=", ("<", ">")), ast.Gt: (">", (">=", "<=")),
    ast.GtE: (">=", (">", "<")), ast.Eq: ("==", ("!=",)), ast.NotEq: ("!=", ("==",)),
    ast.Is: ("is", ("is not",)), ast.IsNot: ("is not", ("is",)),
    ast.In: ("in", ("not in",)), ast.NotIn: ("not in", ("in",)),
}  # fmt: skip
_SYMMETRIC = {
    "max", "min", "maximum", "minimum", "hypot", "union1d", "vecdot", "broadcast_shapes",
    "logical_and", "logical_or", "add",
}  # fmt: skip
_SIZES = {"abs": 1, "absolute": 1, "fabs": 1, "norm": 1, "norms": 1, "hypot": 2}
"""Of how many first arguments only the size counts."""
_UNTOUCHED_ARGUMENTS = {"stacklevel", "strict"}
_UNTOUCHED_FUNCTIONS = {"__repr__", "__str__"}


class Break(NamedTuple):
    """A change of one place; positions are bytes of the source."""

    kind: str
    line: int
    lines: tuple[int, int]
    """First and last line of the statement, for a compound one of its head."""
    start: int
    end: int
    new: str


def breaks(source: str) -> list[Break]:
    """All places of a module's source and what to write there, in the order of the source.

    Few of them are no Python, or the same program; `broken_code` tells.
    """
    finder = _Finder(source)
    finder.visit_body(ast.parse(source).body)
    return sorted(set(finder.found), key=lambda each: (each.start, each.end, each.new))


def broken(source: str, change: Break) -> str:
    """The source with one break."""
    raw = source.encode()
    return (raw[: change.start] + change.new.encode() + raw[change.end :]).decode()


def broken_code(source: str, change: Break, path: str) -> CodeType | None:
    """The module's code with one break; none if that is no Python, or does the same."""
    try:
        code = compile(broken(source, change), path, "exec", dont_inherit=True)
    except SyntaxError:
        return None
    same = same_code(code, compile(source, path, "exec", dont_inherit=True))
    return None if same else code


def line_before_and_after(source: str, change: Break) -> tuple[str, str]:
    """What stands in the changed line, or lines, without the indentation."""
    raw = source.encode()
    first = raw.rfind(b"\n", 0, change.start) + 1
    last = raw.find(b"\n", change.end)
    last = len(raw) if last < 0 else last
    before = raw[first:last].decode()
    after = (raw[first : change.start] + change.new.encode() + raw[change.end : last]).decode()
    return " ".join(before.split()), " ".join(after.split())


def same_code(first: CodeType, second: CodeType) -> bool:
    """Whether two codes do the same, wherever their lines stand."""
    if (first.co_code, first.co_names, first.co_varnames, first.co_exceptiontable) != (
        second.co_code,
        second.co_names,
        second.co_varnames,
        second.co_exceptiontable,
    ):
        return False
    return len(first.co_consts) == len(second.co_consts) and all(
        same_code(one, other)
        if isinstance(one, CodeType) and isinstance(other, CodeType)
        else (type(one), repr(one)) == (type(other), repr(other))  # repr tells -0.0 from 0.0
        for one, other in zip(first.co_consts, second.co_consts, strict=True)
    )


class _Finder(ast.NodeVisitor):
    """Walks through a module and notes what could be broken."""

    def __init__(self, source: str) -> None:
        self._raw = source.encode()
        self._starts = [0]
        for line in self._raw.splitlines(keepends=True):
            self._starts.append(self._starts[-1] + len(line))
        self._lines = (1, 1)
        self._sign_is_lost: set[ast.AST] = set()
        self.found: list[Break] = []

    def visit_body(self, statements: list[ast.stmt]) -> None:
        for statement in statements:
            if not (isinstance(statement, ast.Expr) and _is_text(statement.value)):
                self.visit(statement)

    def visit(self, node: ast.AST) -> None:
        if isinstance(node, ast.stmt):
            body = getattr(node, "body", None)
            last = body[0].lineno - 1 if body else node.end_lineno
            self._lines = (node.lineno, max(node.lineno, last or node.lineno))
        super().visit(node)

    def generic_visit(self, node: ast.AST) -> None:
        for _, value in ast.iter_fields(node):
            if isinstance(value, list):
                if value and isinstance(value[0], ast.stmt):
                    self.visit_body(value)
                else:
                    for each in value:
                        if isinstance(each, ast.AST):
                            self.visit(each)
            elif isinstance(value, ast.AST):
                self.visit(value)

    def _start(self, node: ast.AST) -> int:
        return self._starts[node.lineno - 1] + node.col_offset  # type: ignore[attr-defined]

    def _end(self, node: ast.AST) -> int:
        return self._starts[node.end_lineno - 1] + node.end_col_offset  # type: ignore[attr-defined]

    def _text(self, node: ast.AST) -> str:
        return self._raw[self._start(node) : self._end(node)].decode()

    def _note(self, kind: str, start: int, end: int, new: str) -> None:
        line = self._raw.count(b"\n", 0, start) + 1
        self.found.append(Break(kind, line, self._lines, start, end, new))

    def _between(self, left: ast.AST, right: ast.AST, sign: str) -> tuple[int, int] | None:
        """Where an operator stands; none if brackets or comments make that doubtful."""
        start, end = self._end(left), self._start(right)
        gap = self._raw[start:end].decode()
        if gap.strip(" \n\\()") != sign or sign not in gap:
            return None
        begin = start + len(gap[: gap.index(sign)].encode())
        return begin, begin + len(sign)

    def _swap(self, kind: str, first: ast.AST, second: ast.AST) -> None:
        start, end = self._start(first), self._end(second)
        middle = self._raw[self._end(first) : self._start(second)].decode()
        self._note(kind, start, end, self._text(second) + middle + self._text(first))

    # --- what is left alone ---

    def _leave_alone(self, node: ast.AST) -> None:
        """Texts, and what calculates nothing."""

    visit_Raise = visit_JoinedStr = visit_Import = visit_ImportFrom = _leave_alone

    def visit_FunctionDef(self, node: ast.FunctionDef) -> None:
        if node.name not in _UNTOUCHED_FUNCTIONS:
            for default in (*node.args.defaults, *node.args.kw_defaults):
                if default is not None:
                    self.visit(default)
            self.visit_body(node.body)

    def visit_ClassDef(self, node: ast.ClassDef) -> None:
        self.visit_body(node.body)

    def visit_AnnAssign(self, node: ast.AnnAssign) -> None:
        if node.value is not None:
            self.visit(node.value)

    def visit_Assign(self, node: ast.Assign) -> None:
        # `FloatArray = A | B` names a type.
        alias = isinstance(node.value, ast.BinOp) and isinstance(node.value.op, ast.BitOr)
        if not alias:
            self.generic_visit(node)

    def visit_keyword(self, node: ast.keyword) -> None:
        if node.arg not in _UNTOUCHED_ARGUMENTS:
            self.visit(node.value)

    # --- what is broken ---

    def visit_If(self, node: ast.If) -> None:
        if isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING":
            return
        self._negate(node.test)
        self.generic_visit(node)

    def visit_While(self, node: ast.While) -> None:
        self._negate(node.test)
        self.generic_visit(node)

    def visit_IfExp(self, node: ast.IfExp) -> None:
        self._negate(node.test)
        self.generic_visit(node)

    def visit_comprehension(self, node: ast.comprehension) -> None:
        for test in node.ifs:
            self._negate(test)
        self.generic_visit(node)

    def _negate(self, test: ast.expr) -> None:
        if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
            return  # visit_UnaryOp drops it
        if isinstance(test, ast.Compare) and len(test.ops) == 1:
            return  # visit_Compare does the same
        self._note("negated", self._start(test), self._end(test), f"(not ({self._text(test)}))")

    def visit_UnaryOp(self, node: ast.UnaryOp) -> None:
        if isinstance(node.op, (ast.USub, ast.Not)):
            kind = "sign" if isinstance(node.op, ast.USub) else "dropped not"
            self._note(kind, self._start(node), self._start(node.operand), "")
        elif isinstance(node.op, ast.Invert):
            self._note("dropped ~", self._start(node), self._start(node.operand), "")
        self.generic_visit(node)

    def visit_BinOp(self, node: ast.BinOp) -> None:
        if not _is_text(node.left):
            old, new = _OPERATORS.get(type(node.op), ("", ""))
            if isinstance(node.op, ast.Pow) and _is_difference(node.left) and _is_two(node.right):
                self._sign_is_lost.add(node.left)
            if old and (place := self._between(node.left, node.right, old)):
                kind = "sign" if old in "+-" else "operator"
                self._note(kind, *place, new)
                if isinstance(node.op, _TURNED_ROUND) and node not in self._sign_is_lost:
                    self._turn_round(node)
        self.generic_visit(node)

    def _turn_round(self, node: ast.BinOp) -> None:
        left, right = self._text(node.left), self._text(node.right)
        place = self._start(node), self._end(node)
        gap = self._raw[self._end(node.left) : self._start(node.right)].decode()
        if "\n" not in left + right + gap:
            sign = gap.strip(" ()")
            self._note("turned round", *place, f"(({right}) {sign} ({left}))")

    def visit_AugAssign(self, node: ast.AugAssign) -> None:
        old, new = _OPERATORS.get(type(node.op), ("", ""))
        if old and (place := self._between(node.target, node.value, f"{old}=")):
            self._note("sign" if old in "+-" else "operator", *place, f"{new}=")
        self.generic_visit(node)

    def visit_Compare(self, node: ast.Compare) -> None:
        sides = [node.left, *node.comparators]
        for left, right, operator in zip(sides, sides[1:], node.ops, strict=False):
            old, others = _COMPARISONS[type(operator)]
            place = self._between(left, right, old)
            for new in others if place else ():
                kind = "boundary" if {old, new} in ({"<", "<="}, {">", ">="}) else "comparison"
                self._note(kind, *place, new)  # type: ignore[misc]
        self.generic_visit(node)

    def visit_BoolOp(self, node: ast.BoolOp) -> None:
        old, new = ("and", "or") if isinstance(node.op, ast.And) else ("or", "and")
        for left, right in zip(node.values, node.values[1:], strict=False):
            if place := self._between(left, right, old):
                self._note("and, or", *place, new)
        self.generic_visit(node)

    def visit_Constant(self, node: ast.Constant) -> None:
        place = self._start(node), self._end(node)
        if isinstance(node.value, bool):
            self._note("constant", *place, str(not node.value))
        elif isinstance(node.value, int):
            self._note("constant", *place, str(node.value + 1))
        elif isinstance(node.value, float):
            self._note("constant", *place, repr(node.value * 1.01 or 0.01))

    def visit_Name(self, node: ast.Name) -> None:
        if isinstance(node.ctx, ast.Load) and node.id in SWAPPED_NAMES:
            self._note("function", self._start(node), self._end(node), SWAPPED_NAMES[node.id])

    def visit_Attribute(self, node: ast.Attribute) -> None:
        if isinstance(node.ctx, ast.Load) and node.attr in SWAPPED_NAMES:
            end = self._end(node)
            self._note("function", end - len(node.attr), end, SWAPPED_NAMES[node.attr])
        self.visit(node.value)

    def visit_Call(self, node: ast.Call) -> None:
        name = getattr(node.func, "attr", getattr(node.func, "id", ""))
        measured = node.args[: _SIZES.get(name, 0)]
        self._sign_is_lost |= {each for each in measured if _is_difference(each)}
        for first, second in zip(node.args, node.args[1:], strict=False):
            if name in _SYMMETRIC or (name == "swapaxes" and second is not node.args[1]):
                continue
            if name == "einsum" and first is node.args[1] and _same_indices(node.args[0]):
                continue
            # An array where a name belongs fails at once and would only please the count.
            if not any(isinstance(each, ast.Starred) or _is_text(each) for each in (first, second)):
                self._swap("swapped arguments", first, second)
        for part in (node.func, *node.keywords):
            self.visit(part)
        for argument in node.args:
            # Any negative number stands for what is left, not only -1.
            if name != "reshape" or not isinstance(argument, ast.UnaryOp):
                self.visit(argument)


def _same_indices(subscripts: ast.expr) -> bool:
    """Whether an einsum treats its first two arrays alike."""
    if not isinstance(subscripts, ast.Constant) or not isinstance(subscripts.value, str):
        return False
    first, second, *_ = [*subscripts.value.split("->")[0].split(","), ""]
    return first == second


def _is_difference(node: ast.expr) -> bool:
    return isinstance(node, ast.BinOp) and isinstance(node.op, ast.Sub)


def _is_two(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and node.value == 2


def _is_text(node: ast.expr) -> bool:
    return isinstance(node, ast.JoinedStr) or (
        isinstance(node, ast.Constant) and isinstance(node.value, str)
    )
