"""Heading from gravity and the Earth's rotation, at rest, and its errors; Plotnikov et al.

Axes and angles are those of `driftlab.frames`, which are the paper's. The paper's formulas
have no numbers. They are called by their subject here: (alignment heading), (alignment pitch),
(alignment roll); and in other modules (heading), (operating heading).
"""

from __future__ import annotations

import warnings
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    finite_arrays,
    nonzero_vectors,
    positive_number,
)
from driftlab.core.vectors import norms
from driftlab.earth import (
    EARTH_RATE,
    EQUATOR_GRAVITY,
    checked_gravity,
    checked_latitude,
    gravity as normal_gravity,
)
from driftlab.frames import _pitch_and_roll, checked_pitch, from_euler_angles

from ._contradictions import (
    NOT_KNOWN,
    RateContradiction,
    checked_tolerance,
    rate_contradiction,
    sign_slip,
)
from .heading_error import checked_small_bias

_LEAST_COLATITUDE = np.radians(0.1)
_DEG_PER_HOUR = np.radians(1) / 3600
_LIKE_THE_EARTH = 1.9
"""A rate of another size than the Earth's by more than this factor is hardly one in rad/s. In deg/s
it would be 57 times as large; integrals over half a second are a half."""


class InconsistentAlignmentWarning(UserWarning):
    """Warning that the rates of an alignment are not those of a body at rest on the Earth.

    Examples
    --------
    A body that is not at rest, at a latitude of 45 degrees:

    >>> import warnings
    >>> from driftlab.gyrocompass import align
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     found = align([5e-5, 5.6e-5, 0.0], [0.0, 9.8, 0.0], latitude=np.pi / 4)
    >>> caught[0].category.__name__
    'InconsistentAlignmentWarning'
    """


class Alignment(NamedTuple):
    """Heading, pitch, roll and latitude of a body at rest, from its own sensors; each (...).

    Attributes
    ----------
    heading, pitch, roll, latitude : ndarray, shape (...)
        rad.
    level_rate : ndarray, shape (...)
        Horizontal component of the angular rate, in the unit of that rate. Without errors it is
        U cos(latitude), where U is the Earth's rate.
    rate_discrepancy : ndarray, shape (...)
        Whole rate found less that of the Earth, rad/s; NaN if the rate is a direction only.
    latitude_discrepancy : ndarray, shape (...)
        Latitude found less that which is known, rad; NaN if none is.
    heading_uncertainty : ndarray, shape (...)
        By how much a rate of the size of this contradiction can turn the heading, rad; NaN if
        nothing is known. It is a deviation that stands on two numbers: of rates isotropic in space
        5 in 100 turn the heading by more than 4.3 times it, of leans about level lines 20 in 100.
    """

    heading: FloatArray
    pitch: FloatArray
    roll: FloatArray
    latitude: FloatArray
    level_rate: FloatArray
    rate_discrepancy: FloatArray = NOT_KNOWN
    latitude_discrepancy: FloatArray = NOT_KNOWN
    heading_uncertainty: FloatArray = NOT_KNOWN

    @property
    def attitude(self) -> FloatArray:
        """Quaternion (..., 4), body to North, Up, East; well defined in a vertical body too."""
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
    """

    heading: FloatArray
    pitch: FloatArray
    roll: FloatArray
    latitude: FloatArray
    heading_terms: FloatArray


def align(
    angular_rate: ArrayLike,
    specific_force: ArrayLike,
    *,
    latitude: ArrayLike | None = None,
    rate_unit: float | None = 1.0,
    heading_tolerance: float = np.pi / 360,
) -> Alignment:
    r"""Heading, pitch, roll and latitude of a body at rest, from its own sensors alone.

    Parameters
    ----------
    angular_rate, specific_force : array_like, shape (..., 3)
        Means over the time of alignment, in body axes forward, up, right; rad/s, or what
        `rate_unit` says. The angles depend on the directions only, so the unit of force is free.
    latitude : array_like, shape (...), optional
        Known latitude, rad. The angles do not depend on it; it is held against the one found.
    rate_unit : float or None
        Size of the unit of `angular_rate`, rad/s: radians(1)/3600 for deg/h. The size of the rate
        is held against the Earth's. None if it has no unit, and is a direction only.
    heading_tolerance : float
        Contradictions that can turn the heading by more are warned of, rad; infinity for none.
        Half a degree if not given.

    Returns
    -------
    Alignment
        Angles (...) in rad, the level rate (...) in the unit of `angular_rate`, and how far the
        rates contradict what is known.

    Raises
    ------
    ValueError
        If either vector is zero, if rate and force are exchanged, or if they are parallel within
        0.1 degrees, as at a pole, where the Earth's rate has no horizontal component.

    Warns
    -----
    InconsistentAlignmentWarning
        If the rate is not the Earth's, by so much that the heading suffers; with the likely
        reason, if it has another unit, or a wrong sign somewhere.

    See Also
    --------
    alignment_errors : What biases do to the angles.
    alignment_standard_deviation : How long to wait.
    align_multi_position : Takes the biases out by turns.
    align_in_inertial_frame : For a body that sways.

    Notes
    -----
    Plotnikov, trigonometric alignment. With the rate w and the force f, pitch, roll, heading and
    latitude follow in this order from

    .. math::

        \sin\vartheta &= \frac{f_1}{|f|}, \qquad \tan\gamma = -\frac{f_3}{f_2}, \\
        \tan\psi &= \frac{w_2 \sin\gamma + w_3 \cos\gamma}
            {w_1 \cos\vartheta - (w_2 \cos\gamma - w_3 \sin\gamma) \sin\vartheta}, \qquad
        \tan\varphi = \frac{w \cdot f}{|w \times f|}.

    The heading is positive from North to West. Two directions
    do not tell in which axes they are given: a log in forward, right, down must be converted first
    by `driftlab.axes.convert_vectors`, or the roll comes out wrong by a quarter turn.

    The body must not turn meanwhile. A body that leans about East by a small angle more at the end
    than at the start turns the heading by this angle over T U cos(latitude), where T is the time of
    the means: an arc minute in five minutes by about a degree. `heading_uncertainty` shows a part
    of that, and little of a lean about East alone. `align_in_inertial_frame` aligns a body that
    sways.

    White noise of the gyros that makes a deviation d of the heading makes this warning, if the
    latitude is known, with the chance exp(-(heading_tolerance/d)^2).

    References
    ----------
    - K. R. Britting, *Inertial Navigation Systems Analysis*, Wiley, 1971.
    - D. H. Titterton, J. L. Weston, *Strapdown Inertial Navigation Technology*, 2nd edition, The
      Institution of Electrical Engineers, 2004.

    Examples
    --------
    At 45 degrees of latitude, with the bow to the West:

    >>> found = align([0.0, 5.156e-5, 5.156e-5], [0.0, 9.8, 0.0])
    >>> [float(np.degrees(angle).round(6)) for angle in (found.heading, found.latitude)]
    [90.0, 45.0]

    Of the direction alone, a degree farther South than is known, what this may do to the heading:

    >>> told = {"latitude": np.radians(46.0), "heading_tolerance": np.inf}
    >>> lost = align([0.0, 1.0, 1.0], [0.0, 9.8, 0.0], rate_unit=None, **told)
    >>> float(np.degrees(lost.heading_uncertainty).round(2))
    1.44
    """
    place = {} if latitude is None else {"latitude": (latitude,)}
    rate, force, *_ = finite_arrays(
        angular_rate=(angular_rate, 3), specific_force=(specific_force, 3), **place
    )
    turn, size = nonzero_vectors(rate, "angular_rate")
    up, pull = nonzero_vectors(force, "specific_force")
    _refuse_exchanged(size, pull)
    tolerance = checked_tolerance(heading_tolerance)
    unit = None if rate_unit is None else positive_number(rate_unit, "rate_unit")
    across = norms(np.cross(turn, up))
    if across.min() < np.sin(_LEAST_COLATITUDE):
        raise ValueError(
            "angular_rate, specific_force: expected directions more than 0.1 degrees from parallel,"
            " because nothing points North at a pole, got an angle of "
            f"{np.degrees(np.arcsin(across.min())):.3g} degrees."
        )
    upward = np.einsum("...i,...i->...", turn, up)
    pitch, roll = _pitch_and_roll(up)
    along = turn[..., 1] * np.cos(roll) - turn[..., 2] * np.sin(roll)
    forward = turn[..., 0] * np.cos(pitch) - along * np.sin(pitch)
    right = turn[..., 1] * np.sin(roll) + turn[..., 2] * np.cos(roll)
    scale = EARTH_RATE if unit is None else unit * size
    seen = rate_contradiction(scale * across, scale * upward, latitude, size_known=unit is not None)
    _warn_of_contradiction(seen, tolerance, latitude)
    found = {
        "heading": np.arctan2(right, forward),
        "pitch": pitch,
        "roll": roll,
        "latitude": np.arctan2(upward, across),
        "level_rate": size * across,
        "rate_discrepancy": seen.rate_discrepancy,
        "latitude_discrepancy": seen.latitude_discrepancy,
        "heading_uncertainty": seen.heading_uncertainty,
    }
    alike = zip(found, np.broadcast_arrays(*found.values()), strict=True)
    return Alignment(**{name: np.array(each)[()] for name, each in alike})


def _refuse_exchanged(rate: FloatArray, force: FloatArray) -> None:
    # Differences of logarithms, because the quotient of a small rate may be none.
    like_gravity = np.abs(np.log(rate) - np.log(EQUATOR_GRAVITY)) < np.log(1.1)
    if like_gravity.all() and (np.abs(np.log(force) - np.log(EARTH_RATE)) < np.log(2)).all():
        raise ValueError(
            "angular_rate, specific_force: expected a rate and then a force, got sizes of "
            f"{rate.flat[0]:.3g} and {force.flat[0]:.3g}, as of the two exchanged."
        )


def _warn_of_contradiction(
    seen: RateContradiction, tolerance: float, latitude: ArrayLike | None
) -> None:
    """Warn where a contradiction can turn a heading by more than `tolerance`, rad."""
    wrong = np.atleast_1d(seen.heading_uncertainty > tolerance)
    if not wrong.any():
        return
    worst = int(np.nanargmax(seen.heading_uncertainty))
    place = np.nan if latitude is None else np.broadcast_to(latitude, wrong.shape).flat[worst]
    excess, turned, doubt = (
        float(np.atleast_1d(each).flat[worst])
        for each in (seen.rate_discrepancy, seen.latitude_discrepancy, seen.heading_uncertainty)
    )
    parts = []
    for size, words in (
        (excess / _DEG_PER_HOUR, "the whole rate by {:+.3g} deg/h"),
        (np.degrees(turned), "the latitude found by {:+.3g} degrees"),
    ):
        if np.isfinite(size):
            parts.append(words.format(size))
    if not parts:
        drift = float(np.atleast_1d(seen.spurious_rate).flat[worst]) / _DEG_PER_HOUR
        parts.append(f"the level rate by {drift:.3g} deg/h")
    many = f", in {wrong.sum()} of {wrong.size} alignments, at worst" if wrong.size > 1 else ""
    warnings.warn(
        f"angular_rate: expected the rate of the Earth at rest, got another{many}: it differs in "
        f"{' and in '.join(parts)}; {_likely_reason(1 + excess / EARTH_RATE, turned, place, doubt)}"
        ".",
        InconsistentAlignmentWarning,
        stacklevel=3,
    )


def _likely_reason(ratio: float, turned: float, place: float, doubt: float) -> str:
    if not np.isnan(ratio) and not 1 / _LIKE_THE_EARTH < ratio < _LIKE_THE_EARTH:
        return (
            f"it is {ratio:.3g} times that of the Earth. Is it in rad/s, and not integrals over an "
            "interval? Otherwise tell rate_unit, the size of its unit in rad/s, or None for "
            "directions alone; if it is, these gyros do not see the Earth, or the body turned"
        )
    return sign_slip(place + turned, place) or (
        "a rate as large across the meridian, where nothing shows it, turns the heading by "
        f"{np.degrees(doubt):.2g} degrees. If the body swayed or leaned, use "
        "align_in_inertial_frame(increments, latitude); if not, calibrate the gyros"
    )


def alignment_errors(
    heading: ArrayLike,
    pitch: ArrayLike,
    latitude: ArrayLike,
    gyro_bias_nue: ArrayLike,
    accelerometer_bias_nue: ArrayLike,
    gravity: ArrayLike | None = None,
) -> AlignmentErrors:
    r"""First-order errors of `align`; (alignment heading), (alignment pitch), (alignment roll).

    Parameters
    ----------
    heading, pitch, latitude : array_like, shape (...)
        rad. The roll does not matter.
    gyro_bias_nue : array_like, shape (..., 3)
        Gyro biases resolved in North, Up, East, rad/s.
    accelerometer_bias_nue : array_like, shape (..., 3)
        Accelerometer biases resolved in North, Up, East, m/s^2.
    gravity : array_like, shape (...), optional
        m/s^2; normal gravity of the latitude if not given.

    Returns
    -------
    AlignmentErrors
        Errors (...) in rad, and the terms of the heading error.

    Raises
    ------
    ValueError
        Within 0.1 degrees of a pole, or of a vertical body: there heading and roll are not two
        angles. `alignment_attitude_error` has no limit in pitch.

    See Also
    --------
    align : The alignment itself.
    alignment_standard_deviation : Its deviation from noise and biases.
    alignment_attitude_error : The same as a rotation, at any pitch.

    Notes
    -----
    With the biases d of the gyros, a of the accelerometers and the Earth's rate U the errors of
    heading, pitch, roll and latitude are

    .. math::

        \delta\psi &= \frac{d_E}{U \cos\varphi}
            + \frac{(a_E \cos\psi + a_N \sin\psi) \tan\vartheta - a_E \tan\varphi}{g}, \\
        \delta\vartheta &= \frac{a_N \cos\psi - a_E \sin\psi}{g}, \qquad
        \delta\gamma = -\frac{a_E \cos\psi + a_N \sin\psi}{g \cos\vartheta}, \\
        \delta\varphi &= \frac{a_N}{g} + \frac{d_U \cos\varphi - d_N \sin\varphi}{U}.

    The third term of the paper's heading error carries a factor tan(latitude) that does not belong
    there; it is left out. The error of the latitude is not in the paper.

    References
    ----------
    - K. R. Britting, *Inertial Navigation Systems Analysis*, Wiley, 1971.

    Examples
    --------
    An east gyro with a bias of 0.01 degrees per hour, at 60 degrees, in arc minutes:

    >>> bias = np.radians([0.0, 0.0, 0.01]) / 3600
    >>> found = alignment_errors(0.0, 0.0, np.radians(60.0), bias, np.zeros(3))
    >>> round(60 * float(np.degrees(found.heading)), 2)
    4.57
    """
    heading, pitch, place, gyro_bias, accelerometer_bias, pull = _alignment_arguments(
        latitude, gyro_bias_nue, accelerometer_bias_nue, gravity, heading=(heading,), pitch=(pitch,)
    )
    checked_pitch(pitch)
    north, _, east = np.moveaxis(accelerometer_bias / pull[..., np.newaxis], -1, 0)
    cosine, sine = np.cos(heading), np.sin(heading)
    terms = np.stack(
        np.broadcast_arrays(
            gyro_bias[..., 2] / (EARTH_RATE * np.cos(place)),
            east * cosine * np.tan(pitch),
            north * sine * np.tan(pitch),
            -east * np.tan(place),
        ),
        axis=-1,
    )
    across = gyro_bias[..., 1] * np.cos(place) - gyro_bias[..., 0] * np.sin(place)
    total = terms.sum(axis=-1)
    shape = np.broadcast_shapes(total.shape, north.shape, across.shape, pitch.shape)
    heading_error, pitch_error, roll_error, latitude_error = (
        np.array(np.broadcast_to(error, shape))[()]
        for error in (
            total,
            north * cosine - east * sine,
            -(east * cosine + north * sine) / np.cos(pitch),
            north + across / EARTH_RATE,
        )
    )
    return AlignmentErrors(
        heading_error,
        pitch_error,
        roll_error,
        latitude_error,
        np.array(np.broadcast_to(terms, (*shape, 4))),
    )


def alignment_attitude_error(
    latitude: ArrayLike,
    gyro_bias_nue: ArrayLike,
    accelerometer_bias_nue: ArrayLike,
    gravity: ArrayLike | None = None,
) -> FloatArray:
    """First-order attitude error of `align`, as a rotation vector; it holds in every attitude.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad.
    gyro_bias_nue : array_like, shape (..., 3)
        Gyro biases resolved in North, Up, East, rad/s.
    accelerometer_bias_nue : array_like, shape (..., 3)
        Accelerometer biases resolved in North, Up, East, m/s^2.
    gravity : array_like, shape (...), optional
        m/s^2; normal gravity of the latitude if not given.

    Returns
    -------
    ndarray, shape (..., 3)
        Rotation in North, Up, East that leads from the true to the computed attitude, rad.

    Raises
    ------
    ValueError
        Within 0.1 degrees of a pole.

    Examples
    --------
    Biases of the North and East accelerometers of 1e-4 g and 2e-4 g at 45 degrees:

    >>> bias = [9.8e-4, 0.0, 19.6e-4]
    >>> alignment_attitude_error(np.radians(45.0), np.zeros(3), bias, gravity=9.8).round(6)
    array([-0.0002, -0.0002,  0.0001])
    """
    place, gyro_bias, accelerometer_bias, pull = _alignment_arguments(
        latitude, gyro_bias_nue, accelerometer_bias_nue, gravity
    )
    north, _, east = np.moveaxis(accelerometer_bias / pull[..., np.newaxis], -1, 0)
    up = gyro_bias[..., 2] / (EARTH_RATE * np.cos(place)) - east * np.tan(place)
    return np.stack(np.broadcast_arrays(-east, up, north), axis=-1)


def _alignment_arguments(
    latitude: ArrayLike,
    gyro_bias_nue: ArrayLike,
    accelerometer_bias_nue: ArrayLike,
    gravity: ArrayLike | None,
    **angles: tuple[ArrayLike],
) -> list[FloatArray]:
    pull = normal_gravity(latitude) if gravity is None else gravity
    arguments = finite_arrays(
        **angles,
        latitude=(latitude,),
        gyro_bias_nue=(gyro_bias_nue, 3),
        accelerometer_bias_nue=(accelerometer_bias_nue, 3),
        gravity=(pull,),
    )
    checked_latitude(arguments[-4])
    checked_gravity(arguments[-1])
    checked_small_bias(arguments[-3], "gyro_bias_nue")
    return arguments
