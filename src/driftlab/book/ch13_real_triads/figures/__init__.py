"""The published figures of chapter 13, with their captions."""

from decimal import ROUND_UP, Decimal

import numpy as np
from scipy.constants import arcsecond, degree, hour

from driftlab.book.machinery.arrays_table import from_columns
from driftlab.book.machinery.publish import FigureDefinition
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


def _parked_car_caption(data: experiments.ParkedCar) -> str:
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


def _allan_caption(data: lines.AllanLines) -> str:
    walks = [np.degrees(part.terms[1]) * np.sqrt(hour) for part in (data.cheap, data.dear)]
    forward = np.degrees(data.forward) * np.sqrt(hour)
    says = [
        "Allan deviation of two gyros at rest, with 68 % intervals and the noise terms that fit "
        "(dashes: upper bounds of those that are not seen)."
    ]
    if walks[0] > 0:
        says.append(f"The cheap one walks by {walks[0]:.1f} degrees in the root of an hour.")
    if np.isfinite(bound := data.cheap.bounds[2] / (degree / hour)):
        says.append(
            f"A rest of {data.cheap.length:.0f} seconds only says that its bias instability is "
            f"below {bound:.0f} degrees per hour."
        )
    if data.dear.terms[0] > 0:
        says.append(
            "The dear one's line of slope −1 stands for an angle that is off by "
            f"{data.dear.terms[0] / arcsecond:.1f} arc seconds and does not add up. The rounding "
            f"of its pulses is {lines.ROUNDING / arcsecond:.3f}; the car rocks by "
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
        "13-hand-turns",
        experiments.hand_turns,
        hand_turns.draw,
        hand_turns.columns,
        lambda data: (
            "A unit on a table, turned once about each axis by hand. Added up, the angles of the "
            f"two gyros across the axis reach {np.degrees(np.abs(data.added[:, -1])).max():.1f} "
            "degrees (open marks). As a rotation they go round a circle and come back to "
            f"{np.degrees(np.abs(data.path[:, -1])).max():.1f} degrees of where they began "
            "(filled): what stands across the axis adds up to nothing. What is left along the "
            f"axis is Larin's estimate, {', '.join(f'{x:.5f}' for x in data.estimate)}, from rest "
            "to rest. The publishers' sections are shorter and move it by up to "
            f"{_up(data.estimate - data.by_sections)}; from these Ferraris's diagonal "
            f"differs by at most {_up(data.by_sections - data.ferraris)}: the two "
            "share their cut. On the right, by how much each source may move an estimate; the "
            "heading at the end no sensor saw, and a standard deviation of "
            f"{np.degrees(data.stop_deviation):.1f} degrees is assumed for it. "
            f"{_credit('ferraris-session')}"
        ),
        from_columns(experiments.HandTurns),
        ("ferraris-session",),
    ),
    FigureDefinition(
        "13-two-calibrations",
        experiments.two_calibrations,
        two_calibrations.draw,
        two_calibrations.columns,
        lambda data: (
            "One record of one unit, calibrated and published twice. Drawn are the sensitive axes "
            f"as published, errors {two_calibrations.MAGNIFIED} times too large. The gyro matrices "
            f"differ by up to {np.abs(np.diff(data.published_gyro, axis=0)).max():.4f}. A rotation "
            f"of the body axes by {np.degrees(np.linalg.norm(data.rotation)):.2f} degrees carries "
            "all of the first into the second, within "
            f"{np.abs(data.carried[0] - data.published_gyro[1]).max():.0e}: the two triads stand "
            "to each other the same way in both. On the right, what is left after each of "
            f"{len(data.after)} moves, fitted anew by IMU-TK's method; the gyro matrix comes "
            f"within {_up(data.gyro - data.published_gyro)} of the published one, its own "
            f"deviation being up to {data.deviation.max():.0e}. {_credit('xsens-mti')}"
        ),
        from_columns(experiments.TwoCalibrations),
        ("xsens-mti",),
    ),
    FigureDefinition(
        "13-five-units",
        experiments.five_units,
        five_units.draw,
        five_units.columns,
        lambda data: (
            "Does a published table follow from its data? By the authors' own rule for a rest it "
            f"does: no entry of five gyro matrices is off by more than {_up(data.difference[0])}. "
            "With unit "
            f"{experiments.ODD + 1} the rule also finds a rest of "
            f"{data.pause[1] - data.pause[0]:.0f} samples in a hand that still settles; without it "
            f"what is left falls from {np.degrees(data.residual[1, experiments.ODD]):.2f} to "
            f"{np.degrees(data.residual[2, experiments.ODD]):.2f} degrees, and the matrix moves by "
            f"{data.moved.max():.4f}: entry by entry up to {data.moved_in_deviations[0]:.1f} "
            "standard deviations of the fit with that rest, and "
            f"{data.moved_in_deviations[1]:.1f} of the fit without. "
            f"{_credit(experiments.UNITS[0])}"
        ),
        from_columns(experiments.FiveUnits),
        experiments.UNITS,
    ),
    FigureDefinition(
        "13-parked-car",
        experiments.parked_car,
        parked_car.draw,
        parked_car.columns,
        _parked_car_caption,
        from_columns(experiments.ParkedCar),
        ("laser-gyro",),
    ),
    FigureDefinition(
        "13-allan-plots",
        lines.allan_lines,
        allan_plots.draw,
        allan_plots.columns,
        _allan_caption,
        allan_plots.restore,
        ("mpu9150-1", "laser-gyro"),
    ),
)
