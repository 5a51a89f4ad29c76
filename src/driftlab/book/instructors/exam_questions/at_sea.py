"""Questions on Part IV: a gyrocompass that aligns at rest, and one under way."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator
from scipy.constants import hour, knot, minute

from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.gyrocompass.alignment import align, alignment_errors
from driftlab.gyrocompass.heading_error import speed_error
from driftlab.gyrocompass.levelling_loop import schuler_gains

from .question import Answer, Part, Question, plain, shown, two_of

PER_HOUR = float(np.radians(1) / hour)
COURSES = {"North-East": 45, "North-West": 315, "South-East": 135, "South-West": 225}
"""Degrees of a compass card, North to East."""


def at_rest(draw: Generator) -> Question:
    """Chapter 09: heading and latitude from three gyros, a drift, and how long to average."""
    latitude = np.radians(draw.integers(36, 64))
    heading = np.radians(draw.integers(20, 70) + 90 * draw.integers(-2, 2))
    drift = float(draw.choice([0.01, 0.02, 0.03, 0.04]) * draw.choice([-1, 1]))
    walk = float(draw.choice([0.003, 0.004, 0.005, 0.006]))
    wanted = float(draw.choice([0.08, 0.1, 0.12]))
    allowed = float(draw.choice([0.1, 0.15, 0.2, 0.25]))
    level = EARTH_RATE * np.cos(latitude)
    rates = np.array(
        [level * np.cos(heading), EARTH_RATE * np.sin(latitude), level * np.sin(heading)]
    )
    readings = (rates / PER_HOUR).round(2)
    found = align(readings, [0, 1, 0], rate_unit=PER_HOUR)
    # The right gyro's drift in North, Up, East.
    bias = drift * PER_HOUR * np.array([np.sin(heading), 0, np.cos(heading)])
    error = alignment_errors(found.heading, 0.0, found.latitude, bias, np.zeros(3)).heading
    level_found = float(np.hypot(readings[0], readings[2]))
    time = (walk / level_found / np.radians(wanted)) ** 2 * 60  # minutes
    say = ", ".join(plain(x) for x in readings)
    largest = level_found * np.radians(allowed) / abs(np.cos(found.heading))
    by_sine = np.degrees(drift * np.cos(heading) / readings[1])
    return Question(
        "A compass at rest",
        "09",
        "compute heading, pitch, roll and latitude from six sensor readings",
        8,
        "A level box rests somewhere north of the equator. Its gyros forward, up, right read "
        f"{say} degrees an hour in the mean. The heading is the angle about Up from North "
        "to the forward axis: 90° is West, −90° is East.",
        two_of(
            draw,
            Part(
                "Find the heading and the latitude, in degrees.",
                r"$\tan\Psi = \omega_{right}/\omega_{forward}$, with the quadrant from both "
                r"signs; $\tan\varphi = \omega_{up}/\sqrt{\omega_{forward}^2+\omega_{right}^2}$.",
                (
                    Answer("the heading", float(np.degrees(found.heading)), "degrees"),
                    Answer("the latitude", float(np.degrees(found.latitude)), "degrees"),
                ),
                ((1, "the heading, but for its quadrant"), (1, "its quadrant"), (2, "latitude")),
                ("The heading counted to the East, and said so: nothing off.",),
            ),
            Part(
                f"The right gyro reads {plain(drift)} degrees an hour too much. Which error, "
                "computed minus true, does that make in the heading, in degrees?",
                r"Only its part about East counts: $\Delta\Psi = d\cos\Psi/(U\cos\varphi)$.",
                (Answer("the error of the heading", float(np.degrees(error)), "degrees"),),
                ((1, r"the part about East, by $\cos\Psi$"), (2, r"over $U\cos\varphi$, sign")),
                (f"Sine of the latitude for cosine ({shown(by_sine)}): 2.",),
            ),
            Part(
                f"The angle random walk of the gyros is {walk} degrees per root hour. How many "
                "minutes must be averaged until its part in the heading, one standard deviation, "
                f"is {wanted}°?",
                r"$T = (N/(U\cos\varphi\,\sigma))^2$ with $\sigma$ in radians.",
                (Answer("the time", float(time), "minutes"),),
                ((2, r"$N$ over the root of the time, over $U\cos\varphi$"), (1, "the number")),
                (r"$\sigma$ left in degrees: 2. A mean over independent minutes, say so: 3.",),
            ),
            Part(
                f"A drift of the right gyro may make a heading error of {allowed}° at most. Which "
                "drift is allowed, in degrees an hour, by its size?",
                r"Its part about East, $d\cos\Psi$, over $U\cos\varphi$ is the error, in "
                "radians.",
                (Answer("the allowed drift", float(largest), "°/h"),),
                ((1, r"$U\cos\varphi$ times the error"), (1, r"over $\cos\Psi$"), (1, "number")),
                ("The error left in degrees: 2.",),
            ),
        ),
    )


def under_way(draw: Generator) -> Question:
    """Chapter 10: the speed error, a log that errs, and a swinging horizon."""
    degrees = int(draw.integers(38, 66))
    latitude = np.radians(degrees)
    course = list(COURSES)[int(draw.integers(len(COURSES)))]
    knots = int(draw.integers(12, 29))
    percent = float(draw.choice([1.0, 1.5, 2.0, 2.5, 3.0]))
    tilt = float(draw.choice([0.1, 0.15, 0.2, 0.25, 0.3]))
    card = np.radians(COURSES[course])
    velocity = knots * knot * np.array([np.cos(card), np.sin(card)])
    error = abs(float(speed_error(latitude, velocity)))
    simple = abs(velocity[0]) / (EARTH_RADIUS * EARTH_RATE * np.cos(latitude))
    side = "West" if velocity[0] > 0 else "East"
    wrong_log = abs(float(speed_error(latitude, (1 + percent / 100) * velocity))) - error
    due_north = abs(float(speed_error(latitude, np.array([knots * knot, 0.0]))))
    schuler = float(np.sqrt(gravity(latitude) * schuler_gains().integral))
    swing = tilt * schuler / (EARTH_RATE * np.cos(latitude))
    northward = shown(abs(velocity[0]))
    return Question(
        "A compass under way",
        "10",
        "derive the error of the compass at work",
        8,
        f"A ship at {degrees}° North makes {knots} knots (1 knot is {knot:.4f} m/s) to the "
        f"{course}. The Earth has the radius 6371 km and turns by 15.04° an hour; "
        f"$g = {shown(float(gravity(latitude)))}$ m/s².",
        two_of(
            draw,
            Part(
                "Where does the compass find its North, without a correction: how many degrees "
                "from true North, and on which side?",
                f"It finds the level part of the whole rate. The {northward} m/s along the "
                r"meridian turn the local axes by $v_N/R$; the part to East or West changes "
                r"$U\cos\varphi$ by $v_E/R$. Its North lies to the "
                f"{side}.",
                (Answer("the size of the speed error", np.degrees(error), "degrees"),),
                (
                    (1, "only the part of the velocity along the meridian turns North away"),
                    (2, r"$v_N/(R\,U\cos\varphi)$; leaving out $v_E$ there costs nothing"),
                    (1, f"the number, or {shown(np.degrees(simple))} without $v_E$, and the side"),
                ),
                (
                    f"The whole speed in place of its part ({shown(np.degrees(error) * 2**0.5)}, "
                    "about): 3.",
                ),
            ),
            Part(
                f"The error is taken off with a log that reads {percent} per cent too much. How "
                "large is the error that is left, in arc minutes?",
                "The correction is too large by the same part, and by a little more where $v_E$ "
                "is counted in the level rate.",
                (Answer("the error that is left", 60 * np.degrees(wrong_log), "arc minutes"),),
                (
                    (2, "what is taken off is wrong by the same per cent"),
                    (
                        1,
                        "the number, or the error times the per cent "
                        f"({shown(60 * np.degrees(error) * percent / 100)})",
                    ),
                ),
                ("The error that is left given with the opposite sense: nothing off.",),
            ),
            Part(
                "Back at the quay, the horizon of this compass still swings about East with an "
                f"amplitude of {tilt} arc minutes, undamped, tuned to Schuler's period. How many "
                "minutes does a swing last, and how large is the heading error at most, in arc "
                "minutes?",
                r"$2\pi\sqrt{R/g}$. The swing has the rate $\omega_s\chi$, which the compass "
                r"takes for a rate about East: over $U\cos\varphi$ it is a heading error.",
                (
                    Answer("the period", 2 * np.pi / schuler / minute, "minutes"),
                    Answer("the largest error of the heading", swing, "arc minutes"),
                ),
                ((1, "the period"), (2, "the rate of the swing over the level rate")),
                (
                    f"The tilt itself, or times the tangent of the latitude "
                    f"({shown(tilt * np.tan(latitude))}), as the heading error: 0 for the second.",
                ),
            ),
            Part(
                "The ship turns due North and keeps its speed. How large is the error then, in "
                "degrees, and which part of the velocity counted above and is gone now?",
                r"All of the speed is along the meridian: $v/(R\,U\cos\varphi)$. There is no "
                r"part to East or West that would change $U\cos\varphi$.",
                (Answer("the error due North", float(np.degrees(due_north)), "degrees"),),
                ((1, "all of the speed counts"), (1, "the number"), (1, r"$v_E$")),
                ("The error above kept, for the speed is the same: 0.",),
            ),
        ),
    )
