"""Living scenes of chapter 10: a ship and what its compass shows, and Schuler's pendulum."""

from .pendulum import SchulerPendulum
from .ship import ShipUnderWay

SCENES = (ShipUnderWay, SchulerPendulum)
