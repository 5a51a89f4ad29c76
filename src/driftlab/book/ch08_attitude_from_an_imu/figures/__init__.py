"""The published figures of chapter 08, with their captions."""

from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from . import between_samples, more_samples, noise_and_band, pseudo_coning, sculling

FIGURES = (
    FigureDefinition(
        "08-between-samples",
        experiments.between_samples,
        between_samples.draw,
        lambda table: (
            "A rate that oscillates, and three guesses of it between "
            f"{table.samples:g} samples in a period. Then the largest error of an increment made "
            "from such samples, away from the ends of the record. A spline gains most with many "
            "samples; with hardly more than two in a period no guess helps."
        ),
    ),
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
            f"{table.words('angle_random_walk', 'g')}. By default, on the "
            "bracket, a remainder that is lost spoils the gain of the corrections; one that is "
            "carried costs about as much as the noise."
        ),
    ),
    FigureDefinition(
        "08-pseudo-coning",
        experiments.pseudo_coning,
        pseudo_coning.draw,
        lambda table: (
            f"A body shakes about one fixed axis by {table.words('swing', 'g')}, at "
            f"{table.words('frequency', 'g')}, and one of two gyros answers late. The summed "
            "increments go round a thin ellipse, so a computer takes the motion for a cone. The "
            f"drift, sampled at {table.words('sample_rate', 'g')}, is the area of the ellipse; the "
            "better algorithm sees more of it."
        ),
    ),
    FigureDefinition(
        "08-more-samples",
        experiments.three_against_four,
        more_samples.draw,
        lambda table: (
            "Drift on a cone with three samples a step, divided by the drift with four (weights "
            f"spread evenly), at {', '.join(table.samples)} samples per coning cycle. Above the "
            "line the fourth sample gains: on narrow cones only."
        ),
    ),
    FigureDefinition(
        "08-sculling",
        experiments.sculling_run,
        sculling.draw,
        lambda table: (
            "A body swings about its first axis while a force along its second axis acts in step. "
            "Both average out in the body. In space the mean force along the third axis is "
            f"{table.words('mean_force', '.0f')}, and the velocity grows."
        ),
    ),
)
