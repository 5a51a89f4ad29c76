"""What the publishers of the recordings found in them, as they have it: the numbers to meet."""

import numpy as np
from scipy.constants import degree

from driftlab.calibration.matrix_conventions import ImuTkMatrices, NominalReadings
from driftlab.checks import FloatArray
from driftlab.core.vectors import cross_matrix
from driftlab.recordings.publishers import (
    XSENS_ACCELEROMETER_SCALE,
    XSENS_GYRO_SCALE,
    XSENS_ZERO_COUNT,
)

from .tilt_fit import Triad

TRIANGLES = ("upper triangle", "lower triangle")
"""Two calibrations of one record by IMU-TK, with its axes and with others; both are public."""

_COUNTS = NominalReadings(
    XSENS_GYRO_SCALE, XSENS_ZERO_COUNT, XSENS_ACCELEROMETER_SCALE, XSENS_ZERO_COUNT
)
_ACCELEROMETERS_B, _GYROS_B = (33124.2, 33275.2, 32364.4), (32777.1, 32459.8, 32511.8)
IMU_TK = (
    ImuTkMatrices(
        [[1.0, -0.0033593, -0.00890639], [0.0, 1.0, -0.0213341], [0.0, 0.0, 1.0]],
        np.diag([0.00241278, 0.00242712, 0.00241168]),
        _ACCELEROMETERS_B,
        [[1, 0.00593634, 0.00111101], [0.00808812, 1, -0.0535569], [0.0253067, -0.0025513, 1]],
        np.diag([0.000209295, 0.000209899, 0.000209483]),
        _GYROS_B,
        readings=_COUNTS,
    ),
    ImuTkMatrices(
        [[1.0, 0.0, 0.0], [-0.00354989, 1.0, 0.0], [-0.00890444, -0.0213032, 1.0]],
        np.diag([0.00241267, 0.00242659, 0.00241232]),
        _ACCELEROMETERS_B,
        [[1, 0.00927517, 0.00990014], [0.00507442, 1, -0.0322229], [0.0162201, -0.0239393, 1]],
        np.diag([0.000209338, 0.000209834, 0.000209664]),
        _GYROS_B,
        readings=_COUNTS,
    ),
)
"""The two, of raw counts; the accelerometers' T says which triangle."""
IMU_TK_COSTS = (0.120131, 0.00150696)
"""Half the sum of squares that IMU-TK ends with: of forces, (m/s^2)^2, and of tilts, rad^2."""

# imu-calib: five units, s in percent, m and epsilon in degrees, b in m/s^2 and in deg/s.
_SCALES = ("s_x", "s_y", "s_z")
_ANGLES = ("m_yz", "m_xy", "m_xz")
_FIVE_ACCELEROMETERS = {
    "s_x": (0.363, 0.471, 0.382, 0.263, 0.251),
    "s_y": (0.315, 0.482, 0.355, 0.448, 0.286),
    "s_z": (0.647, 0.932, 0.78, 0.721, 0.804),
    "m_yz": (0.123, -0.284, 0.26, -0.009, 0.056),
    "m_xy": (0.02, -0.01, -0.012, -0.028, 0.0),
    "m_xz": (0.317, 0.145, 0.282, -0.104, 0.191),
    "b_x": (0.103, 0.09, 0.096, 0.065, 0.07),
    "b_y": (0.097, 0.07, 0.008, 0.092, 0.036),
    "b_z": (0.344, 0.338, -0.045, -0.009, 0.182),
}
_FIVE_GYROS = {
    "s_x": (0.041, 0.007, -0.058, 0.227, 0.226),
    "s_y": (0.457, 0.26, 0.277, 0.599, 0.57),
    "s_z": (0.826, -0.179, 0.242, 0.308, 0.853),
    "m_yz": (-0.034, -0.639, 0.15, -0.105, 0.08),
    "m_xy": (-0.12, 0.21, -0.072, 0.025, 0.178),
    "m_xz": (0.806, 0.262, 0.876, 0.072, 0.497),
    "b_x": (1.146, -0.573, 0.573, -1.261, -1.031),
    "b_y": (-0.401, 1.089, -0.344, 1.031, 0.401),
    "b_z": (1.261, 0.286, 1.261, 4.813, 1.432),
    "epsilon_x": (0.03, -0.565, 0.142, -0.102, 0.077),
    "epsilon_y": (-0.364, 0.013, -0.482, -0.129, -0.223),
    "epsilon_z": (-0.074, 0.069, -0.079, 0.015, 0.075),
}
UNITS = ("mpu9150-1", "mpu9150-2", "mpu9150-3", "mpu9150-4", "mpu9150-5")
BIAS_STEP = 1e-3
"""The published gyro biases are whole multiples of this, rad/s."""


def imu_tk_triads(triangle: int) -> tuple[Triad, Triad]:
    """Accelerometers and gyros of the Xsens as published, in the units of the record."""
    errors = IMU_TK[triangle].imu_errors
    return (
        Triad(errors.accelerometer_error_matrix, errors.accelerometer_bias),
        Triad(errors.gyro_error_matrix, errors.gyro_bias),
    )


def imu_calib_triads(unit: int) -> tuple[Triad, Triad]:
    """Accelerometers and gyros of one of five units, as the authors' table has them.

    Their gyros measure (I + [epsilon x]) (M true + b), their accelerometers M true + b, with M
    triangular. Which m is which entry their code tells, and with it the fit gives the table back.
    """
    accelerometers, gyros = ({name: row[unit] for name, row in table.items()} for table in _TABLES)
    seen = np.eye(3) + cross_matrix(_column(gyros, "epsilon", degree))
    return (
        Triad(_triangular(accelerometers), _column(accelerometers, "b", 1.0)),
        Triad(
            seen @ (np.eye(3) + _triangular(gyros)) - np.eye(3), seen @ _column(gyros, "b", degree)
        ),
    )


_TABLES = (_FIVE_ACCELEROMETERS, _FIVE_GYROS)


def _triangular(column: dict[str, float]) -> FloatArray:
    error = np.diag([column[name] for name in _SCALES]) / 100
    error[[1, 0, 0], [2, 1, 2]] = np.array([column[name] for name in _ANGLES]) * degree
    return error


def _column(column: dict[str, float], letter: str, unit: float) -> FloatArray:
    return np.array([column[f"{letter}_{axis}"] for axis in "xyz"]) * unit
