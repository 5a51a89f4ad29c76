"""The published figures of chapter 03, with their captions."""

import numpy as np

from driftlab.book.ch00_start_here.puzzle import LEANING
from driftlab.book.machinery.publish import FigureDefinition
from driftlab.book.machinery.scene.published import scene_figure

from .. import experiments
from ..block import magnification
from ..globe import GlobeOfAxes
from ..scenes import SAMPLES
from . import closed_motions, drift_by_symmetry, drift_history, drift_map, turning_block


def _history_caption(data: experiments.DriftHistory) -> str:
    drift = 60 * np.degrees(data.exact_per_turn)
    return (
        "A symmetric triad, each gyro leaning by 2e-3 to the other two, turned "
        f"{experiments.TURNS} times. Along the axis the error grows by {drift:.1f} arcmin a "
        "turn; perpendicular to it, the error comes back to nearly nothing each time."
    )


def _motions_caption(data: dict[str, experiments.MotionHistory]) -> str:
    drifts = [
        f"{60 * np.degrees(history.first_order):.1f} ({name})"
        for name, history in data.items()
        if history.first_order > 1e-9
    ]
    return (
        f"The triad of Larin's experiment in {len(data)} motions, each made {experiments.REPEATS} "
        "times. Left: the path of the third body axis, from the start and back; the sticks are the "
        "three body axes at the start. Right: the exact error, with dots where "
        "the body is back; the straight lines are first order. A motion "
        f"leaves, in arc minutes: {', '.join(drifts)}. The swing about one axis leaves nothing."
    )


def _block_caption(data: experiments.DriftHistory) -> str:
    factor = magnification(np.linalg.norm(data.error, axis=-1).max())
    return (
        "A block with three gyros on a turntable, and in dashes the block as its computer believes "
        f"it to be. The first gyro leans; its lean is drawn {experiments.EXAGGERATION} times "
        f"too large, the error {factor} times. After each whole turn the block is back, "
        "and the ghost is not."
    )


FIGURES = (
    scene_figure(
        "03-globe-of-axes",
        GlobeOfAxes,
        "The first block",
        "All axes of rotation as a globe, painted with what the first block of the puzzle drifts "
        "in one turn about each. The thick lines are the cone of axes without drift. As the axis "
        "goes round, the ghost of the block shows what its computer believes.",
    ),
    FigureDefinition(
        "03-turning-block",
        lambda: experiments.drift_history(LEANING, [1, 1, 0], SAMPLES),
        turning_block.draw,
        turning_block.columns,
        _block_caption,
    ),
    FigureDefinition(
        "03-drift-history",
        experiments.drift_history,
        drift_history.DriftHistoryPicture.draw,
        drift_history.columns,
        _history_caption,
    ),
    FigureDefinition(
        "03-drift-by-symmetry",
        experiments.drift_by_symmetry,
        drift_by_symmetry.draw,
        drift_by_symmetry.columns,
        lambda _: (
            "Drift per turn of a symmetric and of a skew deformation about the axis that is "
            "worst for each, and the passage from one to the other about (1, 1, 1)."
        ),
    ),
    FigureDefinition(
        "03-drift-map",
        experiments.drift_map,
        drift_map.draw,
        drift_map.columns,
        lambda data: (
            "Drift coefficient of a bent triad for every axis of rotation; published for that of "
            f"Larin's experiment. The extremes {1e3 * data.principal[0]:.3f} and "
            f"{1e3 * data.principal[2]:.3f} (times 1e-3) lie, to first order, on the eigenvectors "
            "of the symmetric part (stars)."
        ),
    ),
    FigureDefinition(
        "03-closed-motions",
        experiments.motion_histories,
        closed_motions.draw,
        closed_motions.columns,
        _motions_caption,
    ),
)
