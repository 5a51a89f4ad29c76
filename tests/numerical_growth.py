"""The growth of errors by differences of two navigations: an independent reference."""

import numpy as np

from driftlab.calibration.body_axes import attitude_error
from driftlab.earth import EARTH_RADIUS, EARTH_RATE
from driftlab.increments import measure
from driftlab.quaternion import from_rotation_vector, multiply
from driftlab.strapdown import final_state, navigate, stationary_state


def numerical_growth(record, latitude, model):
    """Matrix (6, size): central differences of navigation along a record.

    Each error is put into attitude, velocity or sensors as it is defined: computed attitude
    (I - [phi x]) C, computed minus true velocity, sensors that say too much.
    """
    sizes = np.full(model.size, 1e-4)
    sizes[3:6] = 1e-2
    steps = np.concatenate([np.diag(sizes), -np.diag(sizes)])
    start = stationary_state(
        latitude, multiply(from_rotation_vector(-steps[:, :3]), record.attitude[0])
    )
    more = model.higher_order_errors(steps) if model.higher_order else None
    said = measure(record.increments, model.imu_errors(steps), higher_order=more)
    found = final_state(navigate(start._replace(velocity=steps[:, 3:6]), said))
    ends = np.hstack([attitude_error(found.attitude, record.attitude[-1]), found.velocity])
    plus, minus = np.split(ends, 2)
    return (plus - minus).T / (2 * sizes)


def allowed(model, duration, turned):
    """Bounds (6, size) of what the linear model leaves out.

    An error that enters within the interval is carried on as if it had been there from the
    beginning, while the local axes turn by W T: a relative error of W T. A tilt accelerates, and
    the velocity turns the local axes: half of g T^2/R, Schuler's oscillation begun. Only this
    touches attitudes; there the velocity that comes within the interval counts for all of it.
    """
    # Gravity at the equator, and its gradient, which is larger than 2 g/R by 0.7 %.
    axes, schuler = EARTH_RATE * duration, 1.007 * 9.79 * duration**2 / EARTH_RADIUS
    way = duration / EARTH_RADIUS
    gyro = slice(6, 9 + len(model.gyro_basis))
    tilts = np.ones(model.size)
    tilts[3:6] = way
    tilts[gyro] = turned + axes
    tilts[6:9] = duration
    pushes = 9.8 * duration * tilts
    pushes[3:6] = 1
    pushes[gyro.stop : gyro.stop + 3] = duration
    pushes[gyro.stop + 3 :] = 9.8 * duration
    bounds = np.empty((6, model.size))
    bounds[:3] = schuler * tilts
    bounds[:3, 3:6] = (axes + schuler) * way
    bounds[:3, gyro.stop :] = way * pushes[gyro.stop :]
    bounds[3:] = (axes + schuler) * pushes
    bounds[3:, 3:6] = axes**2 + schuler
    # Rounding of velocities of 400 m/s and third derivatives of a step of 1e-4.
    return bounds + 1e-8 * np.vstack([np.tile(tilts, (3, 1)), np.tile(pushes, (3, 1))])
