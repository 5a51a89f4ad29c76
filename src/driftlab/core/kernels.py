"""Attitude, navigation and a filter's covariance, as Numba compiles them: one number at a time.

Each kernel goes through the formulas of a function in NumPy in the same order, so that the two
differ by rounding alone; the docstring names that function, and its comments hold here as well.
Arrays are C-contiguous doubles with one leading axis, of runs; the caller sees to that.

Constants of other files become part of what is kept on the disk, which asks only whether this file
has changed: who changes one of them saves this file anew.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit

from .earth import (
    _BEND,
    _CURVATURE,
    _DEEPEST,
    _GRADIENT,
    _GRADIENT_GROWTH,
    _SURFACE,
    _SURFACE_GROWTH,
    EARTH_RATE,
    ECCENTRICITY_SQUARED,
    FLATTENING,
    SEMI_MAJOR_AXIS,
)
from .strapdown import _SETTLED

# Without `fastmath` nothing is reordered; divisions by zero give infinity, as in NumPy; other
# threads go on meanwhile; and what was compiled once is kept on the disk.
compiled = njit(cache=True, error_model="numpy", nogil=True)
inlined = njit(cache=True, error_model="numpy", nogil=True, inline="always")

ROTATION_VECTOR, FIRST, SECOND, THIRD, TANGENT = range(5)
"""Last stages of an algorithm, see `driftlab.attitude.coning_algorithms.LastStage`."""

_TINY = float(np.finfo(float).tiny)
_MINOR_AXIS = SEMI_MAJOR_AXIS * (1 - FLATTENING)
_SECOND_ECCENTRICITY_SQUARED = ECCENTRICITY_SQUARED / (1 - ECCENTRICITY_SQUARED)


@inlined
def _product(a: Any, b: Any) -> Any:
    """`quaternion.multiply`."""
    return (
        a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
        a[3] * b[1] + a[1] * b[3] + a[2] * b[0] - a[0] * b[2],
        a[3] * b[2] + a[2] * b[3] + a[0] * b[1] - a[1] * b[0],
        a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
    )


@inlined
def _rotated(q: Any, v: Any) -> Any:
    """`quaternion.rotate`."""
    x, y, z, w = q
    t0 = 2 * (y * v[2] - z * v[1])
    t1 = 2 * (z * v[0] - x * v[2])
    t2 = 2 * (x * v[1] - y * v[0])
    return (
        v[0] + w * t0 + y * t2 - z * t1,
        v[1] + w * t1 + z * t0 - x * t2,
        v[2] + w * t2 + x * t1 - y * t0,
    )


@inlined
def _cross(a: Any, b: Any) -> Any:
    """`vectors.cross`."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@inlined
def _of_rotation_vector(p: Any) -> Any:
    """`quaternion.from_rotation_vector`."""
    square = p[0] * p[0] + p[1] * p[1] + p[2] * p[2]
    norm = math.sqrt(square)
    if not 1e-280 < square < 1e300:
        norm = math.hypot(math.hypot(p[0], p[1]), p[2])
    half = max(0.5 * norm, _TINY)
    size = 0.5 * math.sin(half) / half
    return size * p[0], size * p[1], size * p[2], math.cos(half)


@inlined
def _of_cayley_vector(k: Any) -> Any:
    """`attitude.rotation_quaternion`."""
    x, y, z, one = k[0], k[1], k[2], 1.0
    square = x * x + y * y + z * z
    if square > 1:  # the usual one is not asked for its largest part, a guess that often fails
        size = max(abs(x), abs(y), abs(z))
        x, y, z, one = x / size, y / size, z / size, 1 / size
        square = x * x + y * y + z * z
    # One division and products by it: a division takes as long as several of them.
    share = 1 / (one * one + square)
    twice = -2 * one * share
    return twice * x, twice * y, twice * z, (one * one - square) * share


@inlined
def _coning(rows: Any, begin: int, places: Any, weights: Any) -> Any:
    """`attitude._weighted`, for a window of rows (n, 3); `places` (p, 2) by rising second ones."""
    x, y, z = 0.0, 0.0, 0.0
    number = 0
    while number < len(weights):
        j = places[number, 1]
        left0, left1, left2 = 0.0, 0.0, 0.0
        while number < len(weights) and places[number, 1] == j:
            i, weight = begin + places[number, 0], weights[number]
            left0 += weight * rows[i, 0]
            left1 += weight * rows[i, 1]
            left2 += weight * rows[i, 2]
            number += 1
        right = rows[begin + j, 0], rows[begin + j, 1], rows[begin + j, 2]
        added = _cross((left0, left1, left2), right)
        x, y, z = x + added[0], y + added[1], z + added[2]
    return x, y, z


@inlined
def _step(gamma: Any, coning: Any, stage: int) -> Any:
    """`attitude.step_quaternions`: quaternion, and the square of gamma."""
    corrected = gamma[0] + coning[0], gamma[1] + coning[1], gamma[2] + coning[2]
    square = gamma[0] * gamma[0] + gamma[1] * gamma[1] + gamma[2] * gamma[2]
    if stage == ROTATION_VECTOR:
        return _of_rotation_vector(corrected), 0.0
    if stage == FIRST:
        k = -1 / 4 * gamma[0], -1 / 4 * gamma[1], -1 / 4 * gamma[2]
    elif stage == TANGENT:
        length = (
            corrected[0] * corrected[0] + corrected[1] * corrected[1] + corrected[2] * corrected[2]
        )
        factor = -1 / 4 - 1 / 192 * length
        k = factor * corrected[0], factor * corrected[1], factor * corrected[2]
    else:
        cubed = 1 / 192 * square
        k = (
            -1 / 4 * corrected[0] - cubed * gamma[0],
            -1 / 4 * corrected[1] - cubed * gamma[1],
            -1 / 4 * corrected[2] - cubed * gamma[2],
        )
        if stage == SECOND:
            twist = _cross(gamma, coning)
            k = (
                k[0] - 1 / 32 * twist[0],
                k[1] - 1 / 32 * twist[1],
                k[2] - 1 / 32 * twist[2],
            )
    return _of_cayley_vector(k), square


@inlined
def _sum(rows: Any, begin: int, count: int) -> Any:
    """Sum of rows (n, 3) from `begin` on."""
    x, y, z = rows[begin, 0], rows[begin, 1], rows[begin, 2]
    for i in range(begin + 1, begin + count):
        x, y, z = x + rows[i, 0], y + rows[i, 1], z + rows[i, 2]
    return x, y, z


@compiled
def _steps(
    rows: Any,
    begin: int,
    window: int,
    samples: int,
    places: Any,
    weights: Any,
    stage: int,
    q: Any,
    into: Any,
) -> Any:
    """Attitudes into (k, 4) from q on, by one set of weights; the last, and the largest square.

    `begin` is the first row of the first step, `window` that of its window. A loop of its own and
    without a choice in it, which takes a third of the time of one that chooses.
    """
    largest = 0.0
    for number in range(len(into)):
        gamma = _sum(rows, begin + number * samples, samples)
        coning = _coning(rows, window + number * samples, places, weights)
        step, square = _step(gamma, coning, stage)
        largest = max(largest, square)
        q = _product(q, step)
        into[number, 0], into[number, 1], into[number, 2], into[number, 3] = q
    return q, largest


@compiled
def attitudes(
    first: Any,
    angle: Any,
    samples: int,
    memory: int,
    past: int,
    places: Any,
    weights: Any,
    starts: Any,
    stage: int,
    found: Any,
) -> float:
    """`attitude.attitudes`: from first (r, 1, 4) along angle (r, n, 3) into found (r, k, 4).

    The first two have r runs or one for all. `starts` (memory, p) has the weights of the first
    steps, of the same pairs as `places`. Returns the largest square of a gamma.
    """
    largest = 0.0
    for run in range(len(found)):
        rows, start, into = angle[run % len(angle)], first[run % len(first), 0], found[run]
        q = start[0], start[1], start[2], start[3]
        number, begin = 0, past
        while begin < memory and number < len(into):
            one = into[number : number + 1]
            q, square = _steps(rows, begin, 0, samples, places, starts[begin], stage, q, one)
            largest = max(largest, square)
            number, begin = number + 1, begin + samples
        q, square = _steps(
            rows, begin, begin - memory, samples, places, weights, stage, q, into[number:]
        )
        largest = max(largest, square)
    return largest


@compiled
def cumulative_product(rows: Any, found: Any) -> None:
    """`quaternion.cumulative_product`: rows (r, n, 4) into found (r, n, 4)."""
    for run in range(rows.shape[0]):
        q = rows[run, 0, 0], rows[run, 0, 1], rows[run, 0, 2], rows[run, 0, 3]
        found[run, 0, 0], found[run, 0, 1], found[run, 0, 2], found[run, 0, 3] = q
        for i in range(1, rows.shape[1]):
            one = rows[run, i, 0], rows[run, i, 1], rows[run, i, 2], rows[run, i, 3]
            q = _product(q, one)
            found[run, i, 0], found[run, i, 1] = q[0], q[1]
            found[run, i, 2], found[run, i, 3] = q[2], q[3]


@inlined
def _local_axes(latitude: float, longitude: float) -> Any:
    """`earth.local_axes`."""
    half_tilt, half_turn = math.pi / 4 - latitude / 2, math.pi / 4 + longitude / 2
    sine_tilt, cosine_tilt = math.sin(half_tilt), math.cos(half_tilt)
    sine_turn, cosine_turn = math.sin(half_turn), math.cos(half_turn)
    return (
        cosine_turn * sine_tilt,
        sine_turn * sine_tilt,
        sine_turn * cosine_tilt,
        cosine_turn * cosine_tilt,
    )


@inlined
def _geodetic(rho: float, z: float) -> Any:
    """`earth._geodetic`."""
    x, y = (1 - FLATTENING) * rho, z
    size = math.sqrt(x * x + y * y)
    cosine, sine = x / size, y / size
    y = z + _SECOND_ECCENTRICITY_SQUARED * _MINOR_AXIS * (sine * sine * sine)
    x = rho - ECCENTRICITY_SQUARED * SEMI_MAJOR_AXIS * (cosine * cosine * cosine)
    size = math.sqrt(x * x + y * y)
    sine, cosine = y / size, x / size
    inverse_across = math.sqrt(1 - ECCENTRICITY_SQUARED * sine * sine) / SEMI_MAJOR_AXIS
    altitude = rho * cosine + z * sine - SEMI_MAJOR_AXIS**2 * inverse_across
    return sine, cosine, altitude, 1 / inverse_across


@inlined
def _gravitation(x: float, y: float, z: float) -> Any:
    """`earth.gravitation`, and the squared distance from the centre."""
    level = x * x + y * y
    sine, _, altitude, across = _geodetic(math.sqrt(level), z)
    squared, bend = sine * sine, _BEND * altitude
    surface = across * (_SURFACE + _SURFACE_GROWTH * squared)
    gradient = _GRADIENT - _GRADIENT_GROWTH * squared - _CURVATURE * altitude
    inwards = surface * (1 - altitude * gradient) - bend * squared
    out = -inwards / (across + altitude) - EARTH_RATE**2
    return out * x, out * y, -(inwards + bend) * sine, level + z * z


@inlined
def _gained(p: Any, v: Any, s: Any) -> Any:
    """Velocity of a step from its rotation vector, its sum and its sculling correction."""
    once = _cross(p, v)
    twice = _cross(p, once)
    thrice = _cross(p, twice)
    turned = _cross(p, s)
    return (
        v[0] + once[0] / 2 + twice[0] / 6 + thrice[0] / 24 + s[0] + turned[0] / 2,
        v[1] + once[1] / 2 + twice[1] / 6 + thrice[1] / 24 + s[1] + turned[1] / 2,
        v[2] + once[2] / 2 + twice[2] / 6 + thrice[2] / 24 + s[2] + turned[2] / 2,
    )


@inlined
def _sculling(angle: Any, velocity: Any, begin: int, places: Any, weights: Any) -> Any:
    """`sculling._sculling`, for the window of rows (n, 3) that starts at `begin`."""
    x, y, z = 0.0, 0.0, 0.0
    for number in range(len(weights)):
        i, j, weight = begin + places[number, 0], begin + places[number, 1], weights[number]
        gi, gj = (angle[i, 0], angle[i, 1], angle[i, 2]), (angle[j, 0], angle[j, 1], angle[j, 2])
        vi = velocity[i, 0], velocity[i, 1], velocity[i, 2]
        vj = velocity[j, 0], velocity[j, 1], velocity[j, 2]
        one, other = _cross(gi, vj), _cross(vi, gj)
        x += weight * (one[0] + other[0])
        y += weight * (one[1] + other[1])
        z += weight * (one[2] + other[2])
    return x, y, z


@compiled
def _fall(
    position: Any, speed: Any, coasting: Any, free: Any, places: Any, pull: Any, interval: float
) -> float:
    """`strapdown._fall` from coasting (k, 3) into places and pull (k, 3); `free` is for the work.

    Returns the smallest squared distance from the Earth's centre that it came upon.
    """
    count = len(coasting)
    here = np.empty(3)
    here[0], here[1], here[2], lowest = _gravitation(position[0], position[1], position[2])
    for axis in range(3):
        total = 0.0
        for k in range(count):
            total += coasting[k, axis]
            away = interval * (total + 0.5 * (speed[axis] - coasting[k, axis]))
            free[k, axis] = position[axis] + away
            places[k, axis] = free[k, axis] + 0.5 * here[axis] * (interval * (k + 1)) ** 2
    contraction = (interval * count) ** 2 * 1.6e-6
    while True:
        change = 0.0
        sum0, sum1, sum2 = 0.0, 0.0, 0.0
        twice0, twice1, twice2 = 0.0, 0.0, 0.0
        for k in range(count):
            g0, g1, g2, square = _gravitation(places[k, 0], places[k, 1], places[k, 2])
            lowest = min(lowest, square)
            sum0, sum1, sum2 = sum0 + g0, sum1 + g1, sum2 + g2
            pull0 = interval * (sum0 + 0.5 * (here[0] - g0))
            pull1 = interval * (sum1 + 0.5 * (here[1] - g1))
            pull2 = interval * (sum2 + 0.5 * (here[2] - g2))
            twice0, twice1, twice2 = twice0 + pull0, twice1 + pull1, twice2 + pull2
            settled0 = free[k, 0] + interval * (twice0 - 0.5 * pull0)
            settled1 = free[k, 1] + interval * (twice1 - 0.5 * pull1)
            settled2 = free[k, 2] + interval * (twice2 - 0.5 * pull2)
            change = max(
                change,
                abs(settled0 - places[k, 0]),
                abs(settled1 - places[k, 1]),
                abs(settled2 - places[k, 2]),
            )
            places[k, 0], places[k, 1], places[k, 2] = settled0, settled1, settled2
            pull[k, 0], pull[k, 1], pull[k, 2] = pull0, pull1, pull2
        if not change * contraction > _SETTLED or lowest < _DEEPEST**2:
            return lowest


@compiled
def navigate(
    start: Any,
    angle: Any,
    velocity: Any,
    interval: float,
    samples: int,
    places: Any,
    weights: Any,
    stage: int,
    chunk: int,
    every: int,
    hold_altitude: bool,
    found: Any,
) -> tuple[float, float]:
    """`strapdown.navigate`: from start (r, 10) along rows (r, n, 3) into found (r, k, 10).

    The rows have r runs or one for all. A state is latitude, longitude, altitude, velocity,
    attitude. Chunk and every are numbers of steps. Returns the largest square of a gamma, and the
    smallest one of a distance from the Earth's centre.
    """
    largest, lowest = 0.0, np.inf
    steps = angle.shape[1] // samples
    step = samples * interval
    size = min(chunk, steps)
    coasting, free, way, pull = (
        np.empty((size, 3)),
        np.empty((size, 3)),
        np.empty((size, 3)),
        np.empty((size, 3)),
    )
    turned = np.empty((size, 4))
    position, speed = np.empty(3), np.empty(3)
    for run in range(len(found)):
        rows, pushed = angle[run % len(angle)], velocity[run % len(velocity)]
        begun = start[run]
        to_inertial = _local_axes(begun[0], 0.0)
        q = _product(to_inertial, (begun[6], begun[7], begun[8], begun[9]))
        squared = 1 - ECCENTRICITY_SQUARED * math.sin(begun[0]) ** 2
        across = SEMI_MAJOR_AXIS / math.sqrt(squared)
        position[0] = (across + begun[2]) * math.cos(begun[0])
        position[1] = 0.0
        position[2] = (across * (1 - ECCENTRICITY_SQUARED) + begun[2]) * math.sin(begun[0])
        flown = _rotated(to_inertial, (begun[3], begun[4], begun[5]))
        speed[0] = flown[0] - EARTH_RATE * position[1]
        speed[1] = flown[1] + EARTH_RATE * position[0]
        speed[2] = flown[2]
        for begin in range(0, steps, size):
            count = min(size, steps - begin)
            gained0, gained1, gained2 = 0.0, 0.0, 0.0
            for k in range(count):
                place = (begin + k) * samples
                gamma, coning = _sum(rows, place, samples), _coning(rows, place, places, weights)
                p = gamma[0] + coning[0], gamma[1] + coning[1], gamma[2] + coning[2]
                sculling = _sculling(rows, pushed, place, places, weights)
                push = _rotated(q, _gained(p, _sum(pushed, place, samples), sculling))
                gained0, gained1, gained2 = gained0 + push[0], gained1 + push[1], gained2 + push[2]
                coasting[k, 0], coasting[k, 1] = speed[0] + gained0, speed[1] + gained1
                coasting[k, 2] = speed[2] + gained2
                turn, square = _step(gamma, coning, stage)
                largest = max(largest, square)
                q = _product(q, turn)
                turned[k, 0], turned[k, 1], turned[k, 2], turned[k, 3] = q
            nearest = _fall(
                position, speed, coasting[:count], free[:count], way[:count], pull[:count], step
            )
            lowest = min(lowest, nearest)
            if lowest < _DEEPEST**2:
                return largest, lowest
            for k in range((-1 - begin) % every, count, every):
                number = (begin + k) // every
                x, y, z = way[k, 0], way[k, 1], way[k, 2]
                sine, cosine, altitude, _ = _geodetic(math.sqrt(x * x + y * y), z)
                latitude, inertial = math.atan2(sine, cosine), math.atan2(y, x)
                axes = _local_axes(latitude, inertial)
                back = -axes[0], -axes[1], -axes[2], axes[3]
                moved = (
                    coasting[k, 0] + pull[k, 0] + EARTH_RATE * y,
                    coasting[k, 1] + pull[k, 1] - EARTH_RATE * x,
                    coasting[k, 2] + pull[k, 2],
                )
                east, north, up = _rotated(back, moved)
                gone = every * step * (number + 1)
                longitude = begun[1] + inertial - EARTH_RATE * gone
                here = found[run, number]
                here[0] = latitude
                here[1] = (longitude + math.pi) % (2 * math.pi) - math.pi
                here[2] = begun[2] if hold_altitude else altitude
                here[3], here[4], here[5] = east, north, 0.0 if hold_altitude else up
                attitude = _product(back, (turned[k, 0], turned[k, 1], turned[k, 2], turned[k, 3]))
                here[6], here[7], here[8], here[9] = attitude
            last = count - 1
            for axis in range(3):
                position[axis] = way[last, axis]
                speed[axis] = coasting[last, axis] + pull[last, axis]
            if hold_altitude:
                x, y, z = position[0], position[1], position[2]
                sine, cosine, altitude, _ = _geodetic(math.sqrt(x * x + y * y), z)
                axes = _local_axes(math.atan2(sine, cosine), math.atan2(y, x))
                up0, up1, up2 = _rotated(axes, (0.0, 0.0, 1.0))
                climb = speed[0] * up0 + speed[1] * up1 + speed[2] * up2
                raised = begun[2] - altitude
                position[0], position[1] = x + raised * up0, y + raised * up1
                position[2] = z + raised * up2
                speed[0], speed[1] = speed[0] - climb * up0, speed[1] - climb * up1
                speed[2] = speed[2] - climb * up2
    return largest, lowest


@compiled
def covariances(
    after: Any, transitions: Any, noises: Any, observation: Any, spreads: Any, variances: Any
) -> bool:
    """`kalman.covariances` of (size, size) in place, and whether all spreads had an inverse."""
    moving, size, many = transitions.shape[1], len(after), len(observation)
    rows, seen, gain = np.empty((moving, size)), np.empty((many, size)), np.empty((size, many))
    weights = np.empty((many, many))
    for step in range(len(transitions)):
        transition, spread = transitions[step], spreads[step].copy()
        _multiply(transition, after, rows)
        for i in range(moving):
            for j in range(moving):
                after[i, j] = _dot(rows[i], transition[j]) + noises[step, i, j]
            for j in range(moving, size):
                after[i, j] = rows[i, j]
                after[j, i] = rows[i, j]
        _multiply(observation, after, seen)
        for i in range(many):
            for j in range(many):
                spread[i, j] += _dot(seen[i], observation[j])
        if not _invert(spread, weights):
            return False
        for i in range(size):
            for j in range(many):
                total = 0.0
                for k in range(many):
                    total += seen[k, i] * weights[k, j]
                gain[i, j] = total
            for k in range(many):
                factor = gain[i, k]
                for j in range(size):
                    after[i, j] -= factor * seen[k, j]
        for i in range(size):
            for j in range(i):
                mean = 0.5 * (after[i, j] + after[j, i])
                after[i, j] = mean
                after[j, i] = mean
            variances[step, i] = after[i, i]
    return True


@inlined
def _multiply(a: Any, b: Any, found: Any) -> None:
    """Product of matrices (m, n) and (n, k); the rows of the first are often nearly empty."""
    found[:] = 0.0
    for i in range(a.shape[0]):
        for j in range(a.shape[1]):
            factor = a[i, j]
            if factor != 0.0:
                for k in range(b.shape[1]):
                    found[i, k] += factor * b[j, k]


@inlined
def _dot(a: Any, b: Any) -> float:
    """Sum of products; in four parts, none of which waits for the others."""
    total0, total1, total2, total3 = 0.0, 0.0, 0.0, 0.0
    whole = len(a) - len(a) % 4
    for k in range(0, whole, 4):
        total0 += a[k] * b[k]
        total1 += a[k + 1] * b[k + 1]
        total2 += a[k + 2] * b[k + 2]
        total3 += a[k + 3] * b[k + 3]
    for k in range(whole, len(a)):
        total0 += a[k] * b[k]
    return (total0 + total1) + (total2 + total3)


@inlined
def _invert(matrix: Any, inverse: Any) -> bool:
    """Gauss and Jordan with the largest pivots; says whether there were any. Spoils the matrix."""
    size = len(matrix)
    inverse[:] = 0.0
    for i in range(size):
        inverse[i, i] = 1.0
    for column in range(size):
        best = column
        for i in range(column + 1, size):
            if abs(matrix[i, column]) > abs(matrix[best, column]):
                best = i
        pivot = matrix[best, column]
        if pivot == 0.0:
            return False
        for k in range(size):
            chosen, other = matrix[best, k] / pivot, matrix[column, k]
            matrix[best, k], matrix[column, k] = other, chosen
            chosen, other = inverse[best, k] / pivot, inverse[column, k]
            inverse[best, k], inverse[column, k] = other, chosen
        for i in range(size):
            factor = matrix[i, column]
            if i != column and factor != 0.0:
                for k in range(size):
                    matrix[i, k] -= factor * matrix[column, k]
                    inverse[i, k] -= factor * inverse[column, k]
    return True
