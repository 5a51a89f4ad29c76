"""The published figures of chapter 02, with their captions."""

from driftlab.book.machinery.figure.publish import FigureDefinition

from ..experiments import characteristic_roots
from . import roots

FIGURES = (
    FigureDefinition(
        "02-roots",
        characteristic_roots,
        roots.RootsPicture.draw,
        lambda data: (
            "Roots of the characteristic equation for a bent triad, published for a symmetric one. "
            f"The vertical line marks the size {data.size:g} of the complex plane. The "
            "first-order roots err by the size squared, with one more term by its cube. The "
            "equation with one term missing is as good at first order and spoils the next term of "
            "the fast root."
        ),
    ),
)
