"""The published figures of chapter 08, with their captions."""

from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from . import noise_and_band

FIGURES = (
    FigureDefinition(
        "08-noise-and-band",
        experiments.noise_and_band,
        noise_and_band.draw,
        lambda table: (
            "First the part of a narrow cone's coning that an algorithm misses. Thin lines are the "
            "first terms of the series, too large where samples are few. Then the drift on a cone "
            f"of {table.words('half_angle', 'g')} at {table.words('frequency', 'g')} in "
            f"{table.words('seconds', 'g')}, and the floors under it: gyros that round to "
            f"{table.shown('quantum'):g} arc second, and white noise of "
            f"{table.words('angle_random_walk', 'g')}. As published, for the "
            "bracket, a remainder that is lost spoils what the corrections gain; one that is "
            "carried costs about as much as the noise."
        ),
    ),
)
