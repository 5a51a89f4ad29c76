"""The living scenes of chapter 13."""

from .level_box import BoxOnTheWayNorth
from .over_the_top import BowOverTheTop

__all__ = ["SCENES", "BowOverTheTop", "BoxOnTheWayNorth"]

SCENES = (BoxOnTheWayNorth, BowOverTheTop)
