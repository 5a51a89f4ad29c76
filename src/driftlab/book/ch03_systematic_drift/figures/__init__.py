"""The published figures of chapter 03, with their captions."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.publish import FigureDefinition
from driftlab.book.machinery.scene.published import scene_figure

from .. import experiments
from ..axes import axis_tour
from ..block import magnification
from ..globe import GlobeOfAxesView, tells_most
from ..scenes import turning_block as turned_block
from . import closed_motions, drift_by_symmetry, drift_history, drift_map, turning_block


def _history_caption(data: DataTable) -> str:
    drift = 60 * np.degrees(data.exact_per_turn)
    return (
        f"A bent triad, turned {data.whole_turns[-1]:g} times; published for a symmetric one, each "
        f"gyro leaning by 2e-3 to the other two. Along the axis the error grows by {drift:.1f} "
        "arcmin a turn; perpendicular to it, the error comes back to nearly nothing each time."
    )


def _motions_caption(data: DataTable) -> str:
    drifts = [
        f"{60 * np.degrees(drift):.1f} ({name})"
        for name, drift in data.drift.items()
        if drift > 1e-9
    ]
    return (
        f"A bent triad, published for that of Larin's experiment, in {len(data.drift)} motions, "
        f"each made {data.ends[-1]:g} times. In the circles: the path of the third body axis, from "
        "the start and back; the sticks are the three body axes at the start. The curves: the "
        "exact error, with dots where the body is back; the straight lines are first order. A "
        f"motion leaves, in arc minutes: {', '.join(drifts)}. The swing about one axis leaves "
        "nothing."
    )


def _block_caption(data: DataTable) -> str:
    factor = magnification(np.linalg.norm(data.error, axis=-1).max())
    return (
        "A block with three gyros on a turntable, and in dashes the block as its computer believes "
        "it to be; published for a first gyro that leans. The lean is drawn "
        f"{data.exaggeration:g} times too large, the error {factor} times. After each whole turn "
        "the block is back; see whether the ghost is."
    )


FIGURES = (
    scene_figure(
        "03-globe-of-axes",
        axis_tour,
        GlobeOfAxesView,
        "All axes of rotation as a globe, painted with what a block drifts in one turn about each; "
        "published for the first block of the puzzle. The thick lines are the cone of axes without "
        "drift. As the axis goes round, the ghost of the block shows what its computer believes.",
        tells_most,
    ),
    FigureDefinition(
        "03-turning-block",
        turned_block,
        turning_block.draw,
        _block_caption,
        columns=turning_block.columns,
    ),
    FigureDefinition(
        "03-drift-history",
        experiments.drift_history,
        drift_history.DriftHistoryPicture.draw,
        _history_caption,
    ),
    FigureDefinition(
        "03-drift-by-symmetry",
        experiments.drift_by_symmetry,
        drift_by_symmetry.draw,
        lambda _: (
            "Drift per turn of a symmetric and of a skew deformation, published for the axis that "
            "is worst for each, and the passage from one to the other about that of the symmetric "
            "one."
        ),
    ),
    FigureDefinition(
        "03-drift-map",
        experiments.drift_map,
        drift_map.draw,
        lambda data: (
            "Drift coefficient of a bent triad for every axis of rotation; published for that of "
            f"Larin's experiment. The extremes {1e3 * data.principal_coefficient[0]:.3f} and "
            f"{1e3 * data.principal_coefficient[-1]:.3f} (times 1e-3) lie, to first order, "
            "on the eigenvectors of the symmetric part (stars)."
        ),
    ),
    FigureDefinition(
        "03-closed-motions",
        experiments.motion_histories,
        closed_motions.draw,
        _motions_caption,
    ),
)
