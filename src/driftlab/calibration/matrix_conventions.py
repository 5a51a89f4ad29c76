"""Calibration matrices of other programs, to and from `ImuErrors`, and nominal readings.

Here ``measured = (I + K) true + bias``: the matrix makes errors, and the bias is the sensors'.
Most programs write the matrix that takes the errors out, its inverse. A bias is subtracted either
before their matrix, and is then ours (IMU-TK, kalibr, imucal), or behind it,
``true = K measured - b``, and is then one along the body axes (PSINS, ROS, RealSense).

What a program knows beyond a matrix and a bias for each triad, such as gyros that feel acceleration
or accelerometers that sit apart, is refused if it is not zero, not dropped.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Self

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import degree

from driftlab.body_frames import body_frame_rotation
from driftlab.checks import FloatArray, checked_instance, finite_array, keep, positive_array
from driftlab.core.vectors import transform
from driftlab.imu import ImuErrors, checked_imu_errors


@dataclass(frozen=True, eq=False)
class NominalReadings:
    """Nominal SI value of a reading: ``scale (reading - zero)``.

    The errors of a unit are what remains beyond that, so the same unit has other errors with other
    nominal scales.

    Attributes
    ----------
    gyro_scale_factor : array_like, shape () or (3,)
        rad/s a reading, of all gyros or of each.
    gyro_zero : array_like, shape () or (3,)
        Reading of a gyro that does not turn.
    accelerometer_scale_factor : array_like, shape () or (3,)
        m/s^2 a reading.
    accelerometer_zero : array_like, shape () or (3,)
        Reading of an accelerometer without specific force.

    Examples
    --------
    Counts of a converter with 16 bits, whose middle is zero:

    >>> counts = NominalReadings(1 / 4778, 32768, 1 / 415, 32768)
    >>> errors = counts.imu_errors(
    ...     4778 * np.eye(3), [32768] * 3, 415 * np.eye(3), [33183] * 3
    ... )
    >>> errors.accelerometer_bias, counts.triads(errors)[3].round()
    (array([1., 1., 1.]), array([33183., 33183., 33183.]))
    """

    gyro_scale_factor: ArrayLike = 1.0
    gyro_zero: ArrayLike = 0.0
    accelerometer_scale_factor: ArrayLike = 1.0
    accelerometer_zero: ArrayLike = 0.0

    def __post_init__(self) -> None:
        for field in fields(self):
            array = finite_array(getattr(self, field.name), field.name)
            if array.shape not in ((), (3,)):
                raise ValueError(
                    f"{field.name}: expected shape () or (3,), got shape {array.shape}."
                )
            if field.name.endswith("scale_factor"):
                positive_array(array, field.name)
            plain = array.tolist()  # so that readings can be compared, and nobody changes them
            keep(self, **{field.name: tuple(plain) if array.ndim else plain})

    def imu_errors(
        self,
        gyro_matrix: ArrayLike,
        gyro_offset: ArrayLike,
        accelerometer_matrix: ArrayLike,
        accelerometer_offset: ArrayLike,
    ) -> ImuErrors:
        """Errors (...) of a unit whose readings are a matrix times the true values, and an offset.

        The matrices (..., 3, 3) are in readings per rad/s and per m/s^2, the offsets (..., 3) in
        readings.
        """
        gyro_scale_factor, gyro_zero, scale, zero = self._threes()
        gyro = gyro_scale_factor[:, np.newaxis] * finite_array(gyro_matrix, "gyro_matrix", 3, 3)
        accelerometer = scale[:, np.newaxis] * finite_array(
            accelerometer_matrix, "accelerometer_matrix", 3, 3
        )
        for name, triad in (("gyro", gyro), ("accelerometer", accelerometer)):
            gains = np.einsum("...ii->...i", triad)
            if not ((gains >= 0.2) & (gains <= 5)).all():
                worst = gains.flat[np.argmax(np.abs(np.log(np.clip(gains, 1e-9, None))))]
                raise ValueError(
                    f"{name}_matrix: expected sensors that read 0.2 to 5 times their nominal "
                    f"value, got {worst:.3g} times; give the scale of the readings, or turn the "
                    "axes round."
                )
        gyro_offset = finite_array(gyro_offset, "gyro_offset", 3)
        accelerometer_offset = finite_array(accelerometer_offset, "accelerometer_offset", 3)
        return checked_imu_errors(
            ImuErrors(
                gyro_scale_factor * (gyro_offset - gyro_zero),
                gyro - np.eye(3),
                scale * (accelerometer_offset - zero),
                accelerometer - np.eye(3),
            )
        )

    def triads(
        self, imu_errors: ImuErrors
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Matrix and offset of the gyros' readings and of the accelerometers', from errors."""
        gyro_scale_factor, gyro_zero, scale, zero = self._threes()
        imu_errors = checked_imu_errors(imu_errors)
        return (
            (np.eye(3) + imu_errors.gyro_error_matrix) / gyro_scale_factor[:, np.newaxis],
            imu_errors.gyro_bias / gyro_scale_factor + gyro_zero,
            (np.eye(3) + imu_errors.accelerometer_error_matrix) / scale[:, np.newaxis],
            imu_errors.accelerometer_bias / scale + zero,
        )

    def _threes(self) -> list[FloatArray]:
        """Scales and zeros, three each."""
        return [np.broadcast_to(getattr(self, field.name), 3) for field in fields(self)]


_SI_READINGS = NominalReadings()
"""Readings that are rad/s and m/s^2 already."""


def checked_inverse(matrix: FloatArray, name: str) -> FloatArray:
    """Return the inverses of matrices (..., 3, 3), refusing a singular one by name."""
    if not (np.linalg.cond(matrix) < 1e12).all():
        raise ValueError(f"{name}: expected a matrix with an inverse, got a singular one.")
    return np.linalg.inv(matrix).astype(np.float64, copy=False)


def checked_zeros(**effects: ArrayLike) -> None:
    """Refuse effects, given by name, that a matrix and a bias for each triad cannot represent."""
    for name, effect in effects.items():
        size = np.abs(finite_array(effect, name)).max()
        if size > 0:
            raise ValueError(
                f"{name}: expected zeros, because ImuErrors has no place for it, got up to "
                f"{size:.3g}; take its effect out of the readings first, or give zeros and live "
                "with it."
            )


_ROUNDING = 1e-12  # of an error matrix, which has no unit


@dataclass(frozen=True, eq=False)
class ImuTkMatrices:
    """IMU-TK: ``true = T K (reading - b)``, in SI units.

    Attributes
    ----------
    acc_T, acc_K, acc_b, gyro_T, gyro_K, gyro_b : array_like, shapes (..., 3, 3) and (..., 3)
        Misalignment with ones on its diagonal and with the signs it is written with, scale (a
        diagonal matrix), and bias in readings.
    readings : NominalReadings
        What its readings are; the biases and errors of `imu_errors` are relative to it.

    Notes
    -----
    Kyle-ak/imu_tk at 7780270, ``include/imu_tk/calibration.h``: ``unbiasNormalize``. The
    accelerometers fix its body axes, T being zero below the diagonal: z lies along the z
    accelerometer, y in the plane of y and z (``MultiPosAccResidual``, ``src/calibration.cpp``).
    Others changed that to zero above; see `imu_errors_in_frame`. The gyros' b is their mean over
    the first rest, so the Earth's rotation is in it.

    Fusion of x-io Technologies has the same formula, ``M s (u - b)`` with the sensitivities s
    (xioTechnologies/Fusion at d69784c, ``Fusion/FusionModel.h``), in degrees per second and g:
    give it as K = s times pi/180 and times 9.80665.

    Examples
    --------
    >>> from driftlab.imu import TYPICAL_ERRORS
    >>> matrices = ImuTkMatrices.from_imu_errors(TYPICAL_ERRORS)
    >>> float(matrices.gyro_K[0, 0].round(7))  # the x gyro reads 10 ppm too much
    0.99999
    >>> back = matrices.imu_errors.gyro_error_matrix
    >>> np.allclose(back, TYPICAL_ERRORS.gyro_error_matrix, atol=1e-15)
    True
    """

    acc_T: ArrayLike
    acc_K: ArrayLike
    acc_b: ArrayLike
    gyro_T: ArrayLike
    gyro_K: ArrayLike
    gyro_b: ArrayLike
    readings: NominalReadings = _SI_READINGS

    @property
    def imu_errors(self) -> ImuErrors:
        """The same unit as `ImuErrors`."""
        acc = finite_array(self.acc_T, "acc_T", 3, 3) @ finite_array(self.acc_K, "acc_K", 3, 3)
        gyro = finite_array(self.gyro_T, "gyro_T", 3, 3) @ finite_array(self.gyro_K, "gyro_K", 3, 3)
        return checked_instance(self.readings, NominalReadings, "readings").imu_errors(
            checked_inverse(gyro, "gyro_T"),
            finite_array(self.gyro_b, "gyro_b", 3),
            checked_inverse(acc, "acc_T"),
            finite_array(self.acc_b, "acc_b", 3),
        )

    @classmethod
    def from_imu_errors(
        cls, imu_errors: ImuErrors, readings: NominalReadings = _SI_READINGS
    ) -> Self:
        """IMU-TK's matrices of a unit, in the body axes that it has."""
        gyro, gyro_b, acc, acc_b = checked_instance(readings, NominalReadings, "readings").triads(
            imu_errors
        )
        gyro, acc = (
            checked_inverse(gyro, "gyro_error_matrix"),
            checked_inverse(acc, "accelerometer_error_matrix"),
        )
        gyro_K, acc_K = gyro * np.eye(3), acc * np.eye(3)
        gyro_T, acc_T = gyro @ np.linalg.inv(gyro_K), acc @ np.linalg.inv(acc_K)
        return cls(acc_T, acc_K, acc_b, gyro_T, gyro_K, gyro_b, readings=readings)


@dataclass(frozen=True, eq=False)
class KalibrMatrices:
    """kalibr, scale-misalignment: ``f = M f + b``, ``w = M_g C_gyro_i w + A C_gyro_i f + b``.

    On the left stands what is measured: kalibr's matrices make errors, as ours do. Whoever
    multiplies his readings by M has each error twice.

    Attributes
    ----------
    accelerometers_M, gyroscopes_M : array_like, shape (..., 3, 3)
        Scale and non-orthogonality; zero above the diagonal.
    gyroscopes_C_gyro_i : array_like, shape (..., 3, 3)
        Rotation from the axes of the accelerometers to those of the gyros.
    gyroscopes_A : array_like, shape (..., 3, 3)
        What the gyros feel of specific force, (rad/s)/(m/s^2); refused if not zero.
    gyro_bias, accelerometer_bias : array_like, shape (..., 3)
        rad/s and m/s^2; not in its files, for kalibr's biases wander during the recording.
    rx_i, ry_i, rz_i : array_like, shape (..., 3)
        Places of the accelerometers in its model with size effect, m; refused if not zero.

    Notes
    -----
    ethz-asl/kalibr at 1f60227, ``IccSensors.py`` of ``kalibr_imu_camera_calibration``:
    ``IccScaledMisalignedImu``. Asked for in its issues 189, 334, 436 and 603. The accelerometers
    fix its body axes (our "accelerometers"): x lies along the x accelerometer, y in the plane of x
    and y.

    Examples
    --------
    >>> lower = np.array([[0.99, 0, 0], [0.02, 1.01, 0], [0, 0, 1.0]])
    >>> kalibr = KalibrMatrices(lower, lower, np.eye(3))
    >>> matrix = kalibr.imu_errors.accelerometer_error_matrix
    >>> float(matrix[0, 0].round(3))  # reads one per cent too little
    -0.01
    """

    accelerometers_M: ArrayLike
    gyroscopes_M: ArrayLike
    gyroscopes_C_gyro_i: ArrayLike
    gyroscopes_A: ArrayLike = ((0.0,) * 3,) * 3
    gyro_bias: ArrayLike = (0.0,) * 3
    accelerometer_bias: ArrayLike = (0.0,) * 3
    rx_i: ArrayLike = (0.0,) * 3
    ry_i: ArrayLike = (0.0,) * 3
    rz_i: ArrayLike = (0.0,) * 3

    @property
    def imu_errors(self) -> ImuErrors:
        """The same unit as `ImuErrors`."""
        checked_zeros(
            gyroscopes_A=self.gyroscopes_A, rx_i=self.rx_i, ry_i=self.ry_i, rz_i=self.rz_i
        )
        turn = finite_array(self.gyroscopes_C_gyro_i, "gyroscopes_C_gyro_i", 3, 3)
        if not np.allclose(turn @ np.swapaxes(turn, -1, -2), np.eye(3), rtol=0, atol=1e-6):
            raise ValueError("gyroscopes_C_gyro_i: expected a rotation matrix, got another one.")
        return _SI_READINGS.imu_errors(
            finite_array(self.gyroscopes_M, "gyroscopes_M", 3, 3) @ turn,
            finite_array(self.gyro_bias, "gyro_bias", 3),
            finite_array(self.accelerometers_M, "accelerometers_M", 3, 3),
            finite_array(self.accelerometer_bias, "accelerometer_bias", 3),
        )

    @classmethod
    def from_imu_errors(cls, imu_errors: ImuErrors) -> Self:
        """kalibr's matrices of a unit that has kalibr's body axes."""
        errors = checked_imu_errors(imu_errors)
        above = np.abs(np.triu(errors.accelerometer_error_matrix, 1)).max()
        if above > _ROUNDING:
            raise ValueError(
                "accelerometer_error_matrix: expected zeros above the diagonal, as kalibr's body "
                f"axes have it, got up to {above:.3g}; change them by imu_errors_in_frame."
            )
        turn = body_frame_rotation(errors.gyro_error_matrix, frame="upper triangle")
        return cls(
            np.eye(3) + errors.accelerometer_error_matrix,
            np.tril((np.eye(3) + errors.gyro_error_matrix) @ np.swapaxes(turn, -1, -2)),
            turn,
            gyro_bias=errors.gyro_bias,
            accelerometer_bias=errors.accelerometer_bias,
        )


@dataclass(frozen=True, eq=False)
class ImucalMatrices:
    """imucal, after Ferraris: ``reading = K R true + b``, the true rate in degrees per second.

    Attributes
    ----------
    K_a, R_a, b_a, K_g, R_g, b_g : array_like, shapes (..., 3, 3) and (..., 3)
        Scale (a diagonal matrix), rows of unit length, and bias in readings. K_g is in readings
        per degree per second, K_a in readings per m/s^2.
    K_ga : array_like, shape (..., 3, 3)
        What the gyros feel of specific force, in readings per m/s^2; refused if not zero.
    readings : NominalReadings
        What its readings are; SI unless told, for degrees per second say
        ``NominalReadings(gyro_scale_factor=degree)``.

    Notes
    -----
    mad-lab-fau/imucal at 8716e4c, ``imucal/ferraris_calibration_info.py``: `calibrate`, which
    applies the inverse. Its body axes are those of the hands: along the six rests for the
    accelerometers, along the three turns for the gyros.

    Examples
    --------
    >>> readings = NominalReadings(gyro_scale_factor=degree)
    >>> ferraris = ImucalMatrices(np.eye(3), np.eye(3), np.zeros(3),
    ...                           1.03 * np.eye(3), np.eye(3), np.zeros(3), readings=readings)
    >>> float(ferraris.imu_errors.gyro_error_matrix[0, 0].round(3))
    0.03
    """

    K_a: ArrayLike
    R_a: ArrayLike
    b_a: ArrayLike
    K_g: ArrayLike
    R_g: ArrayLike
    b_g: ArrayLike
    K_ga: ArrayLike = ((0.0,) * 3,) * 3
    readings: NominalReadings = _SI_READINGS

    @property
    def imu_errors(self) -> ImuErrors:
        """The same unit as `ImuErrors`."""
        checked_zeros(K_ga=self.K_ga)
        return checked_instance(self.readings, NominalReadings, "readings").imu_errors(
            finite_array(self.K_g, "K_g", 3, 3) @ finite_array(self.R_g, "R_g", 3, 3) / degree,
            finite_array(self.b_g, "b_g", 3),
            finite_array(self.K_a, "K_a", 3, 3) @ finite_array(self.R_a, "R_a", 3, 3),
            finite_array(self.b_a, "b_a", 3),
        )

    @classmethod
    def from_imu_errors(
        cls, imu_errors: ImuErrors, readings: NominalReadings = _SI_READINGS
    ) -> Self:
        """Imucal's matrices of a unit, in the body axes that it has."""
        gyro, b_g, acc, b_a = checked_instance(readings, NominalReadings, "readings").triads(
            imu_errors
        )
        gyro = gyro * degree
        K_g, K_a = (np.linalg.norm(m, axis=-1)[..., np.newaxis] * np.eye(3) for m in (gyro, acc))
        R_g, R_a = np.linalg.inv(K_g) @ gyro, np.linalg.inv(K_a) @ acc
        return cls(K_a, R_a, b_a, K_g, R_g, b_g, readings=readings)


@dataclass(frozen=True, eq=False)
class PsinsMatrices:
    """PSINS: ``true = Kg measured - eb`` and ``true = Ka measured - db``, in SI units.

    Attributes
    ----------
    Kg, Ka : array_like, shape (..., 3, 3)
        Calibration matrices, after ``sf`` has made SI units of the pulses.
    eb, db : array_like, shape (..., 3)
        Biases *behind* the matrix, rad/s and m/s^2; its files have degrees per hour and micro-g.
    Ka2, Kap, rx, ry, rz, tGA, gSens : array_like
        Squares and signs of the accelerometers, their places, the delay between the triads, what
        the gyros feel of specific force; refused if not zero.

    Notes
    -----
    WangShanpeng/PSINS at c1706f1, ``base/imu/imuclbt.m``, ``clbtfile.m``. Its simulation
    ``imuadderr.m`` is ours with dKg = K, so Kg is near I - dKg. The accelerometers fix the body
    axes of ``base/kf/sysclbt.m``: Ka is zero above the diagonal (our "accelerometers").

    Examples
    --------
    >>> import numpy as np
    >>> psins = PsinsMatrices(0.5 * np.eye(3), np.ones(3), np.eye(3), np.zeros(3))
    >>> psins.imu_errors.gyro_bias  # two at the sensor are one behind the matrix
    array([2., 2., 2.])
    """

    Kg: ArrayLike
    eb: ArrayLike
    Ka: ArrayLike
    db: ArrayLike
    Ka2: ArrayLike = 0.0
    Kap: ArrayLike = 0.0
    rx: ArrayLike = 0.0
    ry: ArrayLike = 0.0
    rz: ArrayLike = 0.0
    tGA: ArrayLike = 0.0
    gSens: ArrayLike = 0.0

    @property
    def imu_errors(self) -> ImuErrors:
        """The same unit as `ImuErrors`."""
        refused = "Ka2", "Kap", "rx", "ry", "rz", "tGA", "gSens"
        checked_zeros(**{name: getattr(self, name) for name in refused})
        return _bias_behind_matrix(Kg=self.Kg, eb=self.eb, Ka=self.Ka, db=self.db)

    @classmethod
    def from_imu_errors(cls, imu_errors: ImuErrors) -> Self:
        """PSINS' matrices of a unit, in the body axes that it has."""
        return cls(*_matrix_before_bias(imu_errors))


@dataclass(frozen=True, eq=False)
class RosMatrices:
    """imu_calib of ROS: ``true = SM measured - bias``, and gyros that lose their bias only.

    Attributes
    ----------
    SM : array_like, shape (..., 3, 3)
        Of the accelerometers; its file has the nine numbers row by row.
    bias : array_like, shape (..., 3)
        Of the accelerometers behind the matrix, m/s^2.
    gyro_bias : array_like, shape (..., 3)
        Behind the gyros' matrix, rad/s.
    gyro_SM : array_like, shape (..., 3, 3)
        Of the gyros: imu_calib has none, which is the unit matrix.

    Notes
    -----
    dpkoch/imu_calib at 59f5d17, ``src/accel_calib/accel_calib.cpp`` and ``src/apply_calib.cpp``.
    Its body axes are those of the six rests. A driver itself should publish what the device says,
    in m/s^2 (+g upward at rest) and rad/s: REP 145, ros-infrastructure/rep, ``rep-0145.rst``.

    RealSense corrects both triads by the same formula (librealsense at cacc8e7,
    ``src/proc/motion-transform.cpp``). In the ``calibration.json`` of its tool
    ``rs-imu-calibration.py`` the nine numbers stand column by column:
    ``SM = np.reshape(nine, (3, 3)).T``.

    Examples
    --------
    >>> import numpy as np
    >>> ros = RosMatrices(np.diag([1.25, 1, 1]), [0.25, 0, 0], np.zeros(3))
    >>> float(ros.imu_errors.accelerometer_bias[0])
    0.2
    """

    SM: ArrayLike
    bias: ArrayLike
    gyro_bias: ArrayLike
    gyro_SM: ArrayLike = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))

    @property
    def imu_errors(self) -> ImuErrors:
        """The same unit as `ImuErrors`."""
        return _bias_behind_matrix(
            gyro_SM=self.gyro_SM, gyro_bias=self.gyro_bias, SM=self.SM, bias=self.bias
        )

    @classmethod
    def from_imu_errors(cls, imu_errors: ImuErrors) -> Self:
        """Both matrices of a unit; imu_calib itself can use them if `gyro_SM` is the unit one."""
        gyro_SM, gyro_bias, SM, bias = _matrix_before_bias(imu_errors)
        return cls(SM, bias, gyro_bias, gyro_SM)


def _bias_behind_matrix(**triads: ArrayLike) -> ImuErrors:
    """Errors of a unit whose true values are a matrix times what is measured, less a bias."""
    forward: list[FloatArray] = []
    names = list(triads)
    for matrix, bias in (names[:2], names[2:]):
        triad = checked_inverse(finite_array(triads[matrix], matrix, 3, 3), matrix)
        forward += [triad, transform(triad, finite_array(triads[bias], bias, 3))]
    return _SI_READINGS.imu_errors(*forward)


def _matrix_before_bias(
    imu_errors: ImuErrors,
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Matrices and biases such that true is a matrix times what is measured, less a bias."""
    gyro, gyro_bias, accelerometer, bias = _SI_READINGS.triads(checked_imu_errors(imu_errors))
    gyro = checked_inverse(gyro, "gyro_error_matrix")
    accelerometer = checked_inverse(accelerometer, "accelerometer_error_matrix")
    return gyro, transform(gyro, gyro_bias), accelerometer, transform(accelerometer, bias)
