"""Rows of the panel of chapter 05."""

from .ch04 import turn_calibration
from .values import Rows, Values


def turns_on_earth(values: Values) -> Rows:
    """Those of chapter 04, integrated exactly."""
    return turn_calibration({"steps": 100, "formula": "exact", **values})
