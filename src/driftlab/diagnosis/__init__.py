"""What may have gone wrong in a calibration: asked by name, never run on its own."""

from driftlab._lazy import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
