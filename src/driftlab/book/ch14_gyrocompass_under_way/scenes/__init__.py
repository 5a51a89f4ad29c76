"""Living scenes of chapter 14: a ship and what its compass shows, and Schuler's pendulum."""

from .pendulum import SchulerPendulum
from .ship import ShipUnderWay

__all__ = ["SCENES", "SchulerPendulum", "ShipUnderWay"]

SCENES = (ShipUnderWay, SchulerPendulum)
