"""Systematic drift of a misaligned gyro triad, and its calibration by whole turns (Larin)."""

from driftlab._lazy import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
