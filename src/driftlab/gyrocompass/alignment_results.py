"""What an alignment at rest finds, and how far the rates contradict it."""

from __future__ import annotations

from typing import NamedTuple

from driftlab.checks import FloatArray
from driftlab.frames import from_euler_angles

from .contradictions import NOT_KNOWN


class Alignment(NamedTuple):
    """Heading, pitch, roll and latitude of a body at rest, from its own sensors; each (...).

    Attributes
    ----------
    heading, pitch, roll, latitude : ndarray, shape (...)
        rad.
    level_rate : ndarray, shape (...)
        Horizontal component of the angular rate, in the unit of that rate. Without errors it is
        U cos(latitude), where U is the Earth's rate.
    rate_excess : ndarray, shape (...)
        Whole rate found less that of the Earth, rad/s; NaN if the rate is a direction only.
    latitude_excess : ndarray, shape (...)
        Latitude found less that which is known, rad; NaN if none is.
    heading_doubt : ndarray, shape (...)
        By how much a rate of the size of this contradiction can turn the heading, rad, as
        `rate_contradiction` has it; NaN if nothing is known. It is a deviation that stands on two
        numbers: of rates isotropic in space 5 in 100 turn the heading by more than 4.3 times it, of
        leans about level lines 20 in 100.

    Examples
    --------
    >>> import numpy as np
    >>> from driftlab.gyrocompass import align
    >>> rate = [5.156e-5, 5.156e-5, 0.0]  # rad/s: the Earth turns about North and Up
    >>> found = align(rate, [0.0, 9.8, 0.0])
    >>> float(np.degrees(found.latitude).round(6)), f"{found.level_rate:.3e}"
    (45.0, '5.156e-05')
    """

    heading: FloatArray
    pitch: FloatArray
    roll: FloatArray
    latitude: FloatArray
    level_rate: FloatArray
    rate_excess: FloatArray = NOT_KNOWN
    latitude_excess: FloatArray = NOT_KNOWN
    heading_doubt: FloatArray = NOT_KNOWN

    @property
    def attitude(self) -> FloatArray:
        """Attitude quaternion, well defined in every attitude, the vertical included.

        Returns
        -------
        ndarray, shape (..., 4)
            Body (forward, up, right) to North, Up, East.

        Examples
        --------
        >>> from driftlab.gyrocompass import align
        >>> align([5.156e-5, 5.156e-5, 0.0], [0.0, 9.8, 0.0]).attitude  # level, headed North
        array([0., 0., 0., 1.])
        """
        return from_euler_angles(self.heading, self.pitch, self.roll)


class AlignmentErrors(NamedTuple):
    """First-order errors of an alignment, computed minus true.

    Attributes
    ----------
    heading, pitch, roll, latitude : ndarray, shape (...)
        rad.
    heading_terms : ndarray, shape (..., 4)
        Terms of `heading` in the paper's order, rad: east gyro; east accelerometer by tan(pitch);
        north accelerometer by tan(pitch); east accelerometer by tan(latitude).

    Examples
    --------
    A bias of 1e-4 g of the east accelerometer at 60 degrees:

    >>> import numpy as np
    >>> from driftlab.gyrocompass import alignment_errors
    >>> bias = [0.0, 0.0, 9.8e-4]
    >>> found = alignment_errors(0.0, 0.0, np.radians(60.0), np.zeros(3), bias, gravity=9.8)
    >>> f"{found.heading:.2e} {found.roll:.2e}"  # rad
    '-1.73e-04 -1.00e-04'
    """

    heading: FloatArray
    pitch: FloatArray
    roll: FloatArray
    latitude: FloatArray
    heading_terms: FloatArray
