"""How a bent gyro triad drifts, and how whole turns calibrate it (Larin)."""

from driftlab._lazy import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
