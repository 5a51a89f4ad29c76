"""Saratov, where the gyrocompass of the book stands: gravity and rates there, a unit of drift."""

import numpy as np

from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity

LATITUDE = SARATOV_LATITUDE
GRAVITY = float(gravity(LATITUDE))
LEVEL_RATE = EARTH_RATE * np.cos(LATITUDE)
SCHULER = float(np.sqrt(GRAVITY / EARTH_RADIUS))
HOURLY = np.pi / 180 / 3600  # degree per hour, rad/s
