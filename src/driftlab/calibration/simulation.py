"""Simulated calibrations: random units on a turntable, and the errors that remain.

A trial draws units and noise, runs the filter, and compares. A filter is consistent if its errors
are as large as its covariance states: then `Trial.squared_errors` average to the number of states,
and `Calibration.surprise` to three.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_number, whole_number
from driftlab.core.quaternion import from_rotation_vector, multiply
from driftlab.earth import checked_latitude
from driftlab.imu import (
    Noise,
    Spread,
    Unit,
    broadcast_unit,
    checked_unit,
    measure,
    random_units,
)
from driftlab.motion.turntable import NINETEEN_POSITIONS, Scheme, simulate
from driftlab.triad import body_frame_rotation, change_body_frame

from .error_model import attitude_error, attitude_of_axes, error_model_for
from .filter import Calibration, calibrate
from .observability import passage, warn_if_unobservable


class Trial(NamedTuple):
    """A calibration and the true errors of the unit.

    Attributes
    ----------
    calibration : Calibration
        What the filter found.
    unit : Unit
        The true errors, in the table's axes; `unit_in_axes` brings them to the filter's.
    errors : ndarray, shape (..., k, size)
        Errors of the estimated states, in the filter's axes, at the times of the calibration.

    Examples
    --------
    >>> trial = TableTrial(Scheme("+90X +90X +90Y +90Z"), update_interval=10.0)
    >>> found = trial.run(np.random.default_rng(1))
    >>> within = np.abs(found.errors[-1]) < 3 * found.calibration.deviations[-1]
    >>> f"{within.sum()} of {within.size} errors are within three standard deviations"
    '27 of 27 errors are within three standard deviations'
    """

    calibration: Calibration
    unit: Unit
    errors: FloatArray

    @property
    def squared_errors(self) -> FloatArray:
        """Squared errors, normalised by the covariance that the filter computes (NEES).

        States that were known from the beginning, with a spread of zero, do not count.

        Returns
        -------
        ndarray, shape (..., k)
            Without unit. Of a consistent filter the mean over many trials is the number of states.

        Examples
        --------
        >>> trial = TableTrial(Scheme("+90X +90X +90Y +90Z"), update_interval=10.0)
        >>> trial.run(np.random.default_rng(2), runs=5).squared_errors[:, -1].round(0)
        array([18., 29., 22., 32., 35.])
        """
        covariance = self.calibration.covariance
        variances = np.einsum("...ii->...i", covariance)
        open_states = np.flatnonzero(variances.reshape(-1, variances.shape[-1]).any(axis=0))
        errors = self.errors[..., open_states]
        block = covariance[..., open_states[:, np.newaxis], open_states]
        scaled = np.linalg.solve(block, errors[..., np.newaxis])
        return np.einsum("...i,...i->...", errors, scaled[..., 0])


@dataclass(frozen=True)
class TableTrial:
    """A calibration on a turntable: everything that it depends on but the random draws.

    Attributes
    ----------
    scheme : Scheme
        Pauses and rotations of the table.
    latitude : float
        Of the table, rad.
    frame : str
        Choice of body axes, one of `driftlab.triad.BODY_FRAMES`.
    spread, noise : Spread, Noise
        Distributions of the sensor errors, of the initial attitude and of the noise: those of the
        simulation, and those that the filter assumes.
    told : Noise, optional
        Noise that the filter assumes, if it differs from `noise`.
    sample_interval, update_interval : float
        Of the sensors and of the filter, s. An update takes an even number of samples, and pauses
        and rotations are extended to whole updates. If the table turns by more than 2 or 3 degrees
        in a sample, the computation's own error is a noticeable part of the errors that are sought.
    keep : int
        The history keeps every `keep`-th update, and the last.

    Examples
    --------
    >>> trial = TableTrial(frame="upper triangle", noise=Noise(velocity=0.001))
    >>> trial.update_interval / trial.sample_interval  # samples in an update
    20.0
    """

    scheme: Scheme = NINETEEN_POSITIONS
    latitude: float = float(np.radians(37.5))
    frame: str = "averaged"
    spread: Spread = field(default_factory=Spread)
    noise: Noise = field(default_factory=Noise)
    told: Noise | None = None
    sample_interval: float = 0.05
    update_interval: float = 1.0
    keep: int = 20

    def __post_init__(self) -> None:
        for name, kind in (("scheme", Scheme), ("spread", Spread), ("noise", Noise)):
            if not isinstance(getattr(self, name), kind):
                raise ValueError(
                    f"{name}: expected a {kind.__name__}, got {getattr(self, name)!r}."
                )
        checked_latitude(finite_number(self.latitude, "latitude"))
        error_model_for(self.frame)
        whole_number(self.keep, "keep")
        for name in ("sample_interval", "update_interval"):
            if finite_number(getattr(self, name), name) <= 0:
                raise ValueError(f"{name}: expected a positive time, got {getattr(self, name)!r}.")
        samples = self.update_interval / self.sample_interval
        if abs(samples / 2 - round(samples / 2)) > 1e-9 * samples:
            raise ValueError(
                "update_interval: expected an even number of samples, "
                f"got {samples:g} of {self.sample_interval!r} s."
            )

    def run(
        self, rng: np.random.Generator, runs: int | None = None, unit: Unit | None = None
    ) -> Trial:
        """Calibrate random units, or one given unit with new noise in each run.

        Parameters
        ----------
        rng : numpy.random.Generator
            Source of all random draws.
        runs : int, optional
            Number of runs, along a leading axis of the result. If not given, as many as `unit` has,
            or one without a leading axis.
        unit : Unit, optional
            True sensor errors (...) in the table's axes; drawn from `spread` if not given.

        Returns
        -------
        Trial
            What the filter found, and the truth.

        Raises
        ------
        ValueError
            If the leading axes of `unit` do not fit `runs`.

        Warns
        -----
        UnobservableWarning
            If the scheme leaves errors unobservable; it names them.

        Examples
        --------
        True scale-factor error of a gyro and the one found in eleven minutes, in ppm:

        >>> trial = TableTrial(Scheme("+90X +90X +90Y +90Z"), update_interval=10.0)
        >>> found = trial.run(np.random.default_rng(1))
        >>> units = found.unit, found.calibration.unit
        >>> [round(1e6 * float(unit.gyro_error[0, 0])) for unit in units]
        [-130, -103]
        """
        model = error_model_for(self.frame)
        warn_if_unobservable(passage(self.scheme, self.latitude, model))
        lead = () if runs is None else (whole_number(runs, "runs"),)
        if unit is None:
            unit = random_units(self.spread, rng, *lead)
        unit = checked_unit(unit)
        try:
            unit = broadcast_unit(unit, *lead)
        except ValueError:
            raise ValueError(
                f"unit, runs: expected leading axes that fit {runs!r} runs, got others."
            ) from None
        # Each run has noise of its own, also of one and the same unit.
        lead = unit.gyro_bias.shape[:-1]
        samples = round(self.update_interval / self.sample_interval)
        record = simulate(self.scheme, self.latitude, self.sample_interval, whole=samples)
        angle, velocity = measure(record, unit, self.noise, rng)
        updates = len(record.angle_increments) // samples
        reference = self.noise.velocity * rng.standard_normal((*lead, updates, 3))
        # The table tells its attitude with an error.
        tilt = from_rotation_vector(-self.spread.attitude * rng.standard_normal((*lead, 3)))
        calibration = calibrate(
            angle,
            velocity,
            reference,
            interval=self.sample_interval,
            latitude=self.latitude,
            start=multiply(tilt, record.attitude[0]),
            model=model,
            spread=self.spread,
            noise=self.noise if self.told is None else self.told,
            keep=self.keep,
        )
        places = np.round(calibration.times / self.sample_interval).astype(int)
        errors = estimation_errors(calibration, unit, record.attitude[places])
        return Trial(calibration, unit, errors)


def unit_in_axes(unit: Unit, frame: str | None) -> tuple[Unit, FloatArray]:
    """Sensor errors in the axes of a frame, as a filter for it should find them, and the rotation.

    Parameters
    ----------
    unit : Unit
        Sensor errors (...) in given body axes.
    frame : str or None
        One of `driftlab.triad.BODY_FRAMES`, or None to keep the axes.

    Returns
    -------
    unit : Unit
        Sensor errors (...) in the axes of the frame.
    turn : ndarray, shape (..., 3, 3)
        Rotation matrix from components in the given axes to components in those of the frame.

    Raises
    ------
    ValueError
        If the frame is unknown, or a triad is left-handed or flat.

    Examples
    --------
    >>> from driftlab.imu import TYPICAL
    >>> turned, _ = unit_in_axes(TYPICAL, "averaged")
    >>> bool(np.allclose(turned.gyro_error, turned.gyro_error.T, atol=1e-15))
    True
    """
    if frame is None:
        return unit, np.broadcast_to(np.eye(3), unit.gyro_error.shape)
    turn = body_frame_rotation(unit.gyro_error, unit.accelerometer_error, frame)
    turned = unit._replace(
        gyro_error=change_body_frame(unit.gyro_error, turn),
        accelerometer_error=change_body_frame(unit.accelerometer_error, turn),
    )
    return turned, turn


def estimation_errors(calibration: Calibration, unit: Unit, attitude: ArrayLike) -> FloatArray:
    """Errors of the states that a calibration estimated.

    Parameters
    ----------
    calibration : Calibration
        What the filter found.
    unit : Unit
        The true errors (...), in the table's axes.
    attitude : array_like, shape (k, 4)
        True attitudes of the table's axes at the calibration's times, body to East, North, Up.

    Returns
    -------
    ndarray, shape (..., k, size)
        True minus estimated sensor errors, computed minus true attitude and velocity.

    Examples
    --------
    A calibration that found nothing leaves all errors as they were:

    >>> from driftlab.calibration import FULL
    >>> from driftlab.imu import TYPICAL
    >>> level, none = np.array([[0.0, 0.0, 0.0, 1.0]]), np.zeros((1, 30))
    >>> nothing = Calibration(FULL, none[0], none, np.eye(30), level, none[:, :3], none[0])
    >>> errors = estimation_errors(nothing, TYPICAL, level)
    >>> bool(np.allclose(errors, FULL.state(TYPICAL)))
    True
    """
    model = calibration.model
    true, turn = unit_in_axes(unit, model.frame)
    errors = model.state(true)[..., np.newaxis, :] - calibration.state
    true_attitude = attitude_of_axes(attitude, turn[..., np.newaxis, :, :])
    errors[..., :3] = attitude_error(calibration.attitude, true_attitude)
    errors[..., 3:6] = calibration.velocity
    return errors
