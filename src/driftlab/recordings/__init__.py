"""Recordings of real inertial units: a typed record, readers, rests, and published sets."""

from driftlab._lazy import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
