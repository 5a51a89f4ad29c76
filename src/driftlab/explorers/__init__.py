"""Slider panels, one class each, on the same computations and pictures as the figures.

Show one as the last line of a notebook cell: ``DriftExplorer()``. `EXPLORERS` lists them all.
"""

from .larin import DriftExplorer, ErrorMotionExplorer, RootsExplorer, TurnCalibrationExplorer

EXPLORERS = (ErrorMotionExplorer, RootsExplorer, DriftExplorer, TurnCalibrationExplorer)

__all__ = [
    "EXPLORERS",
    "DriftExplorer",
    "ErrorMotionExplorer",
    "RootsExplorer",
    "TurnCalibrationExplorer",
]
