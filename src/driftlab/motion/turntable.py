"""An inertial unit on a turntable: rotation schemes as data, and the increments of ideal sensors.

A scheme is a row of rotations about body axes with pauses between them. The table stands on the
rotating Earth; its centre does not move. The integrals of angular rate and specific force over
any interval are known in closed form, so nothing here is an integration of anything else.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from driftlab.checks import (
    FloatArray,
    finite_number,
    positive_number,
    unit_quaternions,
    whole_number,
)
from driftlab.core.quaternion import conjugate, from_rotation_vector, multiply, rotate
from driftlab.core.vectors import left_jacobian
from driftlab.earth import checked_latitude, earth_rate, gravity

DIRECTIONS = MappingProxyType({
    "East": (1, 0, 0), "West": (-1, 0, 0),
    "North": (0, 1, 0), "South": (0, -1, 0),
    "Up": (0, 0, 1), "Down": (0, 0, -1),
})  # fmt: skip
"""The directions that body axes can be set to, in East, North, Up."""

_AXES = {"X": 0, "Y": 1, "Z": 2}


@dataclass(frozen=True)
class Scheme:
    """Pauses and rotations of a turntable, in the order in which they happen.

    Attributes
    ----------
    rotations : str
        Words like ``+90Y`` or ``-180X``: sign, angle in degrees up to 3600, body axis. A pause
        comes before the first rotation and after each one.
    start : tuple of str
        Directions of the body axes x, y and z at the start: keys of `DIRECTIONS`, right-handed.
    dwell : float
        Length of each pause, s.
    rate : float
        Rate of the rotations, rad/s.

    Examples
    --------
    >>> scheme = Scheme("+90Z -90Z", start=("North", "West", "Up"), dwell=60.0)
    >>> scheme.positions
    3
    """

    rotations: str
    start: tuple[str, str, str] = ("East", "North", "Up")
    dwell: float = 120.0
    rate: float = float(np.radians(10.0))

    def __post_init__(self) -> None:
        # Plain numbers and a tuple, so that a scheme can be the key of a cache.
        for name in ("dwell", "rate"):
            object.__setattr__(self, name, positive_number(getattr(self, name), name))
        if not isinstance(self.rotations, str):
            raise ValueError(f"rotations: expected text, got {self.rotations!r}.")
        words = self.start if isinstance(self.start, tuple | list) else ()
        axes = [DIRECTIONS.get(word) for word in words if isinstance(word, str)]
        if len(axes) != 3 or None in axes or np.linalg.det(np.array(axes, float)) != 1:
            raise ValueError(
                f"start: expected three of {', '.join(DIRECTIONS)} for x, y, z, right-handed, "
                f"got {self.start!r}."
            )
        object.__setattr__(self, "start", tuple(self.start))
        self.turns  # noqa: B018  (an invalid word is refused now, not later)

    @property
    def turns(self) -> list[tuple[FloatArray, float]]:
        """Axis and signed angle of each rotation.

        Returns
        -------
        list of tuple
            For each rotation a unit vector (3,) in body axes and an angle in rad.

        Examples
        --------
        >>> axis, angle = Scheme("-180X").turns[0]
        >>> print(axis, round(angle, 4))
        [1. 0. 0.] -3.1416
        """
        turns = []
        for word in self.rotations.replace("−", "-").split():
            match = re.fullmatch(r"([+-]\d+(?:\.\d+)?)([A-Za-z])", word)
            if not match or match[2].upper() not in _AXES or float(match[1]) == 0:
                raise ValueError(
                    "rotations: expected words like +90Y or -180X: sign, degrees, "
                    f"axis X, Y or Z, got {word!r}."
                )
            if abs(float(match[1])) > 3600:
                raise ValueError(f"rotations: expected at most 3600 degrees a word, got {word!r}.")
            turns.append((np.eye(3)[_AXES[match[2].upper()]], float(np.radians(float(match[1])))))
        return turns

    @property
    def positions(self) -> int:
        """Number of pauses, one more than rotations.

        Returns
        -------
        int
            At least 1.

        Examples
        --------
        >>> NINETEEN_POSITIONS.positions
        19
        """
        return len(self.turns) + 1

    @property
    def start_attitude(self) -> FloatArray:
        """Attitude at the start.

        Returns
        -------
        ndarray, shape (4,)
            Unit quaternion, body to East, North, Up.

        Examples
        --------
        >>> Scheme("+90Z", start=("North", "West", "Up")).start_attitude.round(4)
        array([0. , 0. , 0.7071, 0.7071])
        """
        # The columns of the matrix are where the body axes point.
        columns = np.array([DIRECTIONS[word] for word in self.start], float).T
        return Rotation.from_matrix(columns).as_quat()


NINETEEN_POSITIONS = Scheme(
    "+90Y +90Y +90Y -90Y -90Y -90Y +90Z +90X +90X +90X -90X -90X -90X +90Z +90Z -90Z -90Z -90Z",
    ("Up", "East", "North"),
)
"""Nineteen positions, of a public demo of the PSINS toolbox, there after Xie Bo (2011)."""

EIGHTEEN_ROTATIONS = Scheme(
    "+90Y +180Y +180Y +90Z +180Z +180Z +90X +180X +180X "
    "+90X +90X +90X +90Z +90Z +90Z +90Y +90Y +90Y",
    ("East", "North", "Up"),
)
"""Eighteen rotations, commonly printed as those of Camberlein and Mazzanti (1985); not confirmed.

The contents of the paper's own Table 1 are lost in the copy at hand.
"""

SCHEMES = MappingProxyType({"19 positions": NINETEEN_POSITIONS, "18 rotations": EIGHTEEN_ROTATIONS})


class Record(NamedTuple):
    """Increments of ideal sensors on the table, and the true attitude.

    Attributes
    ----------
    interval : float
        Sample interval, s.
    angle_increments : ndarray, shape (n, 3)
        Integrals of the rate against inertial space, body axes, rad.
    velocity_increments : ndarray, shape (n, 3)
        Integrals of the specific force, body axes, m/s.
    attitude : ndarray, shape (n + 1, 4)
        Unit quaternions, body to East, North, Up, before and after each interval.

    Examples
    --------
    >>> record = simulate(Scheme("+90Z", dwell=1.0), latitude=0.7, interval=0.5)
    >>> record.angle_increments.shape, record.attitude.shape
    ((22, 3), (23, 4))
    """

    interval: float
    angle_increments: FloatArray
    velocity_increments: FloatArray
    attitude: FloatArray


class Segment(NamedTuple):
    """One pause or rotation of the table, with a constant rate against the Earth.

    Attributes
    ----------
    axis : ndarray, shape (3,)
        Unit vector in body axes.
    rate : float
        Rate about the axis, rad/s; zero in a pause.
    duration : float
        s.
    attitude : ndarray, shape (4,)
        Attitude at the beginning, body to East, North, Up.

    Examples
    --------
    >>> pause, rotation, _ = segments(Scheme("-90Z", dwell=1.0), interval=0.5)
    >>> print(pause.rate, f"{np.degrees(rotation.rate):.1f}")
    0.0 -10.0
    """

    axis: FloatArray
    rate: float
    duration: float
    attitude: FloatArray


def segments(scheme: Scheme, interval: float) -> list[Segment]:
    """Pauses and rotations of a scheme, each as long as a whole number of intervals.

    A rotation is slowed down, and a pause prolonged, until it ends with an interval.

    Parameters
    ----------
    scheme : Scheme
        The rotations.
    interval : float
        s.

    Returns
    -------
    list of Segment
        Pauses and rotations in turn, beginning and ending with a pause.

    Examples
    --------
    A pause of 1 s and a rotation of 9 s, in intervals of 2 s:

    >>> [segment.duration for segment in segments(Scheme("+90Z", dwell=1.0), interval=2.0)]
    [2.0, 10.0, 2.0]
    """
    seconds = finite_number(interval, "interval")
    if seconds <= 0:
        raise ValueError(f"interval: expected a positive time, got {interval!r}.")

    def whole(duration: float) -> float:
        # A duration that is a whole number of intervals, but for rounding, is kept.
        return seconds * max(1, int(np.ceil(duration / seconds - 1e-6)))

    attitude, row = scheme.start_attitude, []
    pause = whole(scheme.dwell)
    for axis, angle in scheme.turns:
        duration = whole(abs(angle) / scheme.rate)
        row.append(Segment(axis, 0.0, pause, attitude))
        row.append(Segment(axis, angle / duration, duration, attitude))
        attitude = multiply(attitude, from_rotation_vector(angle * axis))
    row.append(Segment(np.array([0.0, 0.0, 1.0]), 0.0, pause, attitude))
    return row


def simulate(
    scheme: Scheme, latitude: float, interval: float, *, whole: int = 1, altitude: float = 0.0
) -> Record:
    """Increments of ideal gyros and accelerometers on a turntable, in closed form.

    Parameters
    ----------
    scheme : Scheme
        Pauses and rotations of the table.
    latitude : float
        Latitude of the table, rad; not a pole.
    interval : float
        Sample interval, s.
    whole : int
        Each pause and rotation is prolonged to a multiple of `whole` sample intervals.
    altitude : float
        Altitude of the table, m.

    Returns
    -------
    Record
        Increments and attitudes of all intervals.

    Examples
    --------
    A quarter turn about Up lasts 9 s, and with the two pauses the Earth turns for 11 s:

    >>> record = simulate(Scheme("+90Z", dwell=1.0), latitude=np.radians(45.0), interval=0.5)
    >>> print(f"{record.angle_increments[:, 2].sum() - np.pi / 2:.6f}")
    0.000567
    >>> print(f"{11 * earth_rate(np.radians(45.0))[2]:.6f}")
    0.000567
    """
    place = float(checked_latitude(finite_number(latitude, "latitude")))
    whole = whole_number(whole, "whole")
    row = segments(scheme, whole * interval)
    earth = earth_rate(place)
    up = np.array([0.0, 0.0, float(gravity(place, finite_number(altitude, "altitude")))])
    parts = [_sense(segment, earth, up, interval) for segment in row]
    angles, velocities, attitudes = (np.concatenate(part) for part in zip(*parts, strict=True))
    first = row[0].attitude[np.newaxis]
    return Record(float(interval), angles, velocities, np.concatenate([first, attitudes]))


def _sense(
    segment: Segment, earth: FloatArray, force: FloatArray, interval: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Increments (n, 3) and (n, 3), and attitudes (n, 4) after them, of one segment."""
    count = round(segment.duration / interval)
    angles = segment.rate * interval * np.arange(count + 1)
    attitude = multiply(
        segment.attitude, from_rotation_vector(angles[:, np.newaxis] * segment.axis)
    )
    # A vector fixed to the Earth turns backwards in body axes, by the angle x in an interval.
    to_body = conjugate(attitude[:-1])
    x = segment.rate * interval
    seen = left_jacobian(-x * segment.axis)
    turned = (x * segment.axis) + interval * rotate(to_body, earth) @ seen.T
    pushed = interval * rotate(to_body, force) @ seen.T
    return turned, pushed, attitude[1:]


def stand(
    attitude: ArrayLike, latitude: float, interval: float, count: int, altitude: float = 0.0
) -> Record:
    """Increments of ideal sensors of a unit at rest on the Earth, in one attitude.

    Parameters
    ----------
    attitude : array_like, shape (4,)
        Body to East, North, Up; the quaternion need not be of unit norm.
    latitude : float
        rad; not a pole.
    interval : float
        Sample interval, s.
    count : int
        Number n of intervals.
    altitude : float
        m.

    Returns
    -------
    Record
        n equal angle increments and n equal velocity increments.

    Examples
    --------
    >>> record = stand([0, 0, 0, 1], latitude=np.radians(30.0), interval=3600.0, count=1)
    >>> print(np.degrees(record.angle_increments[0]).round(3))  # one hour of the Earth's rotation
    [ 0.    13.026  7.521]
    """
    seconds = finite_number(interval, "interval")
    stood = unit_quaternions(attitude, "attitude")
    if seconds <= 0 or stood.ndim != 1:
        raise ValueError(
            "interval, attitude: expected a positive time and one attitude (4,), "
            f"got {interval!r} s and shape {stood.shape}."
        )
    up_axis = np.array([0.0, 0.0, 1.0])
    standing = Segment(up_axis, 0.0, whole_number(count, "count") * seconds, stood)
    place = float(checked_latitude(finite_number(latitude, "latitude")))
    up = np.array([0.0, 0.0, float(gravity(place, finite_number(altitude, "altitude")))])
    turned, pushed, attitudes = _sense(standing, earth_rate(place), up, interval)
    return Record(
        float(interval), turned, pushed, np.concatenate([standing.attitude[np.newaxis], attitudes])
    )
