"""The published figures of chapter 02, with their captions."""

from driftlab.book.machinery.publish import FigureDefinition
from driftlab.book.scenarios import OBLIQUE_AXIS, SYMMETRIC

from ..experiments import characteristic_roots
from . import roots

FIGURES = (
    FigureDefinition(
        "02-roots",
        lambda: characteristic_roots(0.1, SYMMETRIC, OBLIQUE_AXIS),
        roots.RootsPicture.draw,
        roots.columns,
        lambda data: (
            "Roots of the characteristic equation for a symmetric triad. The vertical "
            f"line marks the size {data.size:g} of the left panel. Larin's first-order roots err "
            "by the size squared, with one more term by its cube. The equation as the copy has it "
            "is as good at first order and spoils the next term of the fast root."
        ),
    ),
)
