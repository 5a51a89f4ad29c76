"""Records of a turntable on three schemes, and the arguments of `calibrate` for them."""

import numpy as np

from driftlab.calibration import ERROR_MODELS
from driftlab.imu import TYPICAL_ERRORS, ImuNoise, PriorStandardDeviations
from driftlab.increments import measure
from driftlab.motion import SCHEMES, Scheme, turntable_trajectory
from driftlab.quaternion import from_rotation_vector, multiply

LATITUDE = float(np.radians(37.5))
STEP = 0.75
"""Samples of a table that turns by 2.25 degrees in one; the filter looks every half minute."""
SIX = Scheme("+90X +90X +90Y +90Y +90Z", ("North", "West", "Up"), dwell=720.0)
RECORDS = {
    name: turntable_trajectory(
        Scheme(scheme.rotations, scheme.start, scheme.dwell / 4, np.radians(3.0)),
        LATITUDE,
        STEP,
        multiple_of=40,
    )
    for name, scheme in {**SCHEMES, "six positions": SIX}.items()
}


def inputs(scheme="19 positions", noisy=True, seed=1, prior=None, errors=TYPICAL_ERRORS):
    """Arguments of a right run."""
    record, rng = RECORDS[scheme], np.random.default_rng(seed)
    prior = PriorStandardDeviations() if prior is None else prior
    noise = ImuNoise()
    measured = measure(record.increments, errors, noise, rng)
    tilt = from_rotation_vector(prior.attitude * rng.standard_normal(3))
    updates = measured.angle.shape[-2] // 40
    return {
        "increments": measured,
        "reference_velocity": noisy * noise.reference_velocity * rng.normal(size=(updates, 3)),
        "latitude": LATITUDE,
        "start": multiply(tilt, record.attitude[0]),
        "model": ERROR_MODELS["averaged"],
        "prior": prior,
        "noise": noise,
        "keep": 10**6,
    }
