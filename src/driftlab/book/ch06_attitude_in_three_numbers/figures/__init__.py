"""The published figures of chapter 06, with their captions."""

import numpy as np

from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from . import cayley_map, circles, riccati_turns

FIGURES = (
    FigureDefinition(
        "06-cayley-map",
        experiments.cayley_map,
        cayley_map.CayleyMapPicture.draw,
        lambda data: (
            "The two Cayley vectors of a rotation about a given axis. The vector of dimension 3 is "
            "infinite at half a turn (thin lines), that of dimension 4 at a whole turn (thick "
            "lines at the edges); there its shadow, the vector of the quaternion with the other "
            f"sign, is zero. The marks are at {np.degrees(data.angle):.0f}°."
        ),
    ),
    FigureDefinition(
        "06-circles",
        experiments.circles_of_steady_turns,
        circles.draw,
        lambda table: (
            "Paths of the Cayley vector of dimension 4 while the body turns steadily about its "
            f"third axis: {len(table.path)} starts across the axis, of length "
            f"{table.nearest:g}. Each path is a circle, traversed once in two turns; dots on one "
            "of them are an eighth of a turn apart. The vector's shadow is on the same circle, one "
            "turn ahead. In the shaded ball no vector is longer than one. Only a vector along "
            "the axis, or zero, runs on a line, to infinity."
        ),
    ),
    FigureDefinition(
        "06-riccati-turns",
        experiments.riccati_turns,
        riccati_turns.draw,
        lambda data: (
            f"A body that passes the whole turn at {np.degrees(data.miss):.0f}° from the singular "
            "attitude. The vector k, with and without the switch to its shadow: about a fixed axis "
            f"it ends at a length of {data.longest:.0e}. A fixed step "
            "loses digits at the singularity for good. A variable step reaches the same accuracy, "
            "with more work; each dot is a tolerance, each line a distance from the singularity."
        ),
    ),
)
