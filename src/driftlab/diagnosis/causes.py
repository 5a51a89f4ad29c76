"""What may have gone wrong in a calibration on a turntable: likely slips, noise, a second pass."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from driftlab.calibration._told import Told, told_noise
from driftlab.calibration.calibration_history import Calibration
from driftlab.calibration.filter import LARGE_BIAS, TAKE_THE_MEAN, FilterFailure
from driftlab.checks import shown

from .slips import _Judge, _likely_slips

_NONE_KNOWN = "no slip is known that explains it"


class Diagnosis(NamedTuple):
    """What contradicts a calibration's arguments, and what may explain it; prints as sentences.

    Attributes
    ----------
    contradictions : tuple of str
        What was expected and what came instead; none if nothing contradicts the arguments.
    noise : tuple of str
        How the noise of the sensors differs from the one assumed: this is certain.
    slips : tuple of str
        Mistakes without any one of which the record fits, likely ones first.
    advice : str
        What to do if neither explains it.

    Examples
    --------
    >>> print(Diagnosis(("expected A, got B",), (), ("start: scalar first", "axes: swapped"), ""))
    expected A, got B: start: scalar first; or axes: swapped?
    """

    contradictions: tuple[str, ...]
    noise: tuple[str, ...] = ()
    slips: tuple[str, ...] = ()
    advice: str = ""

    def __str__(self) -> str:
        if not self.contradictions:
            return "Nothing contradicts what the filter was told."
        said = ". Besides, ".join(self.contradictions)
        causes = [*self.noise, *(["; or ".join(self.slips)] if self.slips else [])]
        if causes:
            return f"{said}: {'; and '.join(causes)}?"
        return f"{said}; {self.advice}." if self.advice else f"{said}."


def diagnose(found: Calibration | FilterFailure) -> Diagnosis:
    """Look for what explains a calibration that contradicts its arguments.

    Parameters
    ----------
    found : Calibration or FilterFailure
        What `driftlab.calibration.calibrate` returned, or the error it raised.

    Returns
    -------
    Diagnosis
        Of the run that is contradicted most.

    Raises
    ------
    ValueError
        If `found` does not have the arguments of the filter, as in a simulated trial.

    See Also
    --------
    driftlab.calibration.calibrate : The filter, which warns of contradictions.
    driftlab.calibration.innovation_test : Whether there are any.

    Notes
    -----
    Other units, orders and signs of axes, starts, latitudes and intervals are compared with gravity
    and the Earth's rate, which is fast. The few that fit go through the filter again, so this may
    take several times as long as the calibration. A mistake is named if nothing contradicts the
    record without it.

    Examples
    --------
    Rates in rad/s, where the filter expects increments in rad:

    >>> import warnings
    >>> from driftlab.calibration import calibrate
    >>> from driftlab.imu import TYPICAL_ERRORS, ImuNoise, PriorDeviations
    >>> from driftlab.increments import measure
    >>> from driftlab.motion import Scheme, table_trajectory
    >>> true = table_trajectory(Scheme("+90Y +90Z", dwell=60.0), latitude=0.7, interval=0.5)
    >>> log = measure(true.increments, TYPICAL_ERRORS)
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("ignore")
    ...     found = calibrate(
    ...         log._replace(angle=log.mean_rate), latitude=0.7, start=true.attitude[0],
    ...         model="averaged", prior=PriorDeviations(), noise=ImuNoise(),
    ...     )
    >>> diagnose(found).slips
    ('gyros: rates taken for increments',)
    """
    told = getattr(found, "told", None)
    if not isinstance(told, Told):
        raise ValueError(
            "found: expected what calibrate returned or the error it raised, with its arguments, "
            f"got {shown(found)}."
        )
    if (seen := told.impossible()) is not None:
        one = told.run(seen[0])
        slips = _likely_slips(_Judge(one))
        return _explained(seen[1:], [] if slips else told_noise(one)[0], slips, one)
    if not isinstance(found, Calibration):
        return Diagnosis((str(found).rstrip("."),), advice=TAKE_THE_MEAN)
    run, said = found._contradictions(told)
    one = told.run(run)
    noise, right = told_noise(one)
    slips = []
    if said:
        judge = _Judge(one._replace(noise=right))
        # With the noise that it has, the record may be right.
        if not noise or judge.steps is not None:
            slips = _likely_slips(judge)
    elif noise:
        said = ["expected noise as assumed, got another"]
    more = found._too_large() if told.first and not slips and not noise else []
    if more and not said:
        return Diagnosis(tuple(more))
    return _explained([*said, *more], noise, slips, one)


def _explained(said: Sequence[str], noise: list[str], slips: list[str], told: Told) -> Diagnosis:
    """A diagnosis, with advice if nothing explains what is said."""
    advice = ""
    if said and not (noise or slips):
        advice = f"{_NONE_KNOWN}. "
        if told.prior.gyro_bias > LARGE_BIAS:
            advice += TAKE_THE_MEAN
        else:
            advice += (
                "Are the errors larger than the prior says? Then a larger prior, and a second pass "
                "about this result"
            )
    plain = [tuple(part.rstrip(".?") for part in parts) for parts in (said, noise, slips)]
    return Diagnosis(plain[0], plain[1], plain[2], advice)
