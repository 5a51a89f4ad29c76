"""Rotation schemes of a turntable, as data: rotations about body axes with pauses between them."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np
from scipy.spatial.transform import Rotation

from driftlab.checks import (
    USUAL_TABLE,
    FloatArray,
    checked_text,
    finite_number,
    keep,
    named_or_own,
    positive_number,
    shown,
    table_rate,
)

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
        Rate of the rotations, rad/s; at most a turn a second, faster than any table goes from
        position to position.

    See Also
    --------
    driftlab.motion.turntable_trajectory : The true motion.
    driftlab.calibration.design_scheme : A search for good ones.

    Examples
    --------
    >>> scheme = Scheme("+90Z -90Z", start=("North", "West", "Up"), dwell=60.0)
    >>> scheme.positions, scheme.with_duration(378.0).dwell
    (3, 120.0)
    """

    rotations: str
    start: tuple[str, str, str] = ("East", "North", "Up")
    dwell: float = 120.0
    rate: float = float(np.radians(10.0))

    def __post_init__(self) -> None:
        # Plain numbers and a tuple, so that a scheme can be the key of a cache.
        for name in ("dwell", "rate"):
            keep(self, **{name: positive_number(getattr(self, name), name)})
        table_rate(self.rate, "rate", USUAL_TABLE)
        checked_text(self.rotations, "rotations")
        words = self.start if isinstance(self.start, tuple | list) else ()
        axes = [DIRECTIONS.get(word) for word in words if isinstance(word, str)]
        if len(axes) != 3 or None in axes or np.linalg.det(np.array(axes, float)) != 1:
            raise ValueError(
                f"start: expected three of {', '.join(DIRECTIONS)} for x, y, z, right-handed, "
                f"got {shown(self.start)}."
            )
        keep(self, start=tuple(self.start))
        self.turns  # noqa: B018  (an invalid word is refused now, not later)

    @property
    def turns(self) -> list[tuple[FloatArray, float]]:
        """Axis (3,) in body axes, a unit vector, and signed angle, rad, of each rotation."""
        turns = []
        for word in self.rotations.replace("−", "-").split():
            match = re.fullmatch(r"([+-]\d+(?:\.\d+)?)([A-Za-z])", word)
            if not match or match[2].upper() not in _AXES or float(match[1]) == 0:
                raise ValueError(
                    "rotations: expected words like +90Y or -180X: sign, degrees, "
                    f"axis X, Y or Z, got {shown(word)}."
                )
            if abs(float(match[1])) > 3600:
                raise ValueError(
                    f"rotations: expected at most 3600 degrees a word, got {shown(word)}."
                )
            turns.append((np.eye(3)[_AXES[match[2].upper()]], float(np.radians(float(match[1])))))
        return turns

    @property
    def positions(self) -> int:
        """Number of pauses, one more than rotations."""
        return len(self.turns) + 1

    def with_duration(self, duration: float) -> Scheme:
        """Return the same rotations with equal pauses such that all of it takes `duration`, s."""
        turning = sum(abs(angle) for _, angle in self.turns) / self.rate
        if not finite_number(duration, "duration") > turning:
            raise ValueError(
                f"duration: expected more than {turning:g} s, which the rotations take, "
                f"got {shown(duration)}."
            )
        return replace(self, dwell=(duration - turning) / self.positions)

    @property
    def start_attitude(self) -> FloatArray:
        """Attitude at the start (4,), unit quaternion, body to East, North, Up."""
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
"""Eighteen rotations, commonly quoted as those of Camberlein and Mazzanti (1985); not confirmed.

The contents of the paper's own Table 1 are lost in the copy at hand.
"""

SCHEMES = MappingProxyType({"19 positions": NINETEEN_POSITIONS, "18 rotations": EIGHTEEN_ROTATIONS})


def checked_scheme(scheme: Scheme | str, name: str = "scheme") -> Scheme:
    """Return a scheme, or the one that a name in `SCHEMES` stands for."""
    return named_or_own(scheme, Scheme, SCHEMES, name, "such as Scheme('+90X -90X')")
