"""What a rotation scheme is to be good at, and what the table can do: the task of a scheme design.

The criteria are those of optimal plans of experiments: V. V. Fedorov, *Theory of Optimal
Experiments*, Academic Press, 1972.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import (
    USUAL_TABLE,
    FloatArray,
    checked_generator,
    checked_instance,
    finite_array,
    finite_number,
    keep,
    one_of,
    positive_number,
    shown,
    table_rate,
    truth_value,
    whole_number,
)
from driftlab.earth import checked_latitude
from driftlab.imu import ImuNoise, PriorDeviations
from driftlab.motion.scheme import Scheme

from ._row_covariances import RowCovariances, row_covariances
from ._table_moves import TableMoves
from .error_model import ERROR_MODELS, ErrorModel
from .linearization import checked_model

CRITERIA = ("worst", "mean", "volume")
"""What a design can make small: see `DesignTask`."""


@dataclass(frozen=True)
class DesignTask:
    """What a rotation scheme is to be good at, and what the table can do.

    Attributes
    ----------
    criterion : str
        "worst": the largest deviation of a sensor error at the end, over its requirement. "mean":
        the root of the mean square of these ratios; schemes that make it least are A-optimal.
        "volume": the geometric mean of the half axes of the error ellipsoid, each sensor error
        counted in its requirement; schemes that make it least are D-optimal.
    requirement : tuple of float, optional
        Deviation of each sensor error that counts as one; those before the calibration, in the
        table's axes, if not given. An error that is known before does not count.
    positions : int
        Number of pauses, at least 2.
    duration : float
        Of the whole scheme, s. The pauses are equal and share what the turns leave.
    angles : tuple of int
        Angles of the turns, degrees: of 90, 180, 270, 360.
    two_axes : bool
        Whether the table has two axes: the outer one is level and stays where it is, East or
        North; the inner one is an axis of the body, across the outer one. Otherwise it has three
        that move together, and turns about any axis of the body.
    latitude : float
        Of the table, rad; not a pole.
    model : ErrorModel
        The states.
    noise, prior : ImuNoise, PriorDeviations
        Noise of the sensors and of the reference velocity, and deviations before.
    rate : float
        Of the turns, rad/s.

    Examples
    --------
    The nineteen positions leave one sensor error known to a twenty-eighth of what it was:

    >>> from driftlab.motion.scheme import NINETEEN_POSITIONS
    >>> round(1 / DesignTask().value(NINETEEN_POSITIONS))
    28
    """

    criterion: str = "worst"
    requirement: tuple[float, ...] | None = None
    positions: int = 19
    duration: float = 2442.0
    angles: tuple[int, ...] = (90, 180)
    two_axes: bool = True
    latitude: float = float(np.radians(37.5))
    model: ErrorModel = ERROR_MODELS["averaged"]
    noise: ImuNoise = field(default_factory=ImuNoise)
    prior: PriorDeviations = field(default_factory=PriorDeviations)
    rate: float = float(np.radians(10.0))

    def __post_init__(self) -> None:
        one_of(self.criterion, CRITERIA, "criterion")
        keep(self, model=checked_model(self.model))
        checked_instance(self.noise, ImuNoise, "noise")
        checked_instance(self.prior, PriorDeviations, "prior")
        if not self.noise.reference_velocity > 0:
            raise ValueError(
                "noise: expected a deviation of the reference velocity above 0, got 0.0 m/s."
            )
        keep(
            self,
            latitude=float(checked_latitude(finite_number(self.latitude, "latitude"))),
            two_axes=truth_value(self.two_axes, "two_axes"),
            rate=table_rate(positive_number(self.rate, "rate"), "rate", USUAL_TABLE),
            positions=whole_number(self.positions, "positions", 2),
            duration=positive_number(self.duration, "duration"),
        )
        turns = self.positions - 1
        angles = self.angles if isinstance(self.angles, tuple | list) else ()
        if not angles or not all(np.isscalar(a) and a in (90, 180, 270, 360) for a in angles):
            raise ValueError(
                f"angles: expected some of 90, 180, 270, 360, got {shown(self.angles)}."
            )
        keep(self, angles=tuple(dict.fromkeys(map(int, angles))))
        turning = turns * np.radians(max(angles)) / self.rate
        if self.duration < turning + self.positions:
            raise ValueError(
                f"duration: expected more than {turning + self.positions:g} s, the largest turns "
                f"and pauses of a second, got {shown(self.duration)}."
            )
        if self.requirement is not None:
            sizes = finite_array(self.requirement, "requirement", self.model.size - 6)
            if sizes.ndim != 1 or not (sizes > 0).all():
                raise ValueError("requirement: expected positive deviations, got others.")
            keep(self, requirement=tuple(sizes.tolist()))
        if len(self._unknown) == 0:
            raise ValueError("prior: expected some sensor error that is unknown, got none.")

    def values(self, covariance: FloatArray) -> FloatArray:
        """Criterion of covariances at the end of a scheme.

        Parameters
        ----------
        covariance : ndarray, shape (..., size, size)
            As from `covariance_analysis`.

        Returns
        -------
        ndarray, shape (...)
            Without unit; less is better.

        Raises
        ------
        ValueError
            If the covariance has another shape.

        Examples
        --------
        If all is known twice as well as it has to be, each criterion is one half:

        >>> for criterion in CRITERIA:
        ...     task = DesignTask(criterion, requirement=(2.0,) * 21)
        ...     print(round(float(task.values(np.eye(27))), 6))
        0.5
        0.5
        0.5
        """
        given = finite_array(covariance, "covariance", self.model.size, self.model.size)
        chosen, sizes = 6 + self._unknown, self._sizes[self._unknown]
        scaled = given[..., chosen[:, np.newaxis], chosen] / np.outer(sizes, sizes)
        if self.criterion == "volume":
            logarithm = np.linalg.slogdet(scaled)[1]
            return np.asarray(np.exp(logarithm / (2 * scaled.shape[-1])))
        squares = np.einsum("...ii->...i", scaled)
        summed = squares.max(-1) if self.criterion == "worst" else squares.mean(-1)
        return np.asarray(np.sqrt(summed))

    def value(self, scheme: Scheme) -> float:
        """Criterion of one scheme, its pauses set to fill the duration.

        Parameters
        ----------
        scheme : Scheme
            Of any number of turns by the angles of the task; its `dwell` and `rate` do not count.

        Returns
        -------
        float
            Without unit; less is better.

        Raises
        ------
        ValueError
            If the scheme has other turns, or takes too long.

        Examples
        --------
        >>> from driftlab.motion.scheme import EIGHTEEN_ROTATIONS
        >>> task = DesignTask("mean")
        >>> round(task.value(EIGHTEEN_ROTATIONS), 4)
        0.0244
        """
        rows = self._rows
        return float(self.values(rows.after([rows.row(scheme)]))[0])

    def random_schemes(self, rng: np.random.Generator | int, count: int) -> list[Scheme]:
        """Draw random schemes that the table can do.

        Parameters
        ----------
        rng : numpy.random.Generator or int
            Source of the random draws.
        count : int
            How many.

        Returns
        -------
        list of Scheme
            Each as long as the task says.

        Examples
        --------
        >>> one = DesignTask(positions=4).random_schemes(np.random.default_rng(1), 5)[0]
        >>> one.positions
        4
        """
        rows = self._rows
        drawn = rows.moves.drawn(
            checked_generator(rng),
            whole_number(count, "count"),
            self.positions - 1,
            self.two_axes,
        )
        return [rows.scheme(start, row) for start, row in zip(*drawn, strict=True)]

    @property
    def _rows(self) -> RowCovariances:
        """Rows of turns that the task allows, with what they show."""
        return row_covariances(
            moves=TableMoves(self.angles), duration=self.duration, rate=self.rate,
            latitude=self.latitude, model=self.model, noise=self.noise, prior=self.prior,
        )  # fmt: skip

    @cached_property
    def _sizes(self) -> FloatArray:
        return self._before if self.requirement is None else np.array(self.requirement)

    @cached_property
    def _before(self) -> FloatArray:
        level = self.model.covariance(self.prior, [0.0, 0.0, 0.0, 1.0])
        return np.sqrt(np.diag(level))[6:]

    @cached_property
    def _unknown(self) -> NDArray[np.int_]:
        """Places of the sensor errors that count: what is known before needs no scheme."""
        return np.flatnonzero(self._before)
