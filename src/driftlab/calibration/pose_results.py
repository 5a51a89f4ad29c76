"""What a calibration by poses found, and whether it agrees with the noise."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE
from driftlab.imu import ImuErrors


class Consistency(NamedTuple):
    """Do the residuals of one kind agree with the noise that the rests show?

    Attributes
    ----------
    chi_square : float
        Sum of the squared residuals, each weighted by the noise, and by the excess of the other
        kinds.
    freedom : float
        Number of residuals, less the share of the unknowns that they determine.
    lower, upper : float
        Bounds that `chi_square` keeps in 95 of 100 cases if noise is all there is; NaN where fewer
        than half a degree of freedom is left and nothing can be tested.
    excess : float
        Deviation that was added to that of the noise: of each component of a mean force (m/s^2), of
        the turn over a move (rad), of a mean rate (rad/s). Zero if none is missing.

    Examples
    --------
    >>> Consistency(120.0, 30.0, 16.8, 47.0, 0.004).holds
    False
    """

    chi_square: float
    freedom: float
    lower: float
    upper: float
    excess: float

    @property
    def holds(self) -> bool:
        """Whether noise alone explains the residuals.

        Returns
        -------
        bool
            True also where nothing can be tested.
        """
        return not (self.chi_square < self.lower or self.chi_square > self.upper)

    @property
    def why(self) -> str:
        """The test in a sentence.

        Returns
        -------
        str
        """
        if np.isnan(self.upper):
            return "No freedom is left to test them."
        text = (
            f"Chi-square {self.chi_square:.4g}, {self.lower:.4g} to {self.upper:.4g} expected of "
            f"noise with {self.freedom:.0f} degrees of freedom"
        )
        if self.excess:
            return f"{text}: not noise alone, {self.excess:.3g} were added to its deviation."
        if self.holds:
            return f"{text}: noise."
        return f"{text}: {'more' if self.chi_square > self.upper else 'less'} than noise."


@dataclass(frozen=True, eq=False)
class PoseCalibration:
    """Errors of a unit as its poses show them.

    Attributes
    ----------
    imu_errors : ImuErrors
        Estimates in the chosen body axes: measured = (I + K) true + bias.
    body_axes : str
        The choice, one of `POSE_AXES`.
    names : tuple of str
        Names of the 24 numbers, those of `driftlab.calibration.FULL`.
    covariance : ndarray, shape (24, 24)
        Of the numbers in that order. Those that the choice of axes sets to zero have none.
    deviations : ImuErrors
        Standard deviations of `imu_errors`.
    sensitivity, sensitivity_deviations : ndarray, shape (3, 3)
        What specific force adds to the gyros' bias, matrix G, rad/s for 1 m/s^2 in the same axes,
        and its deviations (those of the axes of the fit, which turn by less than a triad is bent);
        zero if it was not asked for.
    gravity : float
        That was assumed, m/s^2.
    force_residuals : ndarray, shape (n,)
        |force| - gravity at each rest, m/s^2.
    turn_residuals : ndarray, shape (m,)
        Angle between gravity as carried to the next rest and as found there, for each move but the
        closed ones; then the turns left over the closed paths; rad.
    rate_residuals : ndarray, shape (n, 3)
        Mean of the gyros at each rest less their bias, rad/s.
    consistency : dict of str to Consistency
        Do "rests", "moves" and "rates" agree with the noise of the rests?
    colour : tuple of float
        Variance of means over half a second as a multiple of what white noise would have: gyros,
        accelerometers; NaN if the noise was given.
    longest_move : float
        s.
    iterations : int
        How often the record was integrated.

    Examples
    --------
    See `calibrate_by_poses`.
    """

    imu_errors: ImuErrors
    body_axes: str
    names: tuple[str, ...]
    covariance: FloatArray
    deviations: ImuErrors
    sensitivity: FloatArray
    sensitivity_deviations: FloatArray
    gravity: float
    force_residuals: FloatArray
    turn_residuals: FloatArray
    rate_residuals: FloatArray
    consistency: dict[str, Consistency]
    colour: tuple[float, float]
    longest_move: float
    iterations: int

    @property
    def earth_turn(self) -> float:
        """The most that the Earth turned over a move, which is in `turn_residuals`.

        Returns
        -------
        float
            rad. The weights of the fit count it, as one rate of unknown direction.
        """
        return EARTH_RATE * self.longest_move

    @property
    def why(self) -> str:
        """What the residuals are, and whether the noise of the rests explains them.

        Returns
        -------
        str
        """
        sizes = [self.force_residuals, np.degrees(self.turn_residuals), self.rate_residuals]
        units = ("m/s^2", "degrees", "rad/s")
        words = ("Gravity at rest", "Gravity or attitude after a move", "Gyros at rest")
        sentences = []
        for word, unit, size, test in zip(
            words, units, sizes, self.consistency.values(), strict=True
        ):
            rms = np.sqrt(np.mean(size**2))
            sentences.append(f"{word}: residuals {rms:.3g} {unit} (rms). {test.why}")
        return "\n".join(
            [
                *sentences,
                f"The Earth turns by at most {np.degrees(self.earth_turn):.2g} degrees over a "
                "move; it is in the residuals, and noise as counted here has it in it.",
            ]
        )
