"""Motions whose truth is known: test profiles, a turntable, a vehicle under way."""

from driftlab._lazy import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
