"""The published figures of chapter 10, with their captions."""

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from . import equivalent_start, plane_axes, plane_split, split_triad


def _start_caption(data: DataTable) -> str:
    largest = data.shown("largest")
    return (
        "A unit on a turntable. First its attitude error: that of scale and of non-orthogonality "
        f"reaches {largest[0]:.0f} and {largest[1]:.0f} arc seconds; misalignment comes back with "
        "the unit, as the total derivative says, within "
        f"{data.shown('derivative_gap'):.1g} arc seconds. Then "
        "the velocity: two triads turned together have no effect only if the start is turned as "
        "well. Last what remains for misalignments of all sizes: of second order for a skew "
        "matrix, and only rounding for a true rotation."
    )


FIGURES = (
    FigureDefinition(
        "10-plane-split",
        experiments.plane_split,
        plane_split.draw,
        lambda data: (
            "Two gyros in a plane, and the two parts of their installation errors. Misalignment "
            f"turns both by the mean of their angles, {data.misalignment[0]:.2f} rad. "
            "Non-orthogonality turns them, towards each other or apart, by half of the difference, "
            f"{abs(data.non_orthogonality[0]):.2f} rad each."
        ),
    ),
    FigureDefinition(
        "10-split-triad",
        experiments.error_matrix_parts,
        split_triad.SplitTriadPicture.draw,
        lambda data: (
            "The gyro triad of a unit, published for a typical one, and what each part of its "
            "error matrix alone would do: change the lengths (too little there to be seen), close "
            "and open the angles, turn all three axes together. Thin lines are the ideal axes. "
            f"Errors are drawn {split_triad.exaggeration(data):g} times too large."
        ),
    ),
    FigureDefinition(
        "10-plane-axes",
        experiments.plane_body_axes,
        plane_axes.draw,
        lambda data: (
            "Two gyros and two accelerometers in a plane. The usual body axes go with the x gyro "
            f"and turn by {data.usual:.2f} rad; the averaged ones turn by {data.averaged:.2f} rad, "
            f"the mean of the angles {data.gyros[0]:.2f} and {data.gyros[1]:.2f} of the two gyros."
        ),
    ),
    FigureDefinition(
        "10-equivalent-start", experiments.equivalent_start, equivalent_start.draw, _start_caption
    ),
)
