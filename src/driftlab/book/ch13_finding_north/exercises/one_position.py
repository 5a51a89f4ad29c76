"""Exercises 13.1 to 13.5: what errors of the sensors do to an alignment."""

import numpy as np
from scipy.constants import degree, g, hour, milli
from scipy.optimize import brentq

from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.given_numbers import GivenNumbers
from driftlab.book.machinery.exercise.reading import slider
from driftlab.book.scenarios import SARATOV_LATITUDE as LATITUDE
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import align, alignment_errors
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import rotate
from driftlab.vectors import wrap_angle

RIGHT_DRIFT, RIGHT_OFFSET = 0.03 * degree / hour, 1.5 * milli * g


def _forward_gyro(
    latitude: float, drift: float, headings: tuple[float, ...] = (0.0, 90.0)
) -> FloatArray:
    """Heading errors in degrees of a level box whose forward gyro drifts by degrees an hour."""
    true = np.radians(headings)
    rate, force = static_imu(from_euler_angles(true, 0.0, 0.0), np.radians(latitude))
    found = align(rate + np.array([drift * degree / hour, 0.0, 0.0]), force).heading
    return np.degrees(wrap_angle(found - true))


def _at_west(drift: float, rate: float) -> FloatArray:
    """Heading errors in degrees if what tells North were `rate`."""
    return np.array([0.0, -drift / hour / rate])


def _some_place(rng: np.random.Generator) -> dict[str, float]:
    # Far from 45 degrees, so that the sine and the cosine of the latitude are told apart.
    return {"latitude": round(rng.uniform(54, 68), 1), "drift": round(rng.uniform(0.04, 0.12), 3)}


def _same_as_gyro(latitude_term: float = 1.0, sign: float = 1.0) -> float:
    """Pitch in degrees at which the right accelerometer does what the right gyro does, times sign.

    The term of the latitude counts with the factor `latitude_term`.
    """

    def error(pitch: float, gyro_bias: float, accelerometer_bias: float) -> FloatArray:
        parts = [0.0, 0.0, gyro_bias], [0.0, 0.0, accelerometer_bias]
        return alignment_errors(0.0, pitch, LATITUDE, *parts).heading_terms

    weights = np.array([1.0, 1.0, 1.0, latitude_term])
    wanted = sign * error(0.0, RIGHT_DRIFT, 0.0).sum()
    found = brentq(lambda pitch: weights @ error(pitch, 0.0, RIGHT_OFFSET) - wanted, -1.5, 1.5)
    return float(np.degrees(found))


CHAPTER_NAMES = {"phi": "varphi", "gravity": "g"}
"""What the symbols are called in the code of the chapter."""

BOX = ("Psi", "theta", "gamma", "varphi", "U", "g", "d_x", "d_y", "d_z", "a_x", "a_y", "a_z")


def _some_box(rng: np.random.Generator) -> tuple[float, ...]:
    angles = rng.uniform(-1.0, 1.0, 3)
    return (*angles, *rng.uniform(0.2, 1.2, 3), *rng.uniform(-1.0, 1.0, 6))


def _two_alignments(*box: float, stray: bool = False) -> FloatArray:
    """Heading errors (2,) at Psi and half a turn from it; `stray`: with the copy's factor."""
    heading, pitch, roll, latitude, earth, pull, *sensors = box
    headings = heading + np.array([0.0, np.pi])
    attitude = from_euler_angles(headings, pitch, roll)
    gyro_bias, accelerometer_bias = (
        np.array(sensors[:3]) * EARTH_RATE / earth,
        np.array(sensors[3:]) * g / pull,
    )
    terms = alignment_errors(
        headings,
        pitch,
        latitude,
        rotate(attitude, gyro_bias),
        rotate(attitude, accelerometer_bias),
        g,
    ).heading_terms
    if stray:
        terms[:, 2] *= np.tan(latitude)
    return terms.sum(axis=-1)


def _level_right(*box: float) -> float:
    """Offset along the level line to the right of the bow, as an angle."""
    _, _, roll, _, _, pull, *sensors = box
    return (sensors[5] * np.cos(roll) + sensors[4] * np.sin(roll)) / pull


def _other_side(*box: float) -> float:
    _, pitch, roll, _, _, pull, *sensors = box
    return np.tan(pitch) * (sensors[5] * np.cos(roll) - sensors[4] * np.sin(roll)) / pull


COMPASS = ("Psi", "varphi", "U", "g", "d_x", "d_z", "a_x", "a_z", "delta")


def _some_compass(rng: np.random.Generator) -> tuple[float, ...]:
    return (rng.uniform(0.3, 1.2), *rng.uniform(0.3, 1.2, 3), *rng.uniform(-1.0, 1.0, 5))


def _without_forward(
    *compass: float, tilt: float = 1.0, chart: float = 1.0, pull: float = 0.0
) -> float:
    """Heading error of a level box without its forward gyro.

    The parts of the accelerometer and of the latitude count with factors; `pull` replaces g.
    """
    heading, place, earth, gravity, _, gyro_bias, _, accelerometer_bias, delta = compass
    gyro = gyro_bias / (earth * np.cos(place))
    leaning = -np.tan(place) * accelerometer_bias / (pull or gravity)
    known = np.sin(heading) * np.tan(place) * delta
    return (gyro + tilt * leaning + chart * known) / np.cos(heading)


def _without_right(*compass: float) -> float:
    """Heading error of a level box without its right gyro."""
    heading, place, earth, gravity, gyro_bias, _, accelerometer_bias, _, delta = compass
    seen = gyro_bias / (earth * np.cos(place)) - np.tan(place) * accelerometer_bias / gravity
    return -(seen + np.cos(heading) * np.tan(place) * delta) / np.sin(heading)


EXERCISES: dict[str, Exercise] = {
    "13.1": Value(
        kind="predict",
        given=GivenNumbers(
            book={"latitude": 51.5, "drift": 0.05},
            draw=_some_place,
            units={"latitude": "degrees", "drift": "degrees an hour"},
        ),
        right=_forward_gyro,
        unit="degrees",
        absolute=0.01,
        mistakes={
            "Headings are counted about Up, from North to West: which way does the forward gyro of "
            "a box point that is turned by 90 degrees, to East or away from it?": (
                lambda **box: -_forward_gyro(**box)
            ),
            "That is the other way round: a drift about North does nothing to the heading.": (
                lambda **box: _forward_gyro(**box, headings=(90.0, 0.0))
            ),
            "So it would be with the heading counted to East and the forward gyro taken for the "
            "right one.": lambda **box: -_forward_gyro(**box, headings=(90.0, 0.0)),
            "The sine of the latitude gives the part of the Earth's rate about Up; North is told "
            "by the level part.": lambda latitude, drift: _at_west(
                drift, EARTH_RATE * np.sin(np.radians(latitude))
            ),
            "Not the whole rate of the Earth tells where North is, only its level part.": (
                lambda latitude, drift: _at_west(drift, EARTH_RATE)
            ),
        },
        remark="A drift about North goes into the latitude, one about East into the heading.",
    ),
    "13.2": Choice(
        kind="explain",
        right="abd",
        wrong={
            "c": "would be so if the roll error were an error of the attitude. The attitude as a "
            "whole is found equally well at every pitch; the heading undoes what the roll does too "
            "much.",
            "e": "confuses the axes in which the offset is given. One that is fixed in the body "
            "turns with it: of the forward accelerometer's only the level part counts.",
        },
        remark="What looks like a property of the instrument is one of the three angles.",
    ),
    "13.3": Formula(
        kind="compute",
        arguments=BOX,
        aliases=CHAPTER_NAMES,
        draw=_some_box,
        right=lambda *box: _two_alignments(*box).mean(),
        mistakes={
            "That all of it cancels is true of a level box. In one that leans, an offset and the "
            "cosine of the heading change their signs together.": lambda *box: 0.0,
            "Here is the paper's factor of the latitude in the third term, which does not belong "
            "there.": lambda *box: _two_alignments(*box, stray=True).mean(),
            "That is the error of the first alignment alone.": lambda *box: _two_alignments(*box)[
                0
            ],
            "The roll brings the upper accelerometer into the level plane too.": (
                lambda *box: np.tan(box[1]) * box[-1] / box[5]
            ),
            "Look at the sign with which a positive roll brings the upper axis to the right.": (
                _other_side
            ),
            "An offset is an acceleration; it becomes an angle when it is divided by g.": (
                lambda *box: np.tan(box[1]) * _level_right(*box) * box[5]
            ),
            "That is the error of the roll. The heading has the sine of the pitch times as much, "
            "with the other sign.": lambda *box: -_level_right(*box) / np.cos(box[1]),
        },
        remark="It is the roll error, and that is the same before and after the half turn.",
    ),
    "13.4": Value(
        kind="slide",
        right=_same_as_gyro,
        unit="degrees",
        absolute=1.0,
        from_panel=slider(
            "pitch",
            "At last only the right accelerometer errs, by 1.5 mg; heading and roll are zero.",
            **dict.fromkeys(("gyro_forward", "gyro_up", "gyro_right"), 0.0),
            **{"acc_forward": 0.0, "acc_up": 0.0, "acc_right": 1.5},
            **{"heading": 0.0, "roll": 0.0, "latitude": 51.5},
        ),
        mistakes={
            "As much, but with the other sign: the bow must be raised, not lowered.": (
                lambda: _same_as_gyro(sign=-1.0)
            ),
            "The term of the latitude is at work as well, and takes away from that of the pitch.": (
                lambda: _same_as_gyro(latitude_term=0.0)
            ),
            "So it would be if the terms of pitch and latitude helped each other; their signs are "
            "opposite.": lambda: _same_as_gyro(latitude_term=-1.0),
        },
        remark="Below the latitude as a pitch the offset turns the heading the other way.",
    ),
    "13.5": Formula(
        kind="compute",
        arguments=COMPASS,
        aliases=CHAPTER_NAMES,
        draw=_some_compass,
        right=_without_forward,
        mistakes={
            "That is the alignment without the right gyro. Near North the cosine of the heading "
            "hardly changes, so the forward gyro tells least.": _without_right,
            "That is the error of the full alignment, which holds here at heading zero only.": (
                lambda *compass: _without_forward(*compass, chart=0.0) * np.cos(compass[0])
            ),
            "A wrong latitude makes a wrong level rate, with which the reading is compared.": (
                lambda *compass: _without_forward(*compass, chart=0.0)
            ),
            "The accelerometers still say where the level plane is, and the upper gyro feels what "
            "they say wrongly.": lambda *compass: _without_forward(*compass, tilt=0.0),
            "Look at the sign of the roll error: a positive offset to the right makes the roll too "
            "small.": lambda *compass: _without_forward(*compass, tilt=-1.0),
            "Look at the sign of the latitude's part: farther North the level rate is smaller.": (
                lambda *compass: _without_forward(*compass, chart=-1.0)
            ),
            "An offset is an acceleration; it becomes an angle when it is divided by g.": (
                lambda *compass: _without_forward(*compass, pull=1.0)
            ),
        },
        remark="At heading zero it is the full alignment's.",
    ),
}
