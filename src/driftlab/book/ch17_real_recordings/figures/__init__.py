"""The published figures of chapter 17, with their captions."""

from decimal import ROUND_UP, Decimal

import numpy as np
from scipy.constants import arcsecond, degree, hour, milli

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.publish import FigureDefinition
from driftlab.checks import FloatArray
from driftlab.recordings.publishers import PUBLISHED

from .. import experiments
from ..experiments import allan_lines as lines
from . import allan_plots, five_units, hand_turns, parked_car, two_calibrations


def _credit(name: str) -> str:
    """Who made a recording, where it is from and under which licence, for the end of a caption."""
    one = PUBLISHED[name]
    return f"Recording: {one.source} ({one.licence})."


def _up(differences: FloatArray) -> str:
    """The largest of some differences to two digits, rounded up, so that none is larger."""
    largest = Decimal(float(np.abs(differences).max()))
    return f"{largest.quantize(Decimal(1).scaleb(largest.adjusted() - 1), ROUND_UP):.1e}"


def _hand_estimates_caption(data: DataTable) -> str:
    whole, cut, ferraris, with_bias = data.scale_error.T / milli
    return (
        "The scale-factor errors of three gyros from one turn by hand each, in four ways. From one "
        f"cut Larin and Ferraris differ by at most {np.abs(cut - ferraris).max():.3f} thousandths; "
        f"another cut moves an estimate by up to {np.abs(whole - cut).max():.2f}, the gyro bias "
        f"left in by up to {np.abs(whole - with_bias).max():.1f}. The bars are one standard "
        f"deviation, mostly of the assumed heading at the stop. {_credit('ferraris-session')}"
    )


def _parked_car_caption(data: DataTable) -> str:
    means, two, carried = (experiments.spread(row) for row in data.restarts)
    longer = experiments.spread(data.longer[2])
    return (
        "Headings of a parked car with engine and people on board, from a ring-laser unit that was "
        f"not switched off. {data.restarts.shape[1]} stretches of {data.lengths[0]:g} s: from "
        "means of the gyros they have a standard deviation of "
        f"{np.degrees(means.deviation):.1f} degrees; by inertial-frame alignment "
        f"{np.degrees(carried.deviation):.3f} and a range of {np.degrees(carried.reach):.2f} "
        f"degrees; from two velocities instead of all {np.degrees(two.deviation):.2f}. "
        f"{data.longer.shape[1]} stretches of {data.lengths[1]:g} s have "
        f"{np.degrees(longer.deviation):.3f}. Bars on the right are 95 % intervals. "
        f"{_credit('laser-gyro')}"
    )


def _five_units_caption(data: DataTable) -> str:
    with_it, without = data.shown(f"angle_left, {experiments.UNIT_NAMES[experiments.ODD]}")[1:3]
    return (
        "Does a published table follow from its data? By the authors' own rule for static "
        "intervals it does: no entry of five gyro matrices differs by more than "
        f"{_up(data.largest_difference[:, 0])}. For unit {experiments.ODD + 1} the rule also "
        f"finds an interval of {data.pause[1] - data.pause[0]} samples in a moving hand. Without "
        f"it the residual falls from {with_it:.2f} to {without:.2f} degrees, and the "
        f"matrix moves by {data.moved:.4f}: entry by entry up to {data.moved_in_deviations[0]:.1f} "
        f"standard deviations of the fit with it, {data.moved_in_deviations[1]:.1f} of the fit "
        "without. "
        f"{_credit(experiments.UNITS[0])}"
    )


def _allan_caption(data: DataTable) -> str:
    root_hour = np.sqrt(hour)
    walks = [np.degrees(terms[1]) * root_hour for terms in (data.cheap_terms, data.dear_terms)]
    forward = np.degrees(data.forward) * root_hour
    says = [
        "Allan deviation of two gyros at rest, with 68 % intervals and the noise terms that fit "
        "(dashes: upper bounds of those that are not seen)."
    ]
    if walks[0] > 0:
        says.append(f"The cheap one has an angle random walk of {walks[0]:.1f} °/√h.")
    if np.isfinite(bound := data.cheap_bounds[2] / (degree / hour)):
        says.append(
            f"{data.cheap_length:.0f} seconds only show that its bias instability is "
            f"below {bound:.0f} °/h."
        )
    if data.dear_terms[0] > 0:
        says.append(
            "The dear one's line of slope −1 is an angle error of "
            f"{data.dear_terms[0] / arcsecond:.1f} arc seconds that does not accumulate. The "
            f"rounding of its pulses of {lines.PULSE / arcsecond:.2f} is "
            f"{lines.ROUNDING / arcsecond:.2f}; the car rocks by "
            f"{data.rocking / arcsecond:.1f}. Without that line the best fit misses a point by a "
            f"factor of {data.missed[0]:.1f}, with it by {data.missed[1]:.1f}."
        )
    if walks[1] > 0:
        says.append(
            f"Its line of slope −½, {walks[1]:.3f} °/√h, is an upper bound for the gyro, not a "
            f"finding: the same fit gives {forward[0]:.3f} for the forward gyro, for which the "
            f"headings of the car allow at most {forward[1]:.4f}. A slowly tilting car draws such "
            "a line."
        )
    return f"{' '.join(says)} {_credit('mpu9150-1')} {_credit('laser-gyro')}"


FIGURES = (
    FigureDefinition(
        "17-hand-turns",
        experiments.hand_turns,
        hand_turns.draw,
        lambda data: (
            "A unit on a table, turned once about each axis by hand. Added up, the angles of the "
            f"two gyros across the axis reach {data.shown('added_up'):.1f} "
            "degrees (open marks). As rotations they go round a circle and come back within "
            f"{data.shown('come_back'):.1f} degrees (filled marks). The error along the axis is "
            "Larin's estimate of the scale-factor error, "
            f"{', '.join(f'{x:.5f}' for x in data.estimate)}, between static intervals. The "
            "publishers' shorter sections move it by up to "
            f"{_up(data.estimate - data.by_sections)}; the diagonal of Ferraris's method, from the "
            f"same sections, differs by at most {_up(data.by_sections - data.ferraris)}. On the "
            "right, the standard deviation that each source adds; no sensor measures the heading "
            f"at the stop, for which {data.shown('stop_standard_deviation'):.1f} degrees are "
            "assumed. "
            f"{_credit('ferraris-session')}"
        ),
        recordings=("ferraris-session",),
    ),
    FigureDefinition(
        "17-hand-estimates",
        experiments.hand_estimates,
        hand_turns.draw_estimates,
        _hand_estimates_caption,
        recordings=("ferraris-session",),
    ),
    FigureDefinition(
        "17-two-calibrations",
        experiments.two_calibrations,
        two_calibrations.draw,
        lambda data: (
            "One record of one unit, calibrated and published twice. Drawn are the input axes as "
            f"published, with errors {two_calibrations.MAGNIFIED} times too large. The gyro "
            f"matrices differ by up to {np.abs(np.diff(data.published_gyro, axis=0)).max():.4f}. A "
            f"rotation of the body axes by {np.degrees(np.linalg.norm(data.rotation)):.2f} degrees "
            "carries all of the first into the second, within "
            f"{np.abs(data.carried[0] - data.published_gyro[1]).max():.0e}: relative to each other "
            "the two triads are the same. On the right, the tilt error after each of "
            f"{len(data.move)} moves in our fit by IMU-TK's method; its gyro matrix is "
            f"within {_up(data.gyro - data.published_gyro)} of the published one, with standard "
            f"deviations up to {data.deviation.max():.0e}. {_credit('xsens-mti')}"
        ),
        recordings=("xsens-mti",),
    ),
    FigureDefinition(
        "17-five-units",
        experiments.five_units,
        five_units.draw,
        _five_units_caption,
        recordings=experiments.UNITS,
    ),
    FigureDefinition(
        "17-parked-car",
        experiments.parked_car,
        parked_car.draw,
        _parked_car_caption,
        recordings=("laser-gyro",),
    ),
    FigureDefinition(
        "17-allan-plots",
        lines.allan_lines,
        allan_plots.draw,
        _allan_caption,
        recordings=("mpu9150-1", "laser-gyro"),
    ),
)
