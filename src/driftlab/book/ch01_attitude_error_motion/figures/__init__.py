"""The published figures of chapter 01, with their captions."""

from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from . import error_motion

FIGURES = (
    FigureDefinition(
        "01-error-motion",
        experiments.error_motion,
        error_motion.ErrorMotionPicture.draw,
        lambda data: (
            "The four components of the error quaternion, published for a grossly wrong triad: the "
            "lines are the product of two exponentials, the dots are the steps of a Runge-Kutta "
            f"integrator with tolerance {data.tolerance:g}."
        ),
    ),
)
