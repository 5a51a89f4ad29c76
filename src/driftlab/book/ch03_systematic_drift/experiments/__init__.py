"""The experiments of chapter 03: turns and other closed motions of a bent triad."""

from .motions import (
    REPEATS as REPEATS,
    SWING as SWING,
    MotionHistory as MotionHistory,
    closed_motions as closed_motions,
    motion_histories as motion_histories,
)
from .turns import (
    ACROSS as ACROSS,
    DIAGONAL as DIAGONAL,
    EXAGGERATION as EXAGGERATION,
    LARGEST_ENTRY as LARGEST_ENTRY,
    TURNS as TURNS,
    DriftBySymmetry as DriftBySymmetry,
    DriftMap as DriftMap,
    drift_by_symmetry as drift_by_symmetry,
    drift_history as drift_history,
    drift_map as drift_map,
)
