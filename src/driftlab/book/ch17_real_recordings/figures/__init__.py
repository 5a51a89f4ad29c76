"""The published figures of chapter 17, with their captions."""

from decimal import ROUND_UP, Decimal

import numpy as np
from scipy.constants import arcsecond, degree, hour

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


def _parked_car_caption(data: DataTable) -> str:
    means, two, carried = (experiments.spread(row) for row in data.restarts)
    longer = experiments.spread(data.longer[2])
    return (
        "A ring-laser unit on a car that stands, with engine and people on board. "
        f"{data.restarts.shape[1]} times {data.lengths[0]:g} s of one record, not switched off "
        "between: headings from means of the gyros have a standard deviation of "
        f"{np.degrees(means.deviation):.1f} degrees; with gravity seen in inertial space "
        f"{np.degrees(carried.deviation):.3f}, a range of {np.degrees(carried.reach):.2f}, and "
        "no stretch is lost. "
        f"{data.longer.shape[1]} times {data.lengths[1]:g} s: {np.degrees(longer.deviation):.3f}. "
        "Two velocities in place of all give "
        f"{np.degrees(two.deviation):.2f} for {data.lengths[0]:g} s. "
        f"Bars on the right are intervals of 95 %. {_credit('laser-gyro')}"
    )


def _five_units_caption(data: DataTable) -> str:
    with_it, without = data.shown(f"angle_left, {experiments.UNIT_NAMES[experiments.ODD]}")[1:3]
    return (
        "Does a published table follow from its data? By the authors' own rule for a rest it "
        "does: no entry of five gyro matrices is off by more than "
        f"{_up(data.largest_difference[:, 0])}. With unit {experiments.ODD + 1} the rule also "
        f"finds a rest of {data.pause[1] - data.pause[0]} samples in a hand that still settles; "
        f"without it what is left falls from {with_it:.2f} to {without:.2f} degrees, and the "
        f"matrix moves by {data.moved:.4f}: entry by entry up to {data.moved_in_deviations[0]:.1f} "
        f"standard deviations of the fit with that rest, and {data.moved_in_deviations[1]:.1f} of "
        "the fit without. "
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
        says.append(f"The cheap one walks by {walks[0]:.1f} degrees in the root of an hour.")
    if np.isfinite(bound := data.cheap_bounds[2] / (degree / hour)):
        says.append(
            f"A rest of {data.cheap_length:.0f} seconds only says that its bias instability is "
            f"below {bound:.0f} degrees per hour."
        )
    if data.dear_terms[0] > 0:
        says.append(
            "The dear one's line of slope −1 stands for an angle that is off by "
            f"{data.dear_terms[0] / arcsecond:.1f} arc seconds and does not add up. The rounding "
            f"of its pulses of {lines.PULSE / arcsecond:.2f} is "
            f"{lines.ROUNDING / arcsecond:.2f}; the car rocks by "
            f"{data.rocking / arcsecond:.1f}. Without that line the best fit misses a point by a "
            f"factor of {data.missed[0]:.1f}, with it by {data.missed[1]:.1f}."
        )
    if walks[1] > 0:
        says.append(
            f"Its line of slope −½, a walk by {walks[1]:.3f}, bounds the gyro from above and is no "
            f"finding about it: the same fit has {forward[0]:.3f} for the forward gyro beside it, "
            f"to which the headings of the car allow no more than {forward[1]:.4f}; a car that "
            "leans slowly draws such a line."
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
            "degrees (open marks). As a rotation they go round a circle and come back to "
            f"{data.shown('come_back'):.1f} degrees of where they began "
            "(filled): what stands across the axis adds up to nothing. What is left along the "
            f"axis is Larin's estimate, {', '.join(f'{x:.5f}' for x in data.estimate)}, from rest "
            "to rest. The publishers' sections are shorter and move it by up to "
            f"{_up(data.estimate - data.by_sections)}; from these Ferraris's diagonal "
            f"differs by at most {_up(data.by_sections - data.ferraris)}: the two "
            "share their cut. On the right, by how much each source may move an estimate; the "
            "heading at the end no sensor saw, and a standard deviation of "
            f"{data.shown('stop_standard_deviation'):.1f} degrees is assumed for it. "
            f"{_credit('ferraris-session')}"
        ),
        recordings=("ferraris-session",),
    ),
    FigureDefinition(
        "17-two-calibrations",
        experiments.two_calibrations,
        two_calibrations.draw,
        lambda data: (
            "One record of one unit, calibrated and published twice. Drawn are the sensitive axes "
            f"as published, errors {two_calibrations.MAGNIFIED} times too large. The gyro matrices "
            f"differ by up to {np.abs(np.diff(data.published_gyro, axis=0)).max():.4f}. A rotation "
            f"of the body axes by {np.degrees(np.linalg.norm(data.rotation)):.2f} degrees carries "
            "all of the first into the second, within "
            f"{np.abs(data.carried[0] - data.published_gyro[1]).max():.0e}: the two triads stand "
            "to each other the same way in both. On the right, what is left after each of "
            f"{len(data.move)} moves, fitted anew by IMU-TK's method; the gyro matrix comes "
            f"within {_up(data.gyro - data.published_gyro)} of the published one, its own "
            f"deviation being up to {data.deviation.max():.0e}. {_credit('xsens-mti')}"
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
