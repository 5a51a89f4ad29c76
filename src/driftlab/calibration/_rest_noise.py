"""How well means over rests are known, and turns between them: noise taken from the rests."""

from __future__ import annotations

import warnings

import numpy as np

from driftlab.checks import FloatArray, checked_instance
from driftlab.core.poses import Poses, Variances
from driftlab.earth import EARTH_RATE
from driftlab.imu import ImuNoise
from driftlab.recordings.recording import Recording

from .consistency import InconsistentWarning

_BLOCK = 0.5
"""Means over so many seconds show the slow part of the noise."""
_LEAST = 1e-9
"""Least deviation of a mean, relative to gravity, or in rad and rad/s: records without noise."""
_GRAVITY_FACTOR = 1.25
"""More than the errors of scale and bias of any accelerometer make together."""


def noise_of_rests(
    recording: Recording,
    rows: list[tuple[int, int]],
    poses: Poses,
    noise: ImuNoise | None = None,
) -> tuple[Variances, tuple[float, float]]:
    """Return variances of the rests' means and of the turns between them, and their colour.

    Each rest has its first row and the first row after it in `rows`. `noise` is used instead of
    the rests' own white noise. The colour, of gyros and accelerometers, is the variance of
    means over half a second as a multiple of white noise. The direction of the Earth's rate is
    taken as unknown.
    """
    assert recording.accelerometer is not None
    interval = poses.interval
    share = 1.0 if recording.kind == "rates" else 1 / interval
    lengths = np.array([e - b for b, e in rows])[:, np.newaxis]
    if noise is None:
        width = max(1, round(_BLOCK / interval))
        rate, rate_colour = _row_variance(share * recording.gyro, rows, width)
        force, force_colour = _row_variance(share * recording.accelerometer, rows, width)
    else:
        checked_instance(noise, ImuNoise, "noise")
        rate = np.full(3, noise.angle_random_walk**2 / interval)
        force = np.full(3, noise.velocity_random_walk**2 / interval)
        rate_colour = force_colour = np.nan
    per_increment = float(rate.mean()) * interval**2
    return (
        Variances(
            np.maximum(force / lengths, (_LEAST * poses.gravity) ** 2),
            np.maximum(rate / lengths, _LEAST**2),
            np.maximum(per_increment * np.diff(poses.edges), _LEAST**2),
            EARTH_RATE**2 / 3,  # of known size, in any direction
        ),
        (rate_colour, force_colour),
    )


def _row_variance(
    samples: FloatArray, rows: list[tuple[int, int]], width: int
) -> tuple[FloatArray, float]:
    """Variance (3,) of one sample that explains the means over `width`, and its share of colour."""
    white = sum(((samples[b:e] - samples[b:e].mean(axis=0)) ** 2).sum(axis=0) for b, e in rows)
    white = np.asarray(white / sum(e - b - 1 for b, e in rows))
    total, freedom = np.zeros(3), 0
    for b, e in rows:
        count = (e - b) // width
        if count > 1:
            means = samples[b : b + count * width].reshape(count, width, 3).mean(axis=1)
            total += ((means - means.mean(axis=0)) ** 2).sum(axis=0)
            freedom += count - 1
    if not freedom or not white.any():
        return white, np.nan
    slow = width * total / freedom
    return slow, float(slow.sum() / white.sum())


def warn_of_gravity(poses: Poses) -> None:
    """Warn if the accelerometers at rest show another gravity, and refuse such as show none.

    The median counts, for biases push up in one rest and down in another.
    """
    sizes = np.linalg.norm(poses.force, axis=-1)
    if not sizes.all():
        raise ValueError(
            "rests: expected accelerometers that feel gravity at each rest, got zeros in rest "
            f"{int(np.argmin(sizes))}."
        )
    found = float(np.median(sizes))
    if not 1 / _GRAVITY_FACTOR < found / poses.gravity < _GRAVITY_FACTOR:
        warnings.warn(
            f"gravity: expected what the accelerometers show at rest within a factor of "
            f"{_GRAVITY_FACTOR:g}, got {poses.gravity:g} m/s^2, and they show {found:.4g}: the "
            "scale of all three would be wrong by that. Is it another planet's, or their unit?",
            InconsistentWarning,
            stacklevel=3,
        )
