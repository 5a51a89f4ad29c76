"""What the model of the calibration still leaves out, and how large it would be.

Each size follows from a stated assumption; what it would bias is the state that takes it up.
"""

import numpy as np
from scipy.constants import degree, g, hour, micro

from driftlab.book.ch11_kalman_calibration.experiments import expected_covariance, unit_of
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.calibration import ERROR_MODELS
from driftlab.motion.scheme import NINETEEN_POSITIONS


def left_out(latitude: float) -> DataTable:
    """Return a table of what is left out, for a table at a latitude, rad."""
    model = ERROR_MODELS["averaged"]
    stated = np.sqrt(np.diag(expected_covariance(NINETEEN_POSITIONS, latitude)))
    # Noise of the reference that remembers for so long counts as so many times its variance.
    remembered = np.exp(-1 / 5.0)
    counted = np.sqrt((1 + remembered) / (1 - remembered)) - 1
    pulse, pause = 1e-3 / np.sqrt(12), NINETEEN_POSITIONS.dwell
    biases = [i for i, name in enumerate(model.names) if name.startswith("accelerometer bias")]
    kinds = (
        ("scale of an accelerometer that differs between + and -", "10 ppm of $|f|$",
         "accelerometer bias", 10 * micro * g),
        ("scale of a gyro that differs between + and -", r"2 ppm of $|\omega|$",
         "gyro scale", 2 * micro),
        ("temperature, accelerometers", "30 µg a kelvin, half a kelvin in the run",
         "accelerometer bias", 15 * micro * g),
        ("temperature, gyros", "0.01 deg/h a kelvin, half a kelvin in the run",
         "gyro bias", 0.005 * degree / hour),
        ("gravity of the place", "10 mGal beside the ellipsoid's", "accelerometer scale",
         1e-4 / g),
        ("axes of the table not square", "any; the filter is told no angle of the table",
         "gyro non-orthogonality", 0.0),
        ("vibration that is not white", "remembered for five updates", "accelerometer bias",
         counted * stated[biases].max()),
        ("quantisation of the accelerometers", "pulses of 1 mm/s, over one pause",
         "accelerometer bias", np.sqrt(2) * pulse / pause),
    )  # fmt: skip
    names, assumed, states, sizes = zip(*kinds, strict=True)
    # Largest standard deviation that the filter of 27 states has for them, nineteen positions.
    known = [
        max(x for name, x in zip(model.names, stated, strict=True) if name.startswith(state))
        for state in states
    ]
    return DataTable({
        "name": (names, "", "of what is left out"),
        "assumed": (assumed, "", "what is taken for granted of it"),
        "state": (states, "", "beginning of the name of the states that would take it up"),
        "by": ([_words(*each) for each in zip(states, sizes, strict=True)], "", "bias there"),
        "in_deviations": (np.array(sizes) / known, "", "this bias, in deviations stated for them"),
    })  # fmt: skip


def _words(state: str, size: float) -> str:
    """Size to two digits, in the unit in which the states are usually given; or "nothing"."""
    unit_size, unit = unit_of(state)
    return f"{float(f'{size / unit_size:.2g}'):g} {unit}" if size else "nothing"
