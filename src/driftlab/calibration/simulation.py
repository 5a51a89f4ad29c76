"""Calibrations whose truth is known: made-up units on a simulated table, and what is left.

A trial draws units and noise, lets the filter work, and compares. A filter is consistent if its
errors are as large as it says: then `Trial.squared_errors` average to the number of states, and
`Calibration.surprise` to three.
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
    """A calibration beside the truth.

    Attributes
    ----------
    calibration : Calibration
    unit : Unit
        The true errors, in the table's axes; `unit_in_axes` turns them into the filter's.
    errors : ndarray, shape (..., k, size)
        Of the states, in the filter's axes, at the times of the calibration.
    """

    calibration: Calibration
    unit: Unit
    errors: FloatArray

    @property
    def squared_errors(self) -> FloatArray:
        """Squared errors (..., k) in units of the covariance that the filter states (NEES).

        States that were known from the beginning, with a spread of zero, do not count.
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
    """A calibration on a turntable, with everything that it depends on but the random draws.

    Attributes
    ----------
    scheme : Scheme
    latitude : float
        Of the table, rad.
    frame : str
        Choice of body axes, one of `driftlab.triad.BODY_FRAMES`.
    spread, noise : Spread, Noise
        What units, setting-up and noise are drawn from, and what the filter is told.
    told : Noise, optional
        What the filter is told of the noise, if not the truth.
    sample_interval, update_interval : float
        Of the sensors and of the filter, s. An update takes an even number of samples. If the table
        turns by more than 2 or 3 degrees in a sample, the computation itself begins to err by a
        part of what the filter looks for. Pauses and turns are drawn out to whole updates.
    keep : int
        The history keeps each `keep`-th update, and the last.
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
        """Calibrate random units, or one `unit` again and again.

        Parameters
        ----------
        rng : numpy.random.Generator
        runs : int, optional
            How many at once, along a leading axis of the result. If not given, as many as `unit`
            has, or one without a leading axis.
        unit : Unit, optional
            Without it units are drawn from `spread`.

        Warns
        -----
        UnobservableWarning
            If the scheme leaves errors in the dark; it names them.
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
    """The unit (...) in the axes of a frame, and the rotation (..., 3, 3) from the given axes.

    What a filter for that frame should find. With None for the frame the axes stay.
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
    """Errors (..., k, size) of a calibration, in the sense of its states: zero is perfect.

    Parameters
    ----------
    calibration : Calibration
    unit : Unit
        The true errors, in the table's axes.
    attitude : array_like, shape (k, 4)
        The true attitudes of the table's axes at the calibration's times.
    """
    model = calibration.model
    true, turn = unit_in_axes(unit, model.frame)
    errors = model.state(true)[..., np.newaxis, :] - calibration.state
    true_attitude = attitude_of_axes(attitude, turn[..., np.newaxis, :, :])
    errors[..., :3] = attitude_error(calibration.attitude, true_attitude)
    errors[..., 3:6] = calibration.velocity
    return errors
