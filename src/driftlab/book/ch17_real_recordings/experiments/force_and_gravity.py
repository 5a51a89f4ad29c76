"""What the calibrations of this chapter need besides the gyros."""

from driftlab.checks import FloatArray
from driftlab.recordings.recording import Recording


def force_and_gravity(log: Recording) -> tuple[FloatArray, float]:
    """Specific force (n, 3) of a record and gravity at its place, m/s^2, where it knows both."""
    if log.accelerometer is None or log.gravity is None:
        raise ValueError("log: expected accelerometers and gravity, got a record without.")
    return log.accelerometer, log.gravity
