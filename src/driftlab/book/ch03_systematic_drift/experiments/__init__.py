"""The experiments of chapter 03: turns and other closed motions of a bent triad."""

from .motions import (
    REPEATS as REPEATS,
    closed_motions as closed_motions,
    motion_histories as motion_histories,
)
from .turns import (
    DIAGONAL as DIAGONAL,
    EXAGGERATION as EXAGGERATION,
    LARGEST_ENTRY as LARGEST_ENTRY,
    TURNS as TURNS,
    drift_by_symmetry as drift_by_symmetry,
    drift_history as drift_history,
    drift_map as drift_map,
)
