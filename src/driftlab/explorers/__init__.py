"""Slider panels, one class each, on the same computations and pictures as the figures.

Show one as the last line of a notebook cell: ``DriftExplorer()``. `EXPLORERS` lists them all.
"""

from .larin import DriftExplorer, ErrorMotionExplorer, RootsExplorer, TurnCalibrationExplorer
from .perelyaev_chelnokov import AlgorithmLaboratoryExplorer, CayleyMapExplorer
from .plotnikov import AlignmentBudgetExplorer, CapstoneExplorer, GyrocompassExplorer
from .wu import CalibrationRunExplorer, ObservabilityExplorer, SplitExplorer

EXPLORERS = (
    ErrorMotionExplorer,
    RootsExplorer,
    DriftExplorer,
    TurnCalibrationExplorer,
    CayleyMapExplorer,
    AlgorithmLaboratoryExplorer,
    SplitExplorer,
    ObservabilityExplorer,
    CalibrationRunExplorer,
    AlignmentBudgetExplorer,
    GyrocompassExplorer,
    CapstoneExplorer,
)

__all__ = ["EXPLORERS", *(explorer.__name__ for explorer in EXPLORERS)]
