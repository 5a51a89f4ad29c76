"""Every published figure: what it is called, how it is computed and drawn, and what it shows."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import larin_table
from ..turn_calibration import TurnExperiment
from . import (
    algorithm_laboratory,
    algorithm_orders,
    cayley_map,
    coning_area,
    coning_drift,
    drift_by_symmetry,
    drift_history,
    drift_map,
    error_motion,
    frames,
    larin_digits,
    riccati_turns,
    roots,
    short_word,
    turn_bias,
    turn_estimates,
    weighing_designs,
)
from .picture import Picture


@dataclass(frozen=True)
class Entry:
    """One published figure.

    Attributes
    ----------
    name : str
        File name without ending; begins with the chapter's number.
    compute : callable
        Takes nothing, returns the picture's data.
    picture : type of Picture
    columns : callable or None
        Data to CSV columns of equal length; None for a drawing that shows no numbers.
    caption : callable
        Data to the sentence under the figure, so that its numbers are computed.
    """

    name: str
    compute: Callable[[], Any]
    picture: type[Picture[Any]]
    columns: Callable[[Any], dict[str, Any]] | None
    caption: Callable[[Any], str]


def _history_caption(data: drift_history.DriftHistory) -> str:
    drift = 60 * np.degrees(data.exact_per_turn)
    return (
        "A symmetric triad, each gyro leaning by 2e-3 to the other two, turned "
        f"{drift_history.TURNS} times. Along the axis the error grows by {drift:.1f} arcmin a "
        "turn; across it, the error comes back to nearly nothing each time."
    )


CATALOGUE = (
    Entry(
        "00-frames",
        frames.compute,
        frames.FramesPicture,
        None,
        lambda _: (
            "The frames of the papers. Each curved arrow is a positive angle: a right-handed "
            "turn about its axis. Plotnikov's heading is positive from North to West."
        ),
    ),
    Entry(
        "01-error-motion",
        lambda: error_motion.compute([0.1, 0.2, 0.1], [0.12, 0.15, 0.1]),
        error_motion.ErrorMotionPicture,
        error_motion.columns,
        lambda data: (
            "The four components of the error quaternion for a grossly wrong triad: the "
            "lines are the product of two exponentials, the dots are the steps of a Runge-Kutta "
            f"integrator with tolerance {data.tolerance:g}."
        ),
    ),
    Entry(
        "02-roots",
        lambda: roots.compute(0.1, drift_by_symmetry.SYMMETRIC, [1, 1, 0.3]),
        roots.RootsPicture,
        roots.columns,
        lambda data: (
            "Roots of the characteristic equation for a symmetric triad. The vertical "
            f"line marks the size {data.size:g} of the left panel. Larin's first-order roots err "
            "by the size squared, with one more term by its cube; the printed equation spoils "
            "the fast root."
        ),
    ),
    Entry(
        "03-drift-history",
        lambda: drift_history.compute(2e-3 * drift_by_symmetry.SYMMETRIC, [1, 1, 0.3]),
        drift_history.DriftHistoryPicture,
        drift_history.columns,
        _history_caption,
    ),
    Entry(
        "03-drift-by-symmetry",
        drift_by_symmetry.compute,
        drift_by_symmetry.DriftBySymmetryPicture,
        drift_by_symmetry.columns,
        lambda _: (
            "Drift per turn of a symmetric and of a skew deformation about the axis that is "
            "worst for each, and the passage from one to the other about (1, 1, 1)."
        ),
    ),
    Entry(
        "03-drift-map",
        lambda: drift_map.compute(larin_table.MISALIGNMENT),
        drift_map.DriftMapPicture,
        drift_map.columns,
        lambda data: (
            "Drift coefficient of the triad of Larin's table for every axis of rotation. "
            f"The extremes {1e3 * data.principal[0]:.3f} and {1e3 * data.principal[2]:.3f} "
            "(times 1e-3) lie, to first order, on the eigenvectors of the symmetric part (stars)."
        ),
    ),
    Entry(
        "04-turn-bias",
        lambda: turn_bias.compute(larin_table.MISALIGNMENT),
        turn_bias.TurnBiasPicture,
        turn_bias.columns,
        lambda data: (
            "Size of the error of sigma2 of Larin's triad. With many steps what remains is the "
            f"bias of the method itself, {data.bias:.1e}; a dip on the way is where the error of "
            "the integrator has the opposite sign and cancels it. More turns lower the noise only "
            f"({data.runs} runs for each dot)."
        ),
    ),
    Entry(
        "04-turn-estimates",
        lambda: turn_estimates.compute(
            larin_table.MISALIGNMENT,
            experiment=TurnExperiment(1, 100, "taylor-4", turn_bias.ANGLE_NOISE),
        ),
        turn_estimates.TurnEstimatesPicture,
        turn_estimates.columns,
        lambda data: (
            f"Larin's triad calibrated {len(data.runs)} times by one turn about each of three "
            f"axes, with gyro noise of {3600 * np.degrees(turn_bias.ANGLE_NOISE):.1f} arc seconds "
            "a turn. On the left the runs can hardly be told apart; on the right their errors can."
        ),
    ),
    Entry(
        "04-larin-digits",
        larin_digits.compute,
        larin_digits.LarinDigitsPicture,
        larin_digits.columns,
        lambda data: (
            f"Of {data.agrees[..., 0].size} candidates (reading of the triad, step formula, number "
            f"of steps), {data.winners} give all seven printed numbers, digit for digit. For each, "
            "the most favourable forming of sigma4* and the more favourable of rounding and "
            "cutting off is shown."
        ),
    ),
    Entry(
        "04-weighing-designs",
        weighing_designs.compute,
        weighing_designs.WeighingDesignsPicture,
        weighing_designs.columns,
        lambda data: (
            f"Monte Carlo of {data.runs} runs; the bars are 95 % intervals, the strokes "
            "closed forms. Without an offset least squares is best; with one, only the estimate "
            "that solves for the offset is unharmed."
        ),
    ),
    Entry(
        "05-cayley-map",
        lambda: cayley_map.compute(np.radians(130.0), [1, 1, 0.3]),
        cayley_map.CayleyMapPicture,
        cayley_map.columns,
        lambda data: (
            "The two Cayley vectors of a rotation about a given axis. The vector of dimension 3 is "
            "infinite at half a turn (thin lines), that of dimension 4 at a whole turn (thick "
            "lines at the edges); there its shadow, the vector of the quaternion with the other "
            f"sign, is zero. The marks stand at {np.degrees(data.angle):.0f}°."
        ),
    ),
    Entry(
        "05-riccati-turns",
        riccati_turns.compute,
        riccati_turns.RiccatiTurnsPicture,
        riccati_turns.columns,
        lambda data: (
            f"A body that passes the whole turn at {np.degrees(data.miss):.0f}° from the singular "
            "attitude. Left: the vector with and without the switch to its shadow; about a fixed "
            f"axis it is given up at a length of {np.linalg.norm(data.ended.vector[-1]):.0e}. "
            "Middle: a fixed step loses digits at the singularity for good. Right: a variable step "
            "reaches the same accuracy, with more work; each dot is a tolerance, each line a "
            "distance from the singularity."
        ),
    ),
    Entry(
        "06-coning-area",
        coning_area.compute,
        coning_area.ConingAreaPicture,
        coning_area.columns,
        lambda data: (
            "Across the axis of the cone the increments add up to a closed way. On a narrow cone "
            "the rotation about that axis is the area inside; sums of increments enclose a polygon "
            "and miss the "
            f"slivers ({data.samples} samples a round are drawn). On the right, a pair of samples "
            "with their triangle."
        ),
    ),
    Entry(
        "06-algorithm-orders",
        algorithm_orders.compute,
        algorithm_orders.AlgorithmOrdersPicture,
        algorithm_orders.columns,
        lambda _: (
            "Largest error of each algorithm in "
            f"{algorithm_laboratory.DURATION:g} s against the rate at which the gyros are read. "
            "The small cone and the fixed axis hide the third-order errors that the ship shows; on "
            "the wide cone they show as a wobble that does not grow. On a fixed axis rotation "
            "vectors leave rounding only."
        ),
    ),
    Entry(
        "06-coning-drift",
        coning_drift.compute,
        coning_drift.ConingDriftPicture,
        coning_drift.columns,
        lambda _: (
            "Apparent drift of a body that does not turn on the whole: dots measured over "
            f"{coning_drift.STEPS} steps, lines by the closed formula for small cones."
        ),
    ),
    Entry(
        "06-short-word",
        short_word.compute,
        short_word.ShortWordPicture,
        short_word.columns,
        lambda _: (
            "Arithmetic in 32 bits. Left: 1 - λ0 of one step. Middle: a body stands on the turning "
            f"Earth; carrying 1 - λ0 does as adding the small terms first does, and only a "
            "compensated sum helps. Right: what 1 - λ0 does save is the norm. Root mean square of "
            f"{short_word.STARTS} attitudes."
        ),
    ),
)
