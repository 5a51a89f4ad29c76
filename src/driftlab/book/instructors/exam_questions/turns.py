"""Questions on Part I: the error of a turning body, its roots, its drift, a table on the Earth."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from driftlab.drift.characteristic_equation import exact_roots
from driftlab.drift.error_kinematics import error_quaternion
from driftlab.drift.systematic_drift import drift_coefficient, principal_drifts
from driftlab.drift.turn_calibration import earth_rate_offset
from driftlab.earth import EARTH_RATE
from driftlab.quaternion import to_rotation_vector
from driftlab.triad import measured_rate

from .question import Answer, Part, Question, matrix, shown, two_of

ARCMIN = float(np.radians(1 / 60))
ARCSEC = float(np.radians(1 / 3600))
ORDINALS = ("first", "second", "third")
BY_LENGTH = (((3, 0, 4), 5), ((4, 3, 0), 5), ((0, 4, 3), 5), ((2, 2, 1), 3), ((1, 2, 2), 3))
"""Rates of whole numbers whose size is one, too."""


def error_of_a_turn(draw: Generator) -> Question:
    """Chapter 01: an error along the rate grows, one across it swings."""
    rate = int(draw.choice([6, 8, 9, 12, 15, 18]))
    scale = int(draw.choice([-1, 1]) * draw.integers(3, 9))
    cross = int(draw.integers(4, 10))
    turns = int(draw.integers(3, 8))
    allowed = int(draw.choice([2, 3, 4, 6, 8]))
    axis = int(draw.integers(3))
    other = (axis + 1) % 3
    error_matrix = np.zeros((3, 3))
    error_matrix[axis, axis], error_matrix[other, axis] = 1e-4 * scale, 1e-4 * cross
    omega = np.radians(rate) * np.eye(3)[axis]
    period = 2 * np.pi / np.radians(rate)
    times = np.array([turns * period, 0.5 * period])
    error = to_rotation_vector(error_quaternion(omega, measured_rate(omega, error_matrix), times))
    along = error[0, axis] / ARCMIN
    across = float(np.linalg.norm(np.delete(error[1], axis))) / ARCMIN
    needed = 1e6 * allowed * ARCMIN / (2 * np.pi * turns)
    return Question(
        "A body turns",
        "01",
        "make it linear for small errors",
        9,
        rf"A body turns at {rate}°/s about its {ORDINALS[axis]} axis. The gyro of this axis reads "
        rf"${scale}\cdot10^{{-4}}$ of the rate too much, and the {ORDINALS[other]} gyro, which "
        rf"should read nothing, reads ${cross}\cdot10^{{-4}}$ of it. At $t = 0$ the computer's "
        "attitude is right.",
        two_of(
            draw,
            Part(
                "How large does the error across the axis become at most, in arc minutes, and "
                "after which part of a turn is it there for the first time?",
                "It runs round a circle that begins at zero and has the radius "
                rf"${cross}\cdot10^{{-4}}$, so the farthest point is twice that away, "
                "after half a turn; after a whole turn it is zero again.",
                (Answer("the largest error across", across, "arc minutes"),),
                ((2, "a circle, or a sine, that comes back"), (2, "number, and half a turn")),
                (
                    "The rate error times the time of a turn "
                    f"({shown(2 * np.pi * cross * 1e-4 / ARCMIN)}): 0; it is what the chapter "
                    "is against.",
                    f"The radius for the diameter ({shown(across / 2)}): 3.",
                ),
            ),
            Part(
                r"Write down the linear equation that the small error $\varphi(t)$ obeys in body "
                "axes, and say what each of its terms stands for.",
                r"$\dot\varphi = -\omega\times\varphi + M\omega$: the error is seen from a body "
                "that turns, and it is driven by what the gyros read too much.",
                (),
                ((2, "the term of the rotation, with its sign"), (1, r"the drive $M\omega$")),
                (
                    r"$+\omega\times\varphi$: that is the equation in fixed axes turned round; 1.",
                    "No term of the rotation, so that all grows with time: 1.",
                ),
            ),
            Part(
                f"How large is the error along the axis of the turn after {turns} whole turns, "
                "in arc minutes, with its sign?",
                "Along the rate nothing turns the error away, so it is the part of the angle: "
                rf"$2\pi\cdot{turns}\cdot({scale}\cdot10^{{-4}})$.",
                (Answer("the error along the axis", along, "arc minutes"),),
                ((2, "the angle turned times the scale error"), (1, "number, sign and unit")),
                (f"In radians or degrees, otherwise right: 2 ({shown(along / 60)}°).",),
            ),
            Part(
                f"The error along the axis of the turn shall stay within {allowed} arc minutes for "
                f"{turns} whole turns. Which scale-factor error may the gyro of this axis have at "
                "most, in parts per million?",
                rf"The angle turned is $2\pi\cdot{turns}$; the error is this angle times the "
                "scale-factor error, in radians. The rate does not matter.",
                (Answer("the scale-factor error", needed, "ppm"),),
                ((2, "angle turned times scale-factor error, in radians"), (1, "the number")),
                ("Made to depend on the rate, by way of the time: 1.",),
            ),
        ),
    )


def roots(draw: Generator) -> Question:
    """Chapter 02: exact and asymptotic roots of one triad about one axis."""
    triple, size = BY_LENGTH[int(draw.integers(len(BY_LENGTH)))]
    omega = np.array(triple, dtype=float)
    row, column = draw.permutation(np.flatnonzero(omega))[:2]
    diagonal, beside = draw.integers(4, 10), draw.integers(4, 10)
    sign = int(draw.choice([-1, 1]))
    error_matrix = np.zeros((3, 3))
    error_matrix[row, row], error_matrix[row, column] = 1e-3 * sign * np.array([diagonal, beside])
    measured = measured_rate(omega, error_matrix)
    slow = float(exact_roots(omega, measured)[2].imag)
    first = float(size * drift_coefficient(omega, error_matrix))
    minutes = 10 / abs(slow) / 60  # the rates of this question are in deg/s
    trimmed = -1e3 * error_matrix[row, column] * omega[column] / omega[row]
    place = f"{row + 1}{row + 1}"
    return Question(
        "Two speeds",
        "02",
        "find the speeds at which an attitude error moves",
        7,
        rf"A triad with $A = I + M$, $M = {matrix(1e3 * error_matrix)}\cdot10^{{-3}}$, turns at "
        rf"$\omega = ({', '.join(map(str, triple))})$ degrees a second.",
        two_of(
            draw,
            Part(
                r"The roots of the characteristic equation are $\pm i(|\hat\omega| + |\omega|)$ "
                r"and $\pm i(|\hat\omega| - |\omega|)$. How large is "
                r"$|\hat\omega| - |\omega|$, in degrees a second? Keep the digits that you need.",
                rf"$|\omega| = {size}$ and $|\hat\omega| = |A\omega| = "
                rf"{np.linalg.norm(measured):.6f}$ degrees a second.",
                (Answer("the difference, exact,", slow, "°/s", 4),),
                ((1, r"$\hat\omega = A\omega$, row by row"), (2, "the number, with its sign")),
                ("Rounded too early, so that one digit is left: 2.",),
            ),
            Part(
                r"What does first order, $|\omega|\,\rho$ with $\rho = n^TMn$, say instead?",
                rf"$\rho = {shown(first / size)}$; the difference is of second order in $M$.",
                (Answer("the difference, first order,", first, "°/s", 4),),
                ((2, r"$\rho$ with a *unit* vector $n$"), (1, "the number")),
                (rf"$\omega^TM\omega$ without dividing ({shown(first * size)}): 1.",),
            ),
            Part(
                "The error is looked at once a turn. After how many minutes is it ten degrees?",
                "Once a turn only the slow motion shows, and it is a steady rotation at the "
                "exact difference.",
                (Answer("the time", minutes, "minutes"),),
                ((2, "the slow root is the rate of a steady rotation"), (1, "the number")),
                (f"Half of the root taken as the rate ({shown(2 * minutes)}): 2.",),
            ),
            Part(
                rf"The entry {place} of $M$ can be trimmed. To which value, in units of "
                r"$10^{-3}$, so that the triad does not drift about this axis to first order?",
                r"$\omega^TM\omega = 0$: two terms are left, and the trimmed one has to cancel "
                "the other.",
                (Answer(f"the entry {place}", float(trimmed), r"$\cdot10^{-3}$"),),
                ((2, r"$n^TMn = 0$, with both terms"), (1, "the number, with its sign")),
                ("Set to zero, as if the other entry did not drift: 0.",),
            ),
        ),
    )


def worst_axis(draw: Generator) -> Question:
    """Chapter 03: which part of a matrix drifts, and about which axis most."""
    i, j = sorted(draw.permutation(3)[:2].tolist())
    k = 3 - i - j
    skew = int(draw.choice([-1, 1]) * draw.integers(6, 20))
    mean = int(draw.choice([-1, 1]) * draw.integers(25, 50))
    scale = int(draw.choice([-1, 1]) * draw.integers(8, 20))
    entries = np.zeros((3, 3))
    entries[i, j], entries[j, i], entries[k, k] = mean + skew, mean - skew, scale
    coefficients, axes = principal_drifts(entries * ARCSEC)
    drifts = 2 * np.pi * coefficients / ARCSEC
    largest = int(np.argmax(drifts))
    mean_drift = float(np.mean(drifts))
    diagonal = np.eye(3)[i] + np.eye(3)[k]
    oblique = float(2 * np.pi * drift_coefficient(diagonal, entries))
    names = [", ".join(shown(x) for x in axis) for axis in axes]
    return Question(
        "The worst axis",
        "03",
        "find the worst axis of any triad",
        10,
        rf"The errors of a triad are $M = {matrix(entries)}$ arc seconds.",
        two_of(
            draw,
            Part(
                "About which axis is the drift in one turn largest in the positive sense, and how "
                "large is it, in arc seconds?",
                rf"An eigenvector of the symmetric part. The eigenvalues are $\pm{abs(mean)}''$ "
                rf"and ${scale}''$; the largest belongs to $\pm({names[largest]})$.",
                (Answer("the largest drift in one turn", float(drifts[largest]), "arc seconds"),),
                ((2, "an eigenvector of the symmetric part"), (1, "the axis"), (1, "the number")),
                (
                    r"The largest entry of $M$ taken, times $2\pi$: 1.",
                    "The axis of the largest negative drift, with its number: 3.",
                ),
            ),
            Part(
                "Which part of $M$ says nothing about the drift, to first order? Split it off, so "
                "that its size shows, and say in one sentence why that part does not drift.",
                rf"The skew part, with $\pm{abs(skew)}''$ at the two places beside the diagonal. "
                r"$n^TMn$ of a skew matrix is zero: it turns the triad as a whole, and the error "
                "is the same again after each turn. The symmetric part keeps "
                rf"${mean}''$ there and ${scale}''$ on the diagonal.",
                (
                    Answer("the entry of the skew part, by size,", abs(skew), "arc seconds"),
                    Answer(
                        "the entry of the symmetric part beside the diagonal", mean, "arc seconds"
                    ),
                ),
                ((2, "both parts"), (1, "a reason: $n^TMn = 0$, or a triad turned as a whole")),
                ("The entries split as sum and difference, without the half: 2.",),
            ),
            Part(
                f"How large is the drift in one turn about the bisector of axes {i + 1} and "
                f"{k + 1}, in arc seconds?",
                rf"$2\pi\,n^TMn$ with $n$ of length one: only the ${scale}''$ count, by half.",
                (Answer("the drift in one turn", oblique, "arc seconds"),),
                ((2, r"$2\pi\,n^TMn$ with a unit vector"), (1, "the number")),
                (f"The bisector not made a unit vector ({shown(2 * oblique)}): 2.",),
            ),
            Part(
                "How large is the drift in one turn on average over all axes, in arc seconds, "
                "its sign counted?",
                r"Over all directions $n_i^2$ is 1/3 on average and $n_in_j$ is zero, so "
                r"$2\pi$ times a third of the trace.",
                (Answer("the mean drift in one turn", mean_drift, "arc seconds"),),
                ((2, "only the diagonal counts, by a third"), (1, "the number")),
                (f"The trace without its third ({shown(3 * mean_drift)}): 2.",),
            ),
        ),
    )


def table_on_the_earth(draw: Generator) -> Question:
    """Chapter 04: two records in opposite senses, on a table that the Earth carries."""
    degrees = int(draw.integers(35, 66))
    south = bool(draw.integers(2))
    latitude = np.radians(-degrees if south else degrees)
    rate = int(draw.choice([8, 10, 12, 15, 20]))
    turns = int(draw.integers(2, 6))
    true = float(draw.choice([-1, 1]) * draw.integers(15, 60))
    bias = float(draw.choice([-1, 1]) * draw.integers(4, 12)) * ARCSEC  # deg/h is arcsec/s
    noise = float(draw.choice([1.2, 1.5, 2.0, 2.4, 3.0]))
    offset = float(earth_rate_offset(latitude, np.radians(rate))) / ARCSEC
    both = offset + bias / np.radians(rate) / ARCSEC
    readings = [round(true + both, 1), round(true - both, 1)]
    found, half = np.mean(readings), (readings[0] - readings[1]) / 2
    turning = half * ARCSEC * rate * 3600  # deg/h: what turns round with the table
    by_bias = turning - np.degrees(EARTH_RATE) * 3600 * np.sin(latitude)
    by_cosine = offset / np.tan(latitude)
    return Question(
        "A table on the Earth",
        "04",
        "say what the Earth's rate, a gyro bias and a scale factor do to the result",
        11,
        rf"At {degrees}° {'South' if south else 'North'} a triad rides on a table with an upright "
        rf"axis; the axis $n$ of the body points up. {turns} whole turns counter-clockwise, seen "
        rf"from above, at {rate}°/s give the estimate ${readings[0]}''$ of $n^T\Sigma n$: "
        "the error angle about $n$ over the angle turned. As many clockwise, each counted about "
        rf"its own direction of turning, give ${readings[1]}''$. The gyros may have biases; the "
        "Earth turns by 15.04° an hour.",
        two_of(
            draw,
            Part(
                r"Find $n^T\Sigma n$, in arc seconds, and the bias of the triad along $n$, in "
                "degrees an hour.",
                "The mean of both is free of all that does not turn round with the table. Half "
                rf"of the difference, ${shown(half)}''$, is Earth and bias together over the rate; "
                "times the rate it is both in degrees an hour, and the Earth's part comes off.",
                (
                    Answer(r"$n^T\Sigma n$", float(found), "arc seconds"),
                    Answer("the bias along $n$", float(by_bias), "°/h"),
                ),
                ((2, "the mean"), (1, "half of the difference"), (1, "less the Earth, in °/h")),
                (
                    f"The Earth forgotten in the bias ({shown(turning)} °/h): 3.",
                    "One estimate corrected by the Earth alone and given as the result: 1.",
                ),
            ),
            Part(
                "What does the Earth add to the first estimate, in arc seconds, with its sign?",
                r"The upright part of its rate over the rate of the table, $U\sin\varphi/w$, "
                "whatever the number of turns.",
                (Answer("the Earth's offset", offset, "arc seconds"),),
                (
                    (1, r"the upright part, $U\sin\varphi$"),
                    (1, "over the rate of the table"),
                    (1, "the number, with the sign of the hemisphere"),
                ),
                (
                    f"Cosine for sine ({shown(by_cosine)}): 2.",
                    f"Divided by the {turns} turns once more ({shown(offset / turns)}): 2.",
                ),
            ),
            Part(
                rf"Each estimate has a standard deviation of ${noise}''$. Which has your "
                r"$n^T\Sigma n$? Which fault of the table does it not contain?",
                r"The mean of two: divide by $\sqrt2$. Not contained is whatever turns round with "
                "the table: one that turns too far by the same part each time looks like a scale "
                "factor, and an axis that leans like another axis $n$.",
                (Answer("the standard deviation", noise / np.sqrt(2), "arc seconds"),),
                ((1, "the number"), (2, "a fault that is the same in both senses")),
                (f"The two deviations added, or the larger one kept ({noise}): 0 for the number.",),
            ),
            Part(
                "Somebody has the turns counter-clockwise only, and takes off the Earth rightly. "
                r"By how many arc seconds is the $n^T\Sigma n$ found so wrong, with its sign, "
                "and what would halve that?",
                "The bias is left in it, over the rate of the table: half of the difference less "
                "the Earth's offset. A table twice as fast halves it; more turns do not.",
                (Answer("the error of one sense alone", float(half - offset), "arc seconds"),),
                ((1, "the bias over the rate"), (1, "the number"), (1, "a faster table")),
                ("More turns: 0 for the last mark, they bring more bias as well.",),
            ),
        ),
    )
