"""Simulated calibrations: random units on a turntable, and the errors that remain.

A trial draws units and noise, runs the filter, and compares. A filter is consistent if its errors
are as large as its covariance states: then `Trial.nees` average to the number of states,
and `Calibration.nis` to three.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import NamedTuple

import numpy as np

from driftlab.checks import (
    FloatArray,
    checked_generator,
    checked_instance,
    finite_number,
    keep,
    one_of,
    positive_number,
    some_of,
    whole_number,
)
from driftlab.core.quaternion import from_rotation_vector, multiply
from driftlab.earth import checked_latitude
from driftlab.higher_order_errors import (
    NO_HIGHER_ORDER_ERRORS,
    TERMS,
    HigherOrderErrors,
    checked_higher_order_errors,
)
from driftlab.imu import (
    ImuErrors,
    ImuNoise,
    PriorStandardDeviations,
    checked_imu_errors,
    random_imu_errors,
)
from driftlab.increments import measure
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme, checked_scheme
from driftlab.motion.turntable import turntable_trajectory

from .body_axes import attitude_error, attitude_of_axes, imu_errors_in_frame
from .calibration_history import Calibration
from .error_dynamics import checked_noise, linearize_along
from .error_model import (
    ERROR_MODELS,
    ErrorModel,
    _prior_standard_deviations,
    _unpacked,
)
from .filter import calibrate
from .kalman import nees
from .observability import _warn_if_unobservable


class Trial(NamedTuple):
    """A calibration and the true errors of the unit.

    Attributes
    ----------
    calibration : Calibration
        What the filter found.
    imu_errors : ImuErrors
        The true errors, in the table's axes; `imu_errors_in_frame` brings them to the filter's.
    errors : ndarray, shape (..., k, size)
        Errors of the estimated states, in the filter's axes, at the times of the calibration.
    higher_order : HigherOrderErrors
        The true errors beyond bias and matrix.
    """

    calibration: Calibration
    imu_errors: ImuErrors
    errors: FloatArray
    higher_order: HigherOrderErrors = NO_HIGHER_ORDER_ERRORS

    @property
    def nees(self) -> FloatArray:
        """Normalised estimation errors squared (..., k): see `driftlab.calibration.nees`."""
        return nees(self.errors, self.calibration.covariance)


def _estimation_errors(
    calibration: Calibration,
    imu_errors: ImuErrors,
    attitude: FloatArray,
    higher_order: HigherOrderErrors,
) -> FloatArray:
    """True minus estimated sensor errors, computed minus true attitude and velocity (..., k, size).

    `attitude` (k, 4) are true attitudes of the table's axes at the calibration's times.
    """
    model = calibration.model
    true, turn = imu_errors_in_frame(imu_errors, model.frame)
    errors = model.state(true, higher_order)[..., np.newaxis, :] - calibration.state
    true_attitude = attitude_of_axes(attitude, turn[..., np.newaxis, :, :])
    errors[..., :3] = attitude_error(calibration.attitude, true_attitude)
    errors[..., 3:6] = calibration.velocity
    return errors


@dataclass(frozen=True)
class TurntableTrial:
    """A calibration on a turntable: everything that it depends on but the random draws.

    Attributes
    ----------
    scheme : Scheme
        Pauses and rotations of the table.
    latitude : float
        Of the table, rad.
    frame : str
        Choice of body axes, one of `driftlab.body_frames.BODY_FRAMES`.
    states : tuple of str
        What the filter looks for besides: see `ErrorModel.with_states`.
    prior, noise : PriorStandardDeviations, ImuNoise
        Distributions of the sensor errors, of the initial attitude and of the noise: those of the
        simulation, and those that the filter assumes.
    assumed_noise : ImuNoise, optional
        Noise that the filter assumes, if it differs from `noise`: with no bias instability, say.
    sample_interval, update_interval : float
        Of the sensors and of the filter, s. An update takes an even number of samples, and pauses
        and rotations are extended to whole updates. If the table turns by more than 2 or 3 degrees
        in a sample, the computation's own error is a noticeable part of the errors that are sought.
    keep : int
        The history keeps every `keep`-th update, and the last.
    passes : int
        How often the filter goes through the record; each pass after the first is linearised about
        the result of the one before.

    See Also
    --------
    driftlab.calibration.calibrate : The filter on a record of your own.

    Examples
    --------
    True scale-factor error of a gyro and the one found in eleven minutes, in ppm:

    >>> trial = TurntableTrial(Scheme("+90X +90X +90Y +90Z"), update_interval=10.0)
    >>> found = trial.run(np.random.default_rng(1))
    >>> both = found.imu_errors, found.calibration.imu_errors
    >>> [round(1e6 * float(errors.gyro_error_matrix[0, 0])) for errors in both]
    [-130, -103]
    """

    scheme: Scheme = NINETEEN_POSITIONS
    latitude: float = float(np.radians(37.5))
    frame: str = "averaged"
    prior: PriorStandardDeviations = field(default_factory=PriorStandardDeviations)
    noise: ImuNoise = field(default_factory=ImuNoise)
    assumed_noise: ImuNoise | None = None
    sample_interval: float = 0.05
    update_interval: float = 1.0
    keep: int = 20
    passes: int = 1
    states: tuple[str, ...] = ()

    @property
    def model(self) -> ErrorModel:
        """The states of the filter."""
        return ERROR_MODELS[self.frame].with_states(*self.states)

    def __post_init__(self) -> None:
        keep(self, scheme=checked_scheme(self.scheme))
        checked_instance(self.prior, PriorStandardDeviations, "prior")
        checked_instance(self.noise, ImuNoise, "noise")
        assumed = "noise" if self.assumed_noise is None else "assumed_noise"
        checked_noise(getattr(self, assumed), assumed)
        keep(self, latitude=float(checked_latitude(finite_number(self.latitude, "latitude"))))
        one_of(self.frame, ERROR_MODELS, "frame")
        keep(
            self,
            states=some_of(self.states, TERMS, "states"),
            keep=whole_number(self.keep, "keep"),
            passes=whole_number(self.passes, "passes"),
            sample_interval=positive_number(self.sample_interval, "sample_interval"),
            update_interval=positive_number(self.update_interval, "update_interval"),
        )
        samples = self.update_interval / self.sample_interval
        if abs(samples / 2 - round(samples / 2)) > 1e-9 * samples:
            raise ValueError(
                "update_interval: expected an even number of samples, "
                f"got {samples:g} of {self.sample_interval!r} s."
            )

    def run(
        self,
        rng: np.random.Generator | int,
        runs: int | None = None,
        imu_errors: ImuErrors | None = None,
        higher_order: HigherOrderErrors | None = None,
    ) -> Trial:
        """Calibrate `runs` random units, or one given unit with new noise in each run.

        `imu_errors` are in the table's axes and drawn from `prior` if not given, as are those of
        `higher_order` that `states` names. An `UnobservableWarning` names what the scheme does not
        show.
        """
        source = checked_generator(rng)
        model = self.model
        _warn_if_unobservable(linearize_along(self.scheme, self.latitude, model))
        lead = () if runs is None else (whole_number(runs, "runs"),)
        if imu_errors is None:
            imu_errors = random_imu_errors(self.prior, source, *lead)
        imu_errors = checked_imu_errors(imu_errors)
        try:
            imu_errors = checked_imu_errors(imu_errors, *lead)
        except ValueError:
            raise ValueError(
                f"imu_errors, runs: expected leading axes that fit {runs!r} runs, got others."
            ) from None
        # Each run has noise of its own, also of one and the same unit.
        lead = imu_errors.gyro_bias.shape[:-1]
        samples = round(self.update_interval / self.sample_interval)
        true = turntable_trajectory(
            self.scheme, self.latitude, self.sample_interval, multiple_of=samples
        )
        higher_order = self._higher_order(higher_order, source, lead)
        measured = measure(
            true.increments, imu_errors, self.noise, source, higher_order=higher_order
        )
        updates = measured.angle.shape[-2] // samples
        reference = self.noise.reference_velocity * source.standard_normal((*lead, updates, 3))
        # The table tells its attitude with an error.
        tilt = from_rotation_vector(-self.prior.attitude * source.standard_normal((*lead, 3)))
        one_pass = partial(
            calibrate,
            measured,
            reference,
            latitude=self.latitude,
            start=multiply(tilt, true.attitude[0]),
            model=model,
            prior=self.prior,
            noise=self.noise if self.assumed_noise is None else self.assumed_noise,
            keep=self.keep,
            check=False,  # the truth is known here, and says more
        )
        calibration = one_pass()
        for _ in range(1, self.passes):
            calibration = one_pass(linearization_point=calibration)
        places = np.round(calibration.times / self.sample_interval).astype(int)
        known = NO_HIGHER_ORDER_ERRORS if higher_order is None else higher_order
        errors = _estimation_errors(calibration, imu_errors, true.attitude[places], known)
        return Trial(calibration, imu_errors, errors, known)

    def _higher_order(
        self, given: HigherOrderErrors | None, rng: np.random.Generator, lead: tuple[int, ...]
    ) -> HigherOrderErrors | None:
        """Errors of higher order that are given, or those that the filter looks for, drawn."""
        if given is not None:
            return checked_higher_order_errors(given)
        if not self.model.higher_order:
            return None
        sizes = _prior_standard_deviations(self.prior, self.model.higher_order)
        return _unpacked(sizes * rng.standard_normal((*lead, sizes.size)), self.model.higher_order)
