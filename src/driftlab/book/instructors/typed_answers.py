"""The answers that are typed in a cell, read from its syntax tree; nothing of it is run."""

from __future__ import annotations

import ast
import math
import operator
import re
import warnings
from collections.abc import Callable
from typing import Any, NamedTuple

LONGEST_CELL = 50_000
"""Characters; the cells of the book have a twentieth of it."""
MOST_STEPS = 500_000
"""What reading one notebook may take: characters, nodes of syntax trees, entries of lists."""
MOST_ENTRIES = 500
"""Of an answer, or characters of one; `check` records no more either."""
DEEPEST = 8
LARGEST = 2.0**1000
"""Of a number; its float is finite, and so is the memory that it takes."""

UNREAD = object()
"""Stands for what cannot be read without running it."""

OPERATIONS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.Pow: lambda base, power: (base * 1.0) ** (power * 1.0),  # floats overflow, integers grow
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
}
MODULES = {"np", "numpy", "math"}
SHOWS = {"check", "display", "print"}
"""Functions that leave their arguments as they are."""
_MAGIC = re.compile(r"^([ \t]*)[%!?].*$", re.MULTILINE)
_CALLED = re.compile(r"\bcheck\(\s*[\"']?(\d{1,3}\.\d{1,3}[a-z]?)", re.ASCII)


class Typed(NamedTuple):
    """A call of `check`."""

    number: str  # of the exercise
    answer: Any  # `UNREAD` if it is no literal
    student: Any  # the name that numbers were asked with, "" if none


class UnreadError(ValueError):
    """A part of a cell that has to be run to be known."""


class Reader:
    """Reads the cells of one notebook; a hostile one takes no more than `MOST_STEPS`."""

    def __init__(self) -> None:
        self._left = MOST_STEPS
        self._names: dict[str, Any] = {}

    def calls(self, source: str) -> list[Typed]:
        """Return the calls of `check` in a cell, in their order."""
        self._names = {}
        self._left -= len(source)
        try:
            if self._left < 0:
                raise UnreadError
            body = _parsed(source)
        except (SyntaxError, ValueError, MemoryError, RecursionError):
            return [Typed(number, UNREAD, UNREAD) for number in _CALLED.findall(source[:100_000])]
        return [call for statement in body for call in self._calls_of(statement)]

    def _calls_of(self, statement: ast.stmt) -> list[Typed]:
        nodes = [*ast.walk(statement)]
        self._left -= len(nodes)
        made = [node for node in nodes if isinstance(node, ast.Call) and _name(node) == "check"]
        value = getattr(statement, "value", None)
        # Within a loop, a condition or a function, a call may be made often or never.
        found = [self._typed(call, is_made=call is value) for call in made]
        if isinstance(statement, ast.Assign) and all(
            isinstance(target, ast.Name) for target in statement.targets
        ):
            read = self._read(statement.value)
            if read is UNREAD:
                self._forget(nodes)
            self._names.update({n.id: read for n in statement.targets if isinstance(n, ast.Name)})
        elif not _only_shows(statement, nodes):
            self._forget(nodes)
        return [call for call in found if call]

    def _forget(self, nodes: list[ast.AST]) -> None:
        """Forget the names that a statement binds, and all lists if it may change one."""
        for node in nodes:
            if isinstance(node, ast.Name):
                if not isinstance(node.ctx, ast.Load):
                    self._names[node.id] = UNREAD
                elif isinstance(self._names.get(node.id), list):
                    self._names = {
                        name: UNREAD if isinstance(value, list) else value
                        for name, value in self._names.items()
                    }
            for name in (getattr(node, "name", None), getattr(node, "asname", None)):
                if isinstance(name, str):  # of a function, a class, an import, an exception
                    self._names[name] = UNREAD

    def _typed(self, call: ast.Call, *, is_made: bool) -> Typed | None:
        given: dict[str | None, ast.expr] = dict(zip(("number", "answer"), call.args, strict=False))
        given |= {word.arg: word.value for word in call.keywords}
        number = self._read(given.get("number"))
        if not isinstance(number, str | float):
            return None
        # A third one without a name is refused: a decimal comma, as a rule.
        is_made = is_made and len(call.args) <= 2
        answer = self._read(given.get("answer")) if is_made else UNREAD
        student = self._read(given["student"]) if "student" in given else ""
        if None in given or (student is not UNREAD and not isinstance(student, str)):
            student = UNREAD if student is not ... else ""
        return Typed(str(number), answer, student)

    def _read(self, node: ast.AST | None) -> Any:
        try:
            return within_bounds(self._value(node))
        except (ArithmeticError, TypeError, ValueError, RecursionError):
            return UNREAD

    def _value(self, node: ast.AST | None) -> Any:
        self._left -= 1
        if self._left < 0:
            raise UnreadError
        match node:
            case ast.Constant(value=value):
                return value
            case ast.List(elts=parts) | ast.Tuple(elts=parts) | ast.Set(elts=parts):
                return [within_bounds(self._value(part)) for part in parts]
            case ast.Name(id=name) if self._names.get(name, UNREAD) is not UNREAD:
                value = self._names[name]
                self._left -= 5 * _size(value)
                return value
            case ast.Attribute(value=ast.Name(id=module), attr="pi") if module in MODULES:
                return math.pi
            case ast.Call(func=ast.Attribute(value=ast.Name(id=module), attr="array"), args=[part]):
                if module in MODULES and not node.keywords:
                    return self._value(part)
            case ast.UnaryOp(op=sign, operand=part) if type(sign) in OPERATIONS:
                return OPERATIONS[type(sign)](self._number(part))
            case ast.BinOp(left=left, op=sign, right=right) if type(sign) in OPERATIONS:
                return OPERATIONS[type(sign)](self._number(left), self._number(right))
        raise UnreadError

    def _number(self, node: ast.AST) -> Any:
        value = within_bounds(self._value(node))
        if not isinstance(value, int | float | complex):
            raise UnreadError
        return value


def within_bounds(value: Any, depth: int = 0) -> Any:
    """Return an answer in numbers, text and lists, or raise ValueError if it is none, or too large.

    What is no number and no text, such as ``...``, is left as it is.
    """
    known = value is None or value is ... or isinstance(value, int | float | complex | str | list)
    if not known or depth > DEEPEST or _size(value) > MOST_ENTRIES:
        raise UnreadError
    if isinstance(value, int) and abs(value) > LARGEST:
        raise UnreadError
    if isinstance(value, list):
        for part in value:
            within_bounds(part, depth + 1)
    return value


def _size(value: Any, depth: int = 0) -> int:
    if not isinstance(value, list):
        return len(value) if isinstance(value, str) else 1
    if depth > DEEPEST:
        raise UnreadError
    return 1 + sum(_size(part, depth + 1) for part in value[: MOST_ENTRIES + 1])


def _parsed(source: str) -> list[ast.stmt]:
    if len(source) > LONGEST_CELL:
        raise UnreadError
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of a backslash in a student's text
        try:
            return ast.parse(source).body
        except SyntaxError:
            return ast.parse(_MAGIC.sub(r"\1pass", source)).body


def _name(call: ast.Call) -> str:
    """The last word of what is called."""
    function = call.func
    return getattr(function, "id", None) or getattr(function, "attr", None) or ""


def _only_shows(statement: ast.stmt, nodes: list[ast.AST]) -> bool:
    """Whether a statement shows something and changes nothing."""
    if not isinstance(statement, ast.Expr):
        return isinstance(statement, ast.Pass)
    calls = [node for node in nodes if isinstance(node, ast.Call)]
    return all(_name(call) in SHOWS for call in calls) and not any(
        isinstance(node, ast.NamedExpr | ast.Await) for node in nodes
    )
