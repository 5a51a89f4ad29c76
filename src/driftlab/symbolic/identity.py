"""A proof that shows what it proved: two expressions, their difference brought to zero."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby

import sympy as sp

from driftlab.symbolic.objects import simplified


@dataclass(frozen=True)
class Identity:
    """Two expressions that are equal, typeset in a notebook.

    Attributes
    ----------
    left, right : str
        The two sides in LaTeX.
    free : tuple of str
        The symbols for whose every value it holds, in LaTeX; (x_1, x_2, x_3) counts as one, x.
    has_poles : bool
        Whether a side may have no value somewhere, so that it holds where both have one.
    """

    left: str
    right: str
    free: tuple[str, ...]
    has_poles: bool = False

    def _repr_latex_(self) -> str:
        letters = r",\ ".join(self.free)
        where = rf"\quad\text{{for every }} {letters}" if letters else ""
        if self.has_poles:
            where += r"\text{ for which both exist}"
        return rf"$\displaystyle {self.left} \;=\; {self.right} \quad\checkmark{where}$"

    def __repr__(self) -> str:
        where = f" for every {', '.join(self.free)}" if self.free else ""
        where += " for which both exist" if self.has_poles else ""
        return f"{self.left} = {self.right}{where}: proved"


def identity(
    left: sp.Expr | sp.MatrixBase,
    right: sp.Expr | sp.MatrixBase | int,
    left_text: str = "",
    right_text: str = "",
) -> Identity:
    """Prove that two expressions are equal, and show it.

    They are equal for all values that the assumptions on their symbols allow and for which both
    sides exist.

    Parameters
    ----------
    left, right : expression or matrix
        Their difference is brought to zero by `simplified` or, which takes longer, by SymPy's
        ``simplify``. ``right=0`` stands for a zero of the shape of `left`.
    left_text, right_text : str
        How the sides are to be typeset, in LaTeX; if not given, the expressions themselves.

    Returns
    -------
    Identity
        As the last line of a cell it shows the two sides and a tick.

    Raises
    ------
    AssertionError
        If the difference is not zero; the message has it.
    ValueError
        If one side is a matrix and the other is not, or their shapes differ.

    Examples
    --------
    >>> from driftlab import symbolic as sym
    >>> p, q = sym.quaternion("p"), sym.quaternion("q")
    >>> sym.identity(
    ...     sym.left_matrix(p) * q, sym.right_matrix(q) * p, "L(p) q", "R(q) p"
    ... )
    L(p) q = R(q) p for every p, q: proved
    """
    sides = [sp.sympify(left), sp.sympify(right)]
    if sides[1] == 0 and isinstance(sides[0], sp.MatrixBase):
        sides[1] = sp.zeros(*sides[0].shape)
    shapes = [side.shape if isinstance(side, sp.MatrixBase) else () for side in sides]
    if shapes[0] != shapes[1]:
        raise ValueError(f"right: expected the shape {shapes[0]} of left, got {shapes[1]}.")
    difference = simplified(sp.Matrix([sides[0] - sides[1]]))
    if not difference.is_zero_matrix:
        difference = difference.applyfunc(_without_unit_circles)
    if not difference.is_zero_matrix:
        difference = difference.applyfunc(sp.simplify)
    if not difference.is_zero_matrix:
        raise AssertionError(f"The sides differ by {difference.tolist()}.")
    symbols = sorted(sides[0].free_symbols | sides[1].free_symbols, key=lambda s: s.sort_key())
    stems = [sp.latex(symbol).partition("_")[0] for symbol in symbols]
    texts = [
        text or sp.latex(0 if side.is_zero_matrix else side)
        if isinstance(side, sp.MatrixBase)
        else text or sp.latex(side)
        for text, side in zip((left_text, right_text), sides, strict=True)
    ]
    free = tuple(stem for stem, _ in groupby(sorted(stems)))
    return Identity(texts[0], texts[1], free, any(map(_has_poles, sides)))


def _without_unit_circles(entry: sp.Expr) -> sp.Expr:
    """Return zero if an entry is zero by sin² + cos² = 1 alone, otherwise the entry.

    SymPy's ``simplify`` sees this, too, but for some seeds of Python's hashes takes minutes.
    """
    found = {each.args[0] for each in entry.atoms(sp.sin, sp.cos)}
    angles = sorted(found, key=sp.default_sort_key)
    circles = [(angle, sp.Dummy("c"), sp.Dummy("s")) for angle in angles]
    names = {sp.cos(angle): c for angle, c, _ in circles}
    names |= {sp.sin(angle): s for angle, _, s in circles}
    rest = sp.expand(sp.fraction(sp.together(entry.xreplace(names)))[0])
    for _, c, s in circles:
        if not rest.is_polynomial(c):
            return entry
        rest = sp.rem(rest, c**2 + s**2 - 1, c)
    return sp.S.Zero if sp.expand(rest) == 0 else entry


def _has_poles(side: sp.Expr | sp.MatrixBase) -> bool:
    """Whether something with symbols is divided by, or is a tangent or its like."""
    divided = any(
        power.exp.could_extract_minus_sign() and power.base.free_symbols
        for power in side.atoms(sp.Pow)
    )
    return divided or bool(side.atoms(sp.tan, sp.cot, sp.sec, sp.csc, sp.log))
