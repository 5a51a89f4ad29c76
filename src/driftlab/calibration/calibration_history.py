"""What a calibration on a turntable found, and whether its innovations are as large as it says.

If everything that the filter was told is true, its innovations, each divided by its deviation, are
independent normal numbers with mean zero and variance one. Then the sum of their squares (NIS) has
a chi-square distribution, and so has the square of their mean. The two tests see different slips.
Larger noise than told makes the squares too large. If the noise of the reference velocity was told
too large, the squares are too small, whatever else is wrong, and pass for good where a slip makes
up for it. The mean is not deceived: too large a noise makes it smaller, and a constant slip makes
it grow with the root of the time.
"""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np
from scipy.constants import arcsecond, degree, g, hour, micro
from scipy.special import chdtri, ndtri

from driftlab.checks import FloatArray, checked_instance
from driftlab.core import quaternion
from driftlab.core.loops import attitudes
from driftlab.earth import earth_rate
from driftlab.higher_order_errors import TERMS
from driftlab.imu import ImuErrors, PriorStandardDeviations
from driftlab.increments import Increments
from driftlab.strapdown import ALGORITHM

from ._filter_inputs import FilterInputs
from .error_model import ErrorModel

CONFIDENCE = 1 - 1e-4
"""Of each bound: so many right runs keep it."""
_KNOWN_NOISE = 1.25
"""No noise is known better; the squares may be so many times as large as their bound."""
_SECOND_ORDER = 2.0
"""Square of the largest scale or installation error over the least stated deviation, from which on
one pass is too few."""
_OF_SCALE = " scale | installation "
BEYOND = 6.0
"""Prior deviations that no error is expected to have: one of 10^7 right units has one of 21."""
_UNITS = {
    "gyro bias": (float(hour / degree), "deg/h"),
    "accelerometer bias": (1 / (micro * g), "µg"),
    "scale": (1e6, "ppm"),
    "installation": (float(1 / arcsecond), "arc seconds"),
    "non-orthogonality": (float(1 / arcsecond), "arc seconds"),
    **{term.states: (1.0, term.unit) for term in TERMS.values()},
}
"""In what errors are said, by a part of the names of their states."""


class Calibration(NamedTuple):
    """History of a calibration, at k of its updates.

    Attributes
    ----------
    model : ErrorModel
        The states.
    times : ndarray, shape (k,)
        Since the start, s.
    state : ndarray, shape (..., k, size)
        Estimated sensor errors in the order of ``model.names``, in the model's own body axes: gyro
        biases in rad/s and accelerometer biases in m/s^2, the constant part of each, entries of the
        matrices without unit (rad off the diagonal), states of `ErrorModel.with_states` in the SI
        units of `HigherOrderErrors`. Attitude and velocity errors (rad, m/s) are zero here, because
        they are fed back.
    covariance : ndarray, shape (..., k, size, size)
        Of the estimation errors, as the filter computes it: in the products of the units of two
        states, so (rad/s)^2 for the variance of a gyro bias.
    attitude : ndarray, shape (..., k, 4)
        Estimated attitude of the model's own axes, body to East, North, Up.
    velocity : ndarray, shape (..., k, 3)
        Estimated velocity, East, North, Up, m/s.
    nis : ndarray, shape (..., updates)
        Squared normalised innovations (NIS) of all updates. Their mean is near three if all that
        the filter was told is true. A mean near three proves nothing; see `innovation_test`.
    innovations : ndarray, shape (..., updates, 3)
        Innovations with covariance I, which `nis` are the sums of squares of.
    inputs : optional
        The arguments of `calibrate`, if it checked them, for `driftlab.diagnosis.diagnose`.
    """

    model: ErrorModel
    times: FloatArray
    state: FloatArray
    covariance: FloatArray
    attitude: FloatArray
    velocity: FloatArray
    nis: FloatArray
    innovations: FloatArray = np.zeros((0, 3))
    inputs: FilterInputs | None = None

    @property
    def standard_deviations(self) -> FloatArray:
        """Standard deviations (..., k, size) of the states, as the filter computes them."""
        return np.sqrt(np.einsum("...ii->...i", self.covariance))

    @property
    def imu_errors(self) -> ImuErrors:
        """Sensor errors (...) found at the end, in the model's own body axes; rad/s and m/s^2."""
        return self.model._imu_errors(self.state[..., -1, :])

    def _linearization_point(
        self, measured: Increments, latitude: float
    ) -> tuple[FloatArray, FloatArray]:
        """State (..., size) found, and the attitude (..., 4) found for the start."""
        state = self.state[..., -1, :]
        angle = self.model._corrected(measured, state).angle
        turned = attitudes(ALGORITHM, angle)[..., -1, :]
        # The attitude at the end is known best, and the corrected gyros lead back from it, in axes
        # that do not turn with the Earth: those of the beginning.
        at_end = quaternion.from_rotation_vector(self.times[-1] * earth_rate(latitude))
        return state, quaternion.multiply(
            quaternion.multiply(at_end, self.attitude[..., -1, :]), quaternion.conjugate(turned)
        )

    def _contradictions(self, inputs: FilterInputs) -> tuple[int, list[str]]:
        """The worst run (its number), and sentences on its innovations and large errors."""
        doubt = innovation_test(self)._contradiction()
        run, beyond = self._beyond_prior(inputs.prior, inputs.start)
        said = []
        if doubt is not None:
            run = doubt[0]
            said.append(doubt[1])
        if beyond:
            said.append(
                f"expected errors within {BEYOND:g} deviations of the prior, got "
                f"{'; '.join(beyond)}"
            )
        return run, said

    def _beyond_prior(
        self, prior: PriorStandardDeviations, start: FloatArray
    ) -> tuple[int, list[str]]:
        """The worst run (its number), and a sentence on each kind of error beyond the prior."""
        model = self.model
        known = np.sqrt(np.diag(model.covariance(prior, start.reshape(-1, 4)[0])))
        found = self.state[..., -1, :].reshape(-1, model.size)
        ratios = np.divide(np.abs(found), known, out=np.zeros_like(found), where=known > 0)
        ratios[:, :6] = 0.0
        run = int(np.argmax(ratios.max(axis=-1)))
        places = np.flatnonzero(ratios[run] > BEYOND)
        worst: dict[str, str] = {}
        for place in places[np.argsort(-ratios[run, places], kind="stable")]:
            name = model.names[place]
            size, unit = next(unit for part, unit in _UNITS.items() if part in name)
            worst.setdefault(
                name.rsplit(" ", 1)[0],
                f"{name}: found {size * found[run, place]:.3g} {unit} where the prior says "
                f"{size * known[place]:.3g}",
            )
        return run, list(worst.values())

    def _too_large(self) -> list[str]:
        """A sentence if scale or installation errors are too large for a first pass."""
        places = [k for k, name in enumerate(self.model.names) if re.search(_OF_SCALE, name)]
        errors = np.abs(self.state[..., -1, places]).max(axis=-1)
        known = self.standard_deviations[..., -1, places]
        largest = float(np.max(errors**2 / np.where(known > 0, known, np.inf).min(axis=-1)))
        if largest <= _SECOND_ORDER:
            return []
        return [
            "expected scale and installation errors whose squares are below "
            f"{_SECOND_ORDER:g} stated deviations, got {largest:.3g}: errors too large for first "
            "order, and deviations stated too small: go over the record again, with this result "
            "as linearization_point"
        ]


def checked_about(
    linearization_point: Calibration, model: ErrorModel, lead: tuple[int, ...]
) -> Calibration:
    """Return an earlier pass, refusing one of another model or of other runs."""
    checked_instance(linearization_point, Calibration, "linearization_point")
    if linearization_point.model is not model or linearization_point.state.shape[:-2] != lead:
        raise ValueError(
            f"linearization_point: expected runs {lead} with {_described(model)}, got "
            f"{linearization_point.state.shape[:-2]} with {_described(linearization_point.model)}."
        )
    return linearization_point


def _described(model: ErrorModel) -> str:
    """Words for a model: axes, size and what was added."""
    added = f", with {', '.join(model.higher_order)}" if model.higher_order else ""
    return f"the model {model.frame!r} of {model.size} states{added}"


class InconsistentCalibrationWarning(UserWarning):
    """Warning that a record contradicts what the filter was told of it."""


class InnovationTest(NamedTuple):
    """Two-sided test of innovations, for each run.

    Attributes
    ----------
    squares : ndarray, shape (...)
        Mean squared innovation (NIS), divided by three: one if all is as the filter was told.
    lower, upper : float
        Bounds that `squares` keeps in all but one of 10 000 right runs. `calibrate` warns from a
        quarter above the upper one on, because no noise is known better.
    mean : ndarray, shape (...)
        Squared mean of the innovations, times their number, divided by three: one, too.
    mean_upper : float
        Bound of `mean`.
    correlation : ndarray, shape (...)
        Between one innovation and the next: zero, too.
    correlation_bound : float
        Bound of its size.
    """

    squares: FloatArray
    lower: float
    upper: float
    mean: FloatArray
    mean_upper: float
    correlation: FloatArray
    correlation_bound: float

    @property
    def verdict(self) -> np.ndarray:
        """What it says of each run (...): "wrong", "too cautious" or "consistent"."""
        wrong = (self.squares > self.upper) | (self.mean > self.mean_upper)
        cautious = np.where(self.squares < self.lower, "too cautious", "consistent")
        return np.where(wrong, "wrong", cautious)

    def _contradiction(self) -> tuple[int, str] | None:
        """The worst run (its number) and a sentence on it; None if none is wrong."""
        squares = np.ravel(self.squares) / (_KNOWN_NOISE * self.upper)
        means = np.ravel(self.mean) / self.mean_upper
        worst = int(np.argmax(np.maximum(squares, means)))
        if squares[worst] > 1 and squares[worst] >= means[worst]:
            name, low, bound = "squared innovations (NIS / 3)", self.lower, self.upper
            size = np.ravel(self.squares)[worst]
        elif means[worst] > 1:
            name, low, bound = "squared mean of the innovations", 0.0, self.mean_upper
            size = np.ravel(self.mean)[worst]
        else:
            return None
        return worst, f"expected {name} from {low:.3g} to {bound:.3g}, got {size:.3g}"


def innovation_test(calibration: Calibration) -> InnovationTest:
    """Test whether a calibration's innovations are those that its filter expected.

    Parameters
    ----------
    calibration : Calibration
        As `calibrate` returns it.

    Returns
    -------
    InnovationTest
        Of each run. "consistent" says that nothing *of the innovations* speaks against the
        estimates: an interval wrong by 20 ppm is consistent, and gives errors of scale that are out
        by many stated deviations.

    Raises
    ------
    ValueError
        If the calibration has no innovations.

    See Also
    --------
    calibrate : The filter.
    nees : The test for simulations, where the errors are known.

    Notes
    -----
    The innovations of a filter whose model is exact are independent. This one is linearised anew at
    each update; yet over 720 simulated units, bent by 40 to 400 arc seconds, squares and means
    scattered as chi-square says.

    References
    ----------
    - Y. Bar-Shalom, X. R. Li, T. Kirubarajan, *Estimation with Applications to Tracking and
      Navigation*, Wiley, 2001, section 5.4.

    Examples
    --------
    >>> from driftlab.calibration import TurntableTrial
    >>> from driftlab.motion.scheme import Scheme
    >>> trial = TurntableTrial(Scheme("+90X +90X +90Y +90Z"), update_interval=10.0)
    >>> found = trial.run(np.random.default_rng(1), runs=3).calibration
    >>> innovation_test(found).verdict.tolist()
    ['consistent', 'consistent', 'consistent']
    """
    checked_instance(calibration, Calibration, "calibration")
    rows = calibration.innovations
    count = rows.shape[-2]
    if count == 0:
        raise ValueError("calibration: expected the innovations of some updates, got none.")
    tails = (1 - CONFIDENCE) / 2, (1 + CONFIDENCE) / 2
    upper, lower = (float(bound) for bound in chdtri(3 * count, tails) / (3 * count))
    squares = np.sum(rows**2, axis=(-2, -1))
    together = np.sum(rows[..., 1:, :] * rows[..., :-1, :], axis=(-2, -1))
    return InnovationTest(
        squares=squares / (3 * count),
        lower=lower,
        upper=upper,
        mean=np.sum(rows.sum(axis=-2) ** 2, axis=-1) / (3 * count),
        mean_upper=float(chdtri(3, 1 - CONFIDENCE)) / 3,
        correlation=np.divide(together, squares, out=np.zeros_like(squares), where=squares > 0),
        correlation_bound=float(ndtri(tails[1])) / np.sqrt(3 * count),
    )
