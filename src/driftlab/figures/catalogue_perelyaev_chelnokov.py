"""The published figures of Part II."""

import numpy as np

from . import (
    algorithm_laboratory,
    algorithm_orders,
    cayley_map,
    coning_area,
    coning_drift,
    riccati_turns,
    short_word,
)
from .entry import Entry

ENTRIES = (
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
            "Earth and λ0 is stored as 1; carrying 1 - λ0 does as adding the small terms first "
            "does, and a compensated sum far better. Right: at larger steps 1 - λ0 keeps the norm. "
            f"Root mean square of {short_word.STARTS} attitudes."
        ),
    ),
)
