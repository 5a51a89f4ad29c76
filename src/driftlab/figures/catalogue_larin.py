"""The published figures of the introduction and of Part I."""

import numpy as np

from .. import larin_table
from ..turn_calibration import TurnExperiment
from . import (
    drift_by_symmetry,
    drift_history,
    drift_map,
    error_motion,
    frames,
    larin_digits,
    roots,
    turn_bias,
    turn_estimates,
    weighing_designs,
)
from .entry import Entry


def _history_caption(data: drift_history.DriftHistory) -> str:
    drift = 60 * np.degrees(data.exact_per_turn)
    return (
        "A symmetric triad, each gyro leaning by 2e-3 to the other two, turned "
        f"{drift_history.TURNS} times. Along the axis the error grows by {drift:.1f} arcmin a "
        "turn; across it, the error comes back to nearly nothing each time."
    )


ENTRIES = (
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
)
