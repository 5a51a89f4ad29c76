"""Local axes on the way North along a meridian, and the axes of the start carried along."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import degree

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import finite_array
from driftlab.earth import checked_latitude

PLACES = (0.0, 30 * degree, 60 * degree)


def carried_level(latitudes: ArrayLike = PLACES) -> DataTable:
    """Angles between the local axes at some latitudes and those of the first, on a sphere."""
    places = checked_latitude(np.atleast_1d(finite_array(latitudes, "latitudes")))
    return DataTable(
        {"latitude": (places, "deg", "of the unit on its way North")},
        {"turned": (float(places[-1] - places[0]), "deg", "the local axes from first to last")},
    )
