"""What is broken of a module, what is left alone, and what the page makes of it."""

from types import CodeType

import pytest
from break_part import Break, breaks, broken, broken_code, line_before_and_after, same_code
from kept_breaks import Tried
from mutations_page import REASONS, page, reasons, share
from numerical_parts import path_of


def after(source: str, kind: str | None = None) -> set[str]:
    """All that breaks make of a source."""
    return {broken(source, each) for each in breaks(source) if kind in (None, each.kind)}


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("a + b", {"a - b"}),
        ("a - b", {"a + b", "((b) - (a))"}),
        ("abs(a - b)", {"abs(a + b)"}),
        ("norm(a, b - c)", {"norm(b - c, a)", "norm(a, b + c)", "norm(a, ((c) - (b)))"}),
        ("(a - b) ** 2", {"(a + b) ** 2", "(a - b) * 2", "(a - b) ** 3", "((2) ** (a - b))"}),
        ("-a", {"a"}),
        ("a * b", {"a / b"}),
        ("a / b", {"a * b", "((b) / (a))"}),
        ("a // b", {"a % b"}),
        ("a % b", {"a // b"}),
        ("a ** b", {"a * b", "((b) ** (a))"}),
        ("a @ b", {"a * b", "((b) @ (a))"}),
        ("a & b", {"a | b"}),
        ("a < b", {"a <= b", "a >= b"}),
        ("a >= b", {"a > b", "a < b"}),
        ("a == b", {"a != b"}),
        ("a is not b", {"a is b"}),
        ("a in b", {"a not in b"}),
        ("a < b < c", {"a <= b < c", "a >= b < c", "a < b <= c", "a < b >= c"}),
        ("a and b", {"a or b"}),
        ("not a", {"a"}),
        ("~a", {"a"}),
        ("a if b else c", {"a if (not (b)) else c"}),
        ("[a for a in b if c]", {"[a for a in b if (not (c))]"}),
        ("f(a, b, c)", {"f(b, a, c)", "f(a, c, b)"}),
        ("np.swapaxes(a, i, j)", {"np.swapaxes(i, a, j)"}),
        ("np.einsum('ij,j->i', a, b)", {"np.einsum('ij,j->i', b, a)"}),
        ("np.maximum(a, b)", {"np.minimum(a, b)"}),
        ("a.reshape(n, -1)", {"a.reshape(-1, n)"}),
        ("np.sin(a)", {"np.cos(a)"}),
        ("min(a)", {"max(a)"}),
        ("all(a)", {"any(a)"}),
        ("3", {"4"}),
        ("2.0", {"2.02"}),
        ("0.0", {"0.01"}),
        ("True", {"False"}),
        ("(a +\n b)", {"(a -\n b)"}),
        ("ä + (b)", {"ä - (b)"}),
    ],
)
def test_each_kind_of_break(line, expected):
    assert {each.removeprefix("x = ") for each in after(f"x = {line}")} == expected


@pytest.mark.parametrize(
    "source",
    [
        '"""Text of 3 + 4."""',
        "def f():\n    '''Text.'''\n    'more'",
        "raise ValueError(f'{a + 1} < {b}', 3)",
        "x: Literal[3]",
        "def f(a: Literal[3]) -> Literal[4]: pass",
        "@cache(3)\ndef f(): pass",
        "@dataclass(frozen=True)\nclass A: pass",
        "def __repr__(self):\n    return a + b",
        "x = f'{a + b}'",
        "x = 'a' + b",
        "x = f('a', b)",
        "warn(a, stacklevel=2)",
        "zip(a, strict=True)",
        "np.einsum('...i,...i->...', a, b)",
        "if TYPE_CHECKING:\n    x = 3",
        "Either = A | B",
        "from . import sin",
        "sin = a",
    ],
)
def test_what_calculates_nothing_is_left_alone(source):
    assert after(source) == set()


@pytest.mark.parametrize("head", ["if", "while"])
def test_conditions_are_turned_round(head):
    assert after(f"{head} a:\n    b") == {f"{head} (not (a)):\n    b"}
    assert after(f"{head} not a:\n    b") == {f"{head} a:\n    b"}
    assert after(f"{head} a < b:\n    c", "negated") == set()  # a comparison does it


def test_values_in_signatures_classes_and_updates_are_broken():
    assert after("def f(a: int = 3): pass") == {"def f(a: int = 4): pass"}
    assert after("class A:\n    b: int = 3") == {"class A:\n    b: int = 4"}
    assert after("a += b") == {"a -= b"}
    assert after("a *= b") == {"a /= b"}


def test_the_lines_of_a_break_are_those_of_its_statement():
    source = "if (a and\n    b):\n    c = f(\n        d,\n        3,\n    )\n"
    lines = {each.kind: each.lines for each in breaks(source)}
    assert lines == {
        "negated": (1, 2),
        "and, or": (1, 2),
        "constant": (3, 6),
        "swapped arguments": (3, 6),
    }


def test_the_same_program_is_no_break():
    nothing = Break("constant", 1, (1, 1), 4, 5, "(3)")
    assert broken_code("x = 3", nothing, "file") is None
    assert broken_code("x = 3", nothing._replace(new="("), "file") is None
    code = broken_code("x = 3", nothing._replace(new="-0.0"), "file")
    assert isinstance(code, CodeType)
    assert not same_code(code, compile("x = 0.0", "file", "exec"))
    inner = [compile(f"def f():\n    return {text}", "file", "exec") for text in ("a + b", "a-b")]
    assert not same_code(*inner)


def test_a_line_is_shown_before_and_after():
    source = "if a:\n    é = f(b,\n          c)  # so\n"
    [swap] = [each for each in breaks(source) if each.kind == "swapped arguments"]
    assert line_before_and_after(source, swap) == ("é = f(b, c) # so", "é = f(c, b) # so")


class OneModule:
    """What the page needs of the breaks of a module."""

    def __init__(self, *tried: Tried) -> None:
        self.module, self.broken_before, self.tried = "core.part", "", list(tried)
        self.survived = [each for each in tried if not each.failed]


def test_survivors_that_change_nothing_are_counted_apart():
    def tried(after: str, failed: str) -> Tried:
        return Tried("core.part", "sign", 3, "a", after, (0, 1, after), failed, 9, True, 0.1)

    module = OneModule(tried("b", "test"), tried("c", ""), tried("d", ""))
    known = {
        ("core.part", "a", "c"): "equivalent: c is a",
        ("core.part", "a", "d"): "hole: not yet",
    }
    text = page([module], known, {"core.part": 30}, 0)
    assert "| **share caught, of all** | **33.3 %** |" in text
    assert "| **share caught, of those that change something** | **50.0 %** |" in text
    assert "| `core.part` | 3 | 1 | 33.3 % | 1 | 1 | 50.0 % |" in text
    assert text.index("hole: not yet") < text.index("equivalent: c is a")
    assert "no reason given yet" in page([module], {}, {"core.part": 30}, 0)
    assert [share(*each) for each in ((2999, 3000), (2, 3), (7, 7))] == [
        "99.9 %",
        "66.7 %",
        "100.0 %",
    ]


def test_a_large_module_counts_more_in_the_estimate_for_all():
    """Of two in ten of the one half is caught, of two in thirty of the other all."""

    def tried(module: str, place: int, failed: str) -> Tried:
        return Tried(module, "sign", 3, "a", "b", (place, 1, "b"), failed, 9, True, 0.1)

    one = OneModule(tried("core.one", 0, "test"), tried("core.one", 1, ""))
    other = OneModule(tried("core.other", 0, "test"), tried("core.other", 1, "test"))
    one.module, other.module = "core.one", "core.other"
    text = page([one, other], {}, {"core.one": 10, "core.other": 30}, 7)
    assert "2 to 2 were drawn at random (seed 7)" in text
    assert "In all 2 modules 40 breaks are possible" in text
    expected = (10 * 0.5 + 30 * 1.0) / 40
    halves = 10**2 * 0.25 / 2 * (1 - 2 / 10)
    wholes = 30**2 * (2.5 / 3) * (0.5 / 3) / 2 * (1 - 2 / 30)
    error = 2 * (halves + wholes) ** 0.5 / 40
    assert f"**{100 * expected:.1f} ± {100 * error:.1f} %**" in text


def test_each_reason_is_for_a_break_that_is_possible():
    """One of a line that has changed since, or that is broken no more, would only be in the way."""
    possible = {}
    for module, before, after in reasons(REASONS):
        if module not in possible:
            source = path_of(module).read_text("utf-8")
            possible[module] = {line_before_and_after(source, each) for each in breaks(source)}
        assert (before, after) in possible[module], module
