"""Parameters other than the published ones, with which each figure is drawn in the tests.

One line a figure: what a reader would change first, and little enough to compute in a second.
"""

from typing import Any

import numpy as np

LEANING = [[0, 1e-3, 0], [0, 0, 5e-4], [0, 0, 0]]

VARIATIONS: dict[str, dict[str, Any]] = {
    "03-drift-map": {"triad_error": np.array(LEANING)},
}
