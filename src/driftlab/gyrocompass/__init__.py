"""Heading from gravity and the Earth's rotation, at rest and under way (Plotnikov and others)."""

from driftlab._lazy import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
