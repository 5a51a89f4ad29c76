"""``python -m driftlab integrate``: attitude over time from the gyros alone."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from driftlab.attitude.coning_algorithms import ALGORITHMS
from driftlab.attitude.integration import integrate
from driftlab.axes import convert_attitude
from driftlab.checks import FloatArray
from driftlab.conventions import mirror_heading
from driftlab.core.quaternion import conjugate, multiply
from driftlab.earth import EARTH_RATE
from driftlab.frames import from_euler_angles, to_euler_angles
from driftlab.quaternion import rotation_angle, to_rotation_vector
from driftlab.recordings.recording import Recording

from .findings import AXES, DEG_PER_HOUR, DEGREES, Findings, Plot, Step, Table
from .options import number
from .record import lines, moved_at, rates, record_plots

STEPS = 2
EXAMPLE = (
    "python -m driftlab example log.csv\n"
    "python -m driftlab integrate log.csv --gyro gx,gy,gz --units deg/s --time t,s"
    " --axes FRD --still 60 --closed --csv attitude.csv"
)
ROUNDING = 1e-12
ANGLES = ("heading", "pitch", "roll")


class Flight(NamedTuple):
    """An attitude over time; SI units."""

    times: FloatArray  # (n + 1,), the start included
    attitude: FloatArray  # (n + 1, 4)
    bias: FloatArray  # (3,), taken off
    left_over: int  # increments at the end, too few for a step


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add what this command alone wants to know."""
    parser.add_argument(
        "--algorithm",
        default="two-step-4",
        choices=sorted(ALGORITHMS),
        help="attitude algorithm of chapter 07 (default: two-step-4); one-step-3, two-step-3 and "
        "two-step-4 are reconstructed from the abstract of Perelyaev and Chelnokov; for a body "
        "that keeps turning fast take rotation-vector-2: in a steady turn two-step-4 has a "
        "systematic error, 4.5 deg/h at 400 deg/s and 50 Hz",
    )
    parser.add_argument(
        "--start",
        type=start_angles,
        default=(0.0, 0.0, 0.0),
        metavar="HEADING,PITCH,ROLL",
        help="attitude at the beginning, degrees; heading from North to East (default: 0,0,0)",
    )
    parser.add_argument(
        "--still",
        type=number,
        metavar="SECONDS",
        help="the unit lies still for so long at first: the mean rate of that time is a bias, "
        "which is taken off, and with it the Earth's rate",
    )
    parser.add_argument(
        "--closed",
        action="store_true",
        help="the log ends in the attitude in which it began: tell the closing error",
    )


def start_angles(text: str) -> tuple[float, ...]:
    """Three angles, degrees to radians."""
    angles = tuple(float(part) for part in text.split(","))
    if len(angles) != 3 or not np.isfinite(angles).all():
        raise argparse.ArgumentTypeError(f"expected three angles, got {text!r}")
    return tuple(np.radians(angles))


def find(recording: Recording, options: argparse.Namespace, step: Step) -> Findings:
    """Integrate a record, and see whether it closes."""
    step("integrate")
    flight = flown(recording, options.algorithm, options.start, options.still)
    euler = euler_angles(flight.attitude)
    tables, sentences = [_end_table(euler)], [*_sentences(flight, recording)]
    closing: dict[str, Any] = {}
    if options.closed:
        table, closing, words = _closing(flight)
        tables.append(table)
        sentences.append(words)
    step("plots")
    unwrapped = np.degrees(np.unwrap(euler, axis=0))
    plot = Plot("Attitude", "time, s", "deg", lines(flight.times, unwrapped, ANGLES))
    return Findings(
        "Attitude by integration",
        tuple(tables),
        tuple(sentences),
        plots=(*record_plots(recording), plot),
        values={
            "algorithm": options.algorithm,
            "attitude_order": "x, y, z, w; body FRD to local NED at the beginning",
            "end_attitude": flight.attitude[-1],
            "gyro_bias": flight.bias,
            "duration": flight.times[-1],
            **closing,
        },
        columns={
            "time_s": flight.times,
            **dict(zip(("qx", "qy", "qz", "qw"), flight.attitude.T, strict=True)),
            **{f"{name}_deg": np.degrees(x) for name, x in zip(ANGLES, euler.T, strict=True)},
        },
    )


def flown(
    recording: Recording,
    algorithm: str,
    start: tuple[float, ...] = (0.0, 0.0, 0.0),
    still: float | None = None,
) -> Flight:
    """Attitude, body FRD to local NED, from heading (to the East), pitch and roll at the start.

    Where the axes of the log are not known they are taken for FRD: first, second and third.
    """
    known = recording.in_axes("FRD") if recording.axes else recording
    bias = np.zeros(3)
    if still is not None:
        if not 0 < still < known.duration:
            raise ValueError(
                f"--still: expected a part of the log's {known.duration:g} s, got {still:g}."
            )
        rest = known.between(0.0, still)
        if (moment := moved_at(rest)) is not None:
            raise ValueError(
                f"--still: expected a time in which the unit lies still, got {still:g} s, and it "
                f"was moved at {moment:.6g} s."
            )
        bias = rates(rest).mean(axis=0)
    angles = known.angles() - bias * known.interval
    samples = getattr(ALGORITHMS[algorithm], "samples", 1)
    whole = len(angles) - len(angles) % samples
    first = attitude_of_angles(start)
    steps = integrate(angles[:whole], algorithm, start=first)
    attitude = np.concatenate([[first], steps])
    times = known.interval * samples * np.arange(len(attitude), dtype=float)
    return Flight(times, attitude, bias, len(angles) - whole)


def attitude_of_angles(angles: tuple[float, ...]) -> FloatArray:
    """Attitude (4,) of FRD in NED, from heading to the East, pitch and roll, rad."""
    heading, pitch, roll = angles
    book = from_euler_angles(mirror_heading(heading), pitch, roll)
    return convert_attitude(book, ("NUE", "NED"), ("FUR", "FRD"))


def euler_angles(attitude: FloatArray) -> FloatArray:
    """Heading to the East from 0 to 2 pi, pitch, roll (n, 3) of FRD in NED, rad."""
    book = to_euler_angles(convert_attitude(attitude, ("NED", "NUE"), ("FRD", "FUR")))
    heading = np.mod(mirror_heading(book.heading), 2 * np.pi)
    heading = np.where(2 * np.pi - heading < ROUNDING, 0.0, heading)  # of a little below North
    return np.stack([heading, book.pitch, book.roll], axis=-1) + 0.0


def _end_table(euler: FloatArray) -> Table:
    names = ("heading, from North to East", "pitch", "roll")
    rows = [
        (name, DEGREES.text(begin, digits=6), DEGREES.text(end, digits=6), "deg")
        for name, begin, end in zip(names, euler[0], euler[-1], strict=True)
    ]
    return Table("Attitude", ("", "at the beginning", "at the end", "unit"), tuple(rows))


def _sentences(flight: Flight, recording: Recording) -> Iterator[str]:
    yield (
        "Gyros feel turns against the stars: the attitude is one against inertial space, from "
        "local axes as they stood at the beginning. In this time the Earth turned by "
        f"{DEGREES.text(EARTH_RATE * flight.times[-1], digits=3)} degrees."
    )
    if flight.bias.any():
        shown = ", ".join(map(DEGREES.text, flight.bias))
        yield (
            f"Taken off as a bias, with the Earth's rate in it: {shown} deg/s. That is right for "
            "the attitude in which the unit lay."
        )
    if not recording.axes:
        yield (
            "The body axes were not told (--axes): heading, pitch and roll turn about the third, "
            "second and first axis of the log."
        )
    if flight.left_over:
        yield (
            "Increments left out at the end, too few for a step of the algorithm: "
            f"{flight.left_over}."
        )


def _closing(flight: Flight) -> tuple[Table, dict[str, Any], str]:
    """How far the end is from the beginning, as a rotation in body axes."""
    error = multiply(conjugate(flight.attitude[0]), flight.attitude[-1])
    vector, size = to_rotation_vector(error), float(rotation_angle(error))
    duration = flight.times[-1]
    rows = [
        (name, DEGREES.text(x), "deg", DEG_PER_HOUR.text(x / duration, digits=4), "deg/h")
        for name, x in zip((*AXES, "size"), (*vector, size), strict=True)
    ]
    table = Table("Closing error", ("", "angle", "unit", "over time", "unit"), tuple(rows))
    words = (
        f"The attitude at the end differs from that at the beginning by "
        f"{DEGREES.text(size, digits=4)} degrees, in body axes at the beginning. The Earth's"
        f" own part is at most {DEGREES.text(EARTH_RATE * duration, digits=3)} degrees."
    )
    return table, {"closing_error": vector, "closing_angle": size}, words
