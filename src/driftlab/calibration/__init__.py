"""An inertial unit calibrated on a turntable by a Kalman filter (Wu and others)."""

from driftlab._lazy import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
