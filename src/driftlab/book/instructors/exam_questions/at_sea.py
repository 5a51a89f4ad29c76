"""Questions on Part IV: a gyrocompass that aligns at rest, and one under way."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator
from scipy.constants import hour, knot, minute

from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.gyrocompass.alignment import align, alignment_errors
from driftlab.gyrocompass.heading_error import speed_error
from driftlab.gyrocompass.levelling_loop import schuler_gains

from .question import Question, plain, question, shown

PER_HOUR = float(np.radians(1) / hour)
COURSES = {"North-East": 45, "North-West": 315, "South-East": 135, "South-West": 225}
"""Degrees of a compass card, North to East."""


def at_rest(draw: Generator) -> Question:
    """Chapter 13: heading and latitude from three gyros, a drift, and how long to average."""
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
    # No reading is so small that it is lost among the digits of the others.
    turn = next(
        each
        for each in draw.permutation([25, 40, 65, 115])
        if abs(np.sin(2 * (heading + np.radians(each)))) > 0.3
    )
    # The right gyro's drift in North, Up, East.
    bias = drift * PER_HOUR * np.array([np.sin(heading), 0, np.cos(heading)])
    error = alignment_errors(found.heading, 0.0, found.latitude, bias, np.zeros(3)).heading
    level_found = float(np.hypot(readings[0], readings[2]))
    forward, right = level_found * np.array(
        [np.cos(found.heading + np.radians(turn)), np.sin(found.heading + np.radians(turn))]
    )
    by_cosine = float(np.degrees(np.arccos(level_found / (EARTH_RATE / PER_HOUR))))
    time = (walk / level_found / np.radians(wanted)) ** 2 * 60  # minutes
    largest = level_found * np.radians(allowed) / abs(np.cos(found.heading))
    by_sine = np.degrees(drift * np.cos(heading) / readings[1])
    degrees, north = np.degrees([found.heading, found.latitude])
    return question(
        draw,
        rf"""
        13, 8 minutes: A compass at rest
        compute heading, pitch, roll and latitude from six sensor readings

        A level box is at rest somewhere north of the equator. Its gyros, which point forward, up
        and to the right, read {", ".join(plain(x) for x in readings)} degrees per hour on average.
        The heading is the angle about Up from North to the forward axis: 90° is West, −90° is East.

        (a) Find the heading and the latitude, in degrees.
        = $\tan\Psi = \omega_{{right}}/\omega_{{forward}}$, with the quadrant from both signs;
        $\tan\varphi = \omega_{{up}}/\sqrt{{\omega_{{forward}}^2+\omega_{{right}}^2}}$.
        1: the heading, apart from its quadrant; 1: its quadrant; 2: the latitude
        - The heading counted towards East, and this is stated: nothing lost.
        > the heading: degrees | the latitude: degrees

        (a) The box is now turned through {turn}° about Up, counter-clockwise as seen from above,
        and left at rest again. What do the forward gyro and the right gyro read then, in °/h?
        = The level component of the Earth's rate, {shown(level_found)} °/h, does not change; the
        heading increases by {turn}°. Its cosine belongs to the forward gyro, its sine to the right
        one.
        1: the magnitude of the level component; 1: the new heading, or a rotation of the two
        readings; 2: both numbers, with their signs
        - The box turned the other way: 3.
        > the new reading of the forward gyro: °/h | that of the right gyro: °/h

        (a) Suppose that the gyro pointing up is found to be faulty. Find the latitude and the
        heading, in degrees, from the other two and from the Earth's rate of 15.04°/h.
        = $\cos\varphi = \sqrt{{\omega_{{forward}}^2+\omega_{{right}}^2}}/U$, and $\tan\Psi =
        \omega_{{right}}/\omega_{{forward}}$ with the quadrant from both signs.
        2: the latitude; 1: the heading, apart from its quadrant; 1: its quadrant
        - The heading counted towards East, and this is stated: nothing lost.
        > the latitude without the up gyro: degrees | the heading: degrees

        (b) The right gyro reads {plain(drift)}°/h too much. What heading error does this cause
        (computed minus true), in degrees?
        = Only the component about East matters: $\Delta\Psi = d\cos\Psi/(U\cos\varphi)$.
        1: the component about East, $d\cos\Psi$; 2: divided by $U\cos\varphi$, with its sign
        - Sine of the latitude instead of cosine ({shown(by_sine)}): 2.
        > the heading error: degrees

        (b) The gyros have an angle random walk of {walk}°/√h. For how many minutes must their
        readings be averaged so that it contributes a standard deviation of {wanted}° to the
        heading?
        = $T = (N/(U\cos\varphi\,\sigma))^2$ with $\sigma$ in radians.
        2: $N$ over the square root of the time, divided by $U\cos\varphi$; 1: the number
        - $\sigma$ left in degrees: 2.
        > the time: minutes

        (b) A drift of the right gyro may cause a heading error of at most {allowed}°. How large may
        the drift be, by magnitude, in °/h?
        = The heading error in radians is the component about East, $d\cos\Psi$, divided by
        $U\cos\varphi$. Solve for $d$.
        1: $U\cos\varphi$ times the error; 1: divided by $\cos\Psi$; 1: the number
        - The error left in degrees: 2.
        > the largest drift: °/h
        """,
        [degrees, north, forward, right, by_cosine, degrees, np.degrees(error), time, largest],
    )


def under_way(draw: Generator) -> Question:
    """Chapter 14: the speed error, a speed log that errs, and an oscillating horizon."""
    degrees = int(draw.integers(38, 66))
    latitude = np.radians(degrees)
    course = list(COURSES)[int(draw.integers(len(COURSES)))]
    knots = int(draw.integers(12, 29))
    percent = float(draw.choice([1.0, 1.5, 2.0, 2.5, 3.0]))
    tilt = float(draw.choice([0.1, 0.15, 0.2, 0.25, 0.3]))
    card = np.radians(COURSES[course])
    direction = np.array([np.cos(card), np.sin(card)])
    velocity = knots * knot * direction
    error, with_log, due_north = (
        abs(float(np.degrees(speed_error(latitude, each))))
        for each in (velocity, (1 + percent / 100) * velocity, np.array([knots * knot, 0.0]))
    )
    equator = EARTH_RADIUS * EARTH_RATE
    level = equator * np.cos(latitude)
    simple = float(np.degrees(abs(velocity[0]) / level))
    side = "West" if velocity[0] > 0 else "East"
    # The same asked the other way round: how far north, and how fast.
    limit = float(np.ceil(simple * np.cos(latitude) * draw.choice([20, 25, 30])) / 10)
    seen = float(draw.choice([1, 1.2, 1.5, 1.8]))
    tangent, tangent_seen = np.tan(np.radians([limit, seen]))
    farthest = np.degrees(np.arccos((abs(velocity[0]) / tangent - velocity[1]) / equator))
    plainly = float(np.degrees(np.arccos(abs(velocity[0]) / np.radians(limit) / equator)))
    northerly = float(level * np.radians(seen) / knot)
    speed = level * tangent_seen / (abs(direction[0]) - tangent_seen * direction[1]) / knot
    remaining = 60 * (with_log - error)
    schuler = float(np.sqrt(gravity(latitude) * schuler_gains().integral))
    period = 2 * np.pi / schuler / minute
    swing = tilt * schuler / (EARTH_RATE * np.cos(latitude))
    tilted = r"$v_N/(R\,U\cos\varphi)$; neglecting $v_E$ costs nothing"
    return question(
        draw,
        rf"""
        14, 8 minutes: A compass under way
        derive the error of the compass at work

        A ship at latitude {degrees}° North makes {knots} knots (1 knot is {knot:.4f} m/s) on a
        course to the {course}. The Earth has a radius of $R$ = 6371 km and turns at $U$ = 15.04°/h;
        $g = {shown(float(gravity(latitude)))}$ m/s².

        (a) Without a correction, how many degrees from true North is the direction that the compass
        indicates as North, and on which side?
        = The compass finds the level component of the whole rate. The {shown(abs(velocity[0]))} m/s
        along the meridian rotate the local axes at $v_N/R$; the velocity to the East or West
        changes $U\cos\varphi$ by $v_E/R$. The indicated North lies to the {side} of true North.
        1: only the velocity along the meridian deflects North; 2: {tilted}; 1: the number, or
        {shown(simple)} without $v_E$, and the side
        - The whole speed instead of $v_N$ (about {shown(error * 2**0.5)}): 3.
        > the speed error, by magnitude,: degrees

        (a) At another latitude, still north of the equator, the same speed on the same course makes
        a speed error of {limit}° (by magnitude). What is that latitude?
        = The velocity along the meridian is $v_N = {shown(abs(velocity[0]))}$ m/s. From
        $v_N/(R\,U\cos\varphi)$ follows $\cos\varphi$.
        1: only the velocity along the meridian deflects North; 2: {tilted}; 1: the number, or
        {shown(plainly)} without $v_E$
        - The whole speed instead of $v_N$: 3.
        > the other latitude: degrees

        (a) On the same course, but at another speed, the uncorrected compass has an error of
        {seen:g}° (by magnitude). How many knots does the ship make, and on which side of true North
        does the compass indicate North?
        = The error is the velocity along the meridian over $R\,U\cos\varphi$, and that velocity is
        the speed over $\sqrt2$. The indicated North lies to the {side} of true North.
        1: only the velocity along the meridian deflects North; 2: {tilted}; 1: the number, or
        {shown(northerly * 2**0.5)} without $v_E$, and the side
        - The velocity along the meridian given as the speed ({shown(northerly)}): 3.
        > the speed: knots

        (b) At {knots} knots on this course, the speed error is subtracted with the help of a speed
        log that reads {percent} per cent too much. How large is the remaining error, in arc
        minutes?
        = The correction is too large by the same percentage, and by a little more or less if $v_E$
        is included in the level rate.
        2: the correction is wrong by the same percentage; 1: the number, or the percentage of the
        error
        ({shown(60 * error * percent / 100)})
        - The remaining error with the opposite sign: nothing lost.
        > the remaining error: arc minutes

        (b) The ship stops at this latitude. The horizon of its compass still oscillates about East
        with an amplitude of {tilt} arc minutes, undamped and tuned to Schuler's period. What is the
        period, in minutes, and how large does the heading error become, in arc minutes?
        = The period is $2\pi\sqrt{{R/g}}$. The oscillation has the rate $\omega_s\chi$, which the
        compass mistakes for a rate about East; divided by $U\cos\varphi$ it is a heading error.
        1: the period; 2: the heading error
        - The tilt times the tangent of the latitude ({shown(tilt * np.tan(latitude))}), given as
        the heading error: 0 for it.
        > the period: minutes | the largest heading error: arc minutes

        (b) The ship turns due North at {knots} knots. How large is the speed error then, in
        degrees? Which component of the velocity on the old course had an effect on $U\cos\varphi$
        and has none now?
        = The whole speed is now along the meridian: $v/(R\,U\cos\varphi)$. There is no velocity to
        the East or West any more that would change $U\cos\varphi$.
        1: the whole speed counts; 1: the number; 1: the velocity $v_E$ to the East or West
        - The error of the old course, as the speed is the same: 0.
        > the speed error due North: degrees
        """,
        [error, farthest, speed, remaining, period, swing, due_north],
    )
