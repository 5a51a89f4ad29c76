"""Attitude from angle increments: Cayley vectors and coning algorithms (Perelyaev, Chelnokov)."""

from driftlab._lazy import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
