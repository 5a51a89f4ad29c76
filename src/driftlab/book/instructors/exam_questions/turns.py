"""Questions on Part I: the error of a turning body, its roots, its drift, a table on the Earth."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from driftlab.drift.characteristic_equation import exact_roots
from driftlab.drift.systematic_drift import drift_coefficient, principal_drifts
from driftlab.drift.turn_calibration import earth_rate_offset
from driftlab.earth import EARTH_RATE
from driftlab.triad import measured_rate

from .question import Question, matrix, plain, question, shown

ARCMIN = float(np.radians(1 / 60))
ARCSEC = float(np.radians(1 / 3600))
ORDINALS = ("first", "second", "third")
BY_LENGTH = (((3, 0, 4), 5), ((4, 3, 0), 5), ((0, 4, 3), 5), ((2, 2, 1), 3), ((1, 2, 2), 3))
"""Rates in whole numbers with a magnitude that is a whole number, too."""


def error_of_a_turn(draw: Generator) -> Question:
    """Chapter 01: an error along the rate grows, one perpendicular to it returns."""
    rate = int(draw.choice([6, 8, 9, 12, 15, 18]))
    scale = int(draw.choice([-1, 1]) * draw.integers(3, 9))
    cross = int(draw.integers(4, 10))
    turns = int(draw.integers(3, 8))
    allowed = int(draw.choice([2, 3, 4, 6, 8]))
    stop = int(draw.choice([80, 100, 120, 140]))
    axis = int(draw.integers(3))
    other = (axis + 1) % 3
    radius = cross * 1e-4 / ARCMIN  # to first order, as the question asks
    across, stopped = 2 * radius, 2 * radius * np.sin(np.radians(stop / 2))
    along = 2 * np.pi * turns * scale * 1e-4 / ARCMIN
    needed = 1e6 * allowed * ARCMIN / (2 * np.pi * turns)
    coupling = 100 * cross * allowed / across
    circle = rf"""The perpendicular error moves on a circle that passes through zero and has the
        radius ${cross}\cdot10^{{-4}}$ rad."""
    return question(
        draw,
        rf"""
        01, 9 minutes: A rotating body
        make it linear for small errors

        A body rotates at {rate}°/s about its {ORDINALS[axis]} axis. The gyro on this axis has a
        scale-factor error of ${scale}\cdot10^{{-4}}$. The {ORDINALS[other]} gyro, which should read
        zero, has a cross-coupling: it reads ${cross}\cdot10^{{-4}}$ of the rate. At $t = 0$ the
        computed attitude is correct.

        (a) What is the largest error perpendicular to the axis of rotation, in arc minutes, and
        after what fraction of a turn is it first reached?
        = {circle} Its farthest point is a diameter away, after half a turn; after a whole turn the
        error is zero again.
        2: a circle, or a sine, that returns to zero; 2: the number, and half a turn
        - The rate error multiplied by the time of one turn ({shown(2 * np.pi * radius)}): 0.
        - The radius instead of the diameter ({shown(radius)}): 3.
        > the largest perpendicular error: arc minutes

        (a) The body stops after turning through {stop}°. What is then the error perpendicular to
        the axis of rotation, in arc minutes?
        = {circle} The body has turned through {stop}°, so the error is the chord of this angle,
        $2\cdot{cross}\cdot10^{{-4}}\sin{stop // 2}°$.
        2: a circle, or a sine, that returns to zero; 2: the chord, and the number
        - The rate error multiplied by the time ({shown(radius * np.radians(stop))}): 1.
        > the perpendicular error: arc minutes

        (a) The error perpendicular to the axis of rotation must never exceed {allowed} arc minutes.
        How large may the cross-coupling of the {ORDINALS[other]} gyro be, in parts per million? At
        what moments is the perpendicular error zero?
        = The perpendicular error moves on a circle whose radius is the cross-coupling. The diameter
        must not exceed {allowed}′. The error is zero after each whole turn.
        2: the largest error is twice the cross-coupling, in radians; 1: the number; 1: after each
        whole turn
        - The radius instead of the diameter ({shown(2 * coupling)}): 3.
        > the cross-coupling: ppm

        (b) Write down the linear differential equation of the small attitude error $\varphi(t)$ in
        body axes, and explain each of its terms.
        = $\dot\varphi = -\omega\times\varphi + M\omega$. The first term appears because the body
        axes rotate; the second is the error of the measured rate.
        2: the term of the rotation, with its sign; 1: the error of the measured rate, $M\omega$
        - $+\omega\times\varphi$: 1.
        - No term of the rotation, so that every error grows with time: 1.

        (b) What is the error along the axis of rotation after {turns} whole turns, in arc minutes,
        with its sign?
        = The rotation does not affect an error along its axis, which is therefore the angle turned
        times the scale-factor error, $2\pi\cdot{turns}\cdot({scale}\cdot10^{{-4}})$.
        2: the angle turned times the scale-factor error; 1: the number, with sign and unit
        - In degrees ({shown(along / 60)}°) or radians, otherwise right: 2.
        > the error along the axis: arc minutes

        (b) The error along the axis of rotation must stay within {allowed} arc minutes for {turns}
        whole turns. What is the largest scale-factor error that the gyro on this axis may have, in
        parts per million?
        = The error is the angle turned, $2\pi\cdot{turns}$, times the scale-factor error. The rate
        does not matter.
        2: the angle turned times the scale-factor error, in radians; 1: the number
        - A result that depends on the rate: 1.
        > the scale-factor error: ppm
        """,
        [across, stopped, coupling, along, needed],
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
    length = float(np.linalg.norm(measured))
    slow = float(exact_roots(omega, measured)[2].imag)
    first_order = float(size * drift_coefficient(omega, error_matrix))
    minutes = 10 / abs(slow) / 60  # the rates of this question are in deg/s
    trimmed = -1e3 * error_matrix[row, column] * omega[column] / omega[row]
    place = f"{row + 1}{row + 1}"
    lengths = rf"$|\omega| = {size}°$/s and $|\hat\omega| = |A\omega| = {length:.6f}°$/s"
    return question(
        draw,
        rf"""
        02, 7 minutes: Fast and slow
        find the speeds at which an attitude error moves

        A triad measures $\hat\omega = A\omega$ with $A = I + M$ and $M =
        {matrix(1e3 * error_matrix)}\cdot10^{{-3}}$. It rotates at $\omega =
        ({", ".join(map(str, triple))})$ degrees per second. The roots of the characteristic
        equation of its attitude error are $\pm i(|\hat\omega| + |\omega|)$, the fast pair, and $\pm
        i(|\hat\omega| - |\omega|)$, the slow pair.

        (a) What is $|\hat\omega| - |\omega|$ exactly, in degrees per second? Give four significant
        digits.
        = {lengths}.
        1: $\hat\omega = A\omega$, row by row; 2: the number, with its sign
        - Rounded too early, so that only one digit is right: 2.
        > the exact difference: °/s: 4

        (a) The computer integrates the measured rate while the body makes one whole turn. By how
        many arc minutes does the angle that it finds exceed 360°? (Give a negative number if the
        angle is smaller.)
        = {lengths}. One turn takes $360°/|\omega|$, and the computer finds the angle $|\hat\omega|$
        times this time.
        1: $\hat\omega = A\omega$, row by row; 1: the difference of the magnitudes, times the time
        of one turn; 1: the number, with its sign
        - By first order, $2\pi\,n^TMn$ ({shown(21600 * first_order / size)}): 2.
        > the excess of the angle: arc minutes

        (a) All three measured rates are multiplied by the same number $s$, chosen so that the slow
        pair of roots is exactly zero at this rate. What is $s - 1$, in parts per million?
        = {lengths}. The roots are zero if both magnitudes are equal, so $s =
        |\omega|/|\hat\omega|$.
        1: equal magnitudes; 1: $\hat\omega = A\omega$, row by row; 1: the number, with its sign
        - By first order, $-n^TMn$ ({shown(-1e6 * first_order / size)}): 2.
        > $s - 1$: ppm

        (b) Find the first-order approximation of $|\hat\omega| - |\omega|$, which is
        $|\omega|\,\rho$ with $\rho = n^TMn$, in degrees per second.
        = $\rho = {shown(first_order / size)}$. The remaining difference is of second order in $M$.
        2: $\rho$ with a *unit* vector $n$; 1: the number
        - $\omega^TM\omega$, not divided by anything ({shown(first_order * size)}): 1.
        > the difference to first order: °/s: 4

        (b) The attitude error starts from zero and is observed once per turn. After how many
        minutes has it reached ten degrees?
        = Once per turn only the slow motion is seen: a steady rotation at the rate $|\hat\omega| -
        |\omega|$.
        2: the slow root is the rate of a steady rotation; 1: the number
        - Half the root taken as the rate ({shown(2 * minutes)}): 2.
        > the time: minutes

        (b) The entry {place} of $M$ can be adjusted. To what value, in units of $10^{{-3}}$, must
        it be set so that the triad does not drift about this axis to first order?
        = $\omega^TM\omega = 0$: two terms remain, and the adjusted one must cancel the other.
        2: $n^TMn = 0$, with both terms; 1: the number, with its sign
        - Set to zero, as if the other entry caused no drift: 0.
        > the entry {place}: $\cdot10^{{-3}}$
        """,
        [slow, 21600 * slow / size, 1e6 * (size / length - 1), first_order, minutes, trimmed],
    )


def worst_axis(draw: Generator) -> Question:
    """Chapter 03: which part of a matrix drifts, and about which axis most."""
    i, j = sorted(draw.permutation(3)[:2].tolist())
    k = 3 - i - j
    skew = int(draw.choice([-1, 1]) * draw.integers(6, 20))
    mean = int(draw.choice([-1, 1]) * draw.integers(25, 50))
    scale = int(draw.choice([-1, 1]) * draw.integers(8, 20))
    tilt = np.radians(draw.integers(25, 66))
    entries = np.zeros((3, 3))
    entries[i, j], entries[j, i], entries[k, k] = mean + skew, mean - skew, scale
    coefficients, axes = principal_drifts(entries * ARCSEC)
    drifts = 2 * np.pi * coefficients / ARCSEC
    largest = int(np.argmax(drifts))
    mean_drift = float(np.mean(drifts))
    bisector, diagonal = (
        float(2 * np.pi * drift_coefficient(n, entries))
        for n in (np.eye(3)[i] + np.eye(3)[j], np.ones(3))
    )
    wanted = int(np.round(2 * np.pi * scale * np.sin(tilt) ** 2))
    found = float(np.degrees(np.arcsin(np.sqrt(wanted / (2 * np.pi * scale)))))
    names = [", ".join(shown(x) for x in axis) for axis in axes]
    return question(
        draw,
        rf"""
        03, 10 minutes: The worst axis
        find the worst axis of any triad

        The error matrix of a triad is $M = {matrix(entries)}$ arc seconds.

        (a) About which axis is the drift per turn most positive, and how large is it there, in arc
        seconds?
        = About an eigenvector of the symmetric part. Its eigenvalues are $\pm{abs(mean)}''$ and
        ${scale}''$; the largest belongs to $\pm({names[largest]})$.
        2: an eigenvector of the symmetric part; 1: the axis; 1: the number
        - The largest entry of $M$, times $2\pi$: 1.
        - The axis of the most negative drift, with its number: 3.
        > the largest drift per turn: arc seconds

        (a) The triad turns about an axis in the plane of axes {i + 1} and {k + 1}. At what angle
        from axis {i + 1} (between 0° and 90°) is the drift per turn {plain(wanted)} arc seconds?
        = With $\alpha$ for the angle, the drift is $2\pi\,n^TMn$, to which only the ${scale}''$
        contribute: $2\pi\cdot({scale}'')\sin^2\alpha$.
        2: $2\pi\,n^TMn$ with a unit vector $n$; 1: $\sin^2\alpha$ times the scale-factor error; 1:
        the number
        - The angle from axis {k + 1} ({shown(90 - found)}°): 3.
        > the angle from axis {i + 1}: degrees

        (a) The triad turns about axes in the plane of axes {i + 1} and {j + 1}. About which of them
        does it not drift, to first order, and how large is the drift per turn about the bisector of
        the positive axes {i + 1} and {j + 1}, in arc seconds?
        = In this plane $n^TMn = 2\cdot({mean}'')\,n_{i + 1}n_{j + 1}$, which is zero about axes
        {i + 1} and {j + 1} themselves. On the bisector both components are $1/\sqrt2$.
        1: about the two axes themselves; 2: $2\pi\,n^TMn$ with a unit vector $n$; 1: the number
        - The bisector not normalised ({shown(2 * bisector)}): 3.
        > the drift about the bisector: arc seconds

        (b) Which part of $M$ does not contribute to the drift, to first order? Separate it from the
        rest, giving the entries of both parts, and explain in one sentence why it causes no drift.
        = The skew-symmetric part, with $\pm{abs(skew)}''$ in the two off-diagonal places. It gives
        $n^TMn = 0$: it rotates the triad as a whole, and the error is the same again after each
        turn. The symmetric part keeps ${mean}''$ there and ${scale}''$ on the diagonal.
        2: both parts; 1: a reason: $n^TMn = 0$, or a triad that is rotated as a whole
        - Sum and difference of the entries, not halved: 2.
        > the skew entry, by magnitude,: arc seconds | the symmetric off-diagonal entry: arc seconds

        (b) How large is the drift per turn about the diagonal $(1, 1, 1)$, in arc seconds?
        = $2\pi\,n^TMn$ with a unit vector $n$: a third of the sum of all entries, times $2\pi$.
        2: $2\pi\,n^TMn$ with a unit vector $n$; 1: the number
        - The diagonal not normalised ({shown(3 * diagonal)}): 2.
        > the drift about the diagonal: arc seconds

        (b) What is the average over all axes of the drift per turn, in arc seconds, taking its sign
        into account?
        = Averaged over all directions $n_i^2$ is 1/3 and $n_in_j$ is zero, so the average is $2\pi$
        times a third of the trace.
        2: only the diagonal contributes, with a factor of one third; 1: the number
        - The trace without the third ({shown(3 * mean_drift)}): 2.
        > the average drift per turn: arc seconds
        """,
        [drifts[largest], found, bisector, abs(skew), mean, diagonal, mean_drift],
    )


def table_on_the_earth(draw: Generator) -> Question:
    """Chapter 05: runs in both directions, on a table that the Earth carries."""
    degrees = int(draw.integers(35, 66))
    south = bool(draw.integers(2))
    latitude = np.radians(-degrees if south else degrees)
    rate = int(draw.choice([8, 10, 12, 15, 20]))
    faster = int(draw.choice([25, 30, 40, 50]))
    turns = int(draw.integers(2, 6))
    true = float(draw.choice([-1, 1]) * draw.integers(15, 60))
    bias = float(draw.choice([-1, 1]) * draw.integers(4, 12)) * ARCSEC  # deg/h is arcsec/s
    change = float(draw.choice([1.5, 2, 2.5, 3, 4]))
    noise = float(draw.choice([1.2, 1.5, 2.0, 2.4, 3.0]))
    offset = float(earth_rate_offset(latitude, np.radians(rate))) / ARCSEC
    both = offset + bias / np.radians(rate) / ARCSEC
    readings = [round(true + both, 1), round(true - both, 1)]
    found, half = float(np.mean(readings)), (readings[0] - readings[1]) / 2
    turning = half * ARCSEC * rate * 3600  # deg/h: Earth and bias
    by_bias = turning - np.degrees(EARTH_RATE) * 3600 * np.sin(latitude)
    by_cosine = offset / np.tan(latitude)
    part, of_mean = half * rate / faster, noise / np.sqrt(2)
    drifted = change / np.radians(rate) / 2
    return question(
        draw,
        rf"""
        05, 11 minutes: A table on the Earth
        say what the Earth's rate, a gyro bias and a scale factor do to the result

        At latitude {degrees}° {"South" if south else "North"} a triad is mounted on a table with a
        vertical axis; the axis $n$ of the body points up. Seen from above, {turns} whole turns
        counter-clockwise at {rate}°/s give the estimate ${readings[0]}''$ of $n^T\Sigma n$: the
        error angle about $n$ divided by the angle turned. The same number of turns clockwise,
        counted about their own direction of rotation, give ${readings[1]}''$. The gyros may have
        biases; the Earth turns at $U$ = 15.04°/h.

        (a) Find $n^T\Sigma n$, in arc seconds, and the bias of the triad along $n$, in degrees per
        hour.
        = The Earth and the bias cancel in the mean of both estimates. Half the difference,
        ${shown(half)}''$, is the rate of Earth and bias together divided by the rate of the table.
        Multiply by the rate of the table, then subtract $U\sin\varphi$.
        2: the mean; 1: half the difference, times the rate of the table; 1: minus the Earth, in °/h
        - The Earth left in the bias ({shown(turning)} °/h): 3.
        - One estimate, corrected for the Earth alone, given as the result: 1.
        > $n^T\Sigma n$: arc seconds | the bias along $n$: °/h

        (a) The runs are repeated at {faster}°/s. Predict both estimates, counter-clockwise and
        clockwise, in arc seconds.
        = The mean, ${shown(found)}''$, does not depend on the rate of the table. Half the
        difference, ${shown(half)}''$, is due to the Earth and the bias and is inversely
        proportional to this rate.
        2: the mean stays; 1: half the difference, times {rate}/{faster}; 1: both numbers
        - Twice {rate}/{faster}, from the whole difference: 3.
        > counter-clockwise: arc seconds | clockwise: arc seconds

        (a) Suppose, in this part only, that the bias along $n$ increased by {change:g}°/h between
        the first run and the second. What then is $n^T\Sigma n$, in arc seconds?
        = In the mean of both estimates, ${shown(found)}''$, the Earth and the old bias cancel. Half
        the increase of the bias is left, divided by the rate of the table, with a minus sign.
        2: the mean; 1: half the increase, divided by the rate of the table; 1: the number
        - The correction with the wrong sign ({shown(found - drifted)}): 3.
        - The whole increase ({shown(found + 2 * drifted)}): 3.
        > $n^T\Sigma n$, after the change of bias,: arc seconds

        (b) How much does the Earth contribute to the first estimate, in arc seconds, with its sign?
        = The vertical component of its rate divided by the rate of the table, $U\sin\varphi/w$,
        whatever the number of turns.
        1: the vertical component, $U\sin\varphi$; 1: divided by the rate of the table; 1: the
        number, with the sign of the hemisphere
        - Cosine instead of sine ({shown(by_cosine)}): 2.
        - Also divided by the {turns} turns ({shown(offset / turns)}): 2.
        > the contribution of the Earth: arc seconds

        (b) Each estimate has a standard deviation of ${noise}''$. What is the standard deviation of
        the mean of both? Name one fault of the table that this number does not include.
        = The mean of two: divide by $\sqrt2$. It does not include an error that is the same in both
        directions. A table that turns too far by the same fraction each time looks like a
        scale-factor error; a table axis that leans looks like another axis $n$.
        1: the number; 2: a fault that is the same in both directions
        - The two standard deviations added, or one of them kept ({noise}): 0 for the number.
        > the standard deviation: arc seconds

        (b) A colleague makes only the counter-clockwise run and corrects it for the Earth. What
        error of $n^T\Sigma n$ remains, in arc seconds, with its sign, if the bias was the same in
        both runs? What would halve it?
        = The bias divided by the rate of the table: half the difference of the two estimates, minus
        the contribution of the Earth. A table that is twice as fast halves it; more turns do not.
        1: the bias divided by the rate of the table; 1: the number; 1: a faster table
        - More turns: 0 for the last mark.
        > the error of one direction: arc seconds
        """,
        [
            found,
            by_bias,
            found + part,
            found - part,
            found + drifted,
            offset,
            of_mean,
            half - offset,
        ],
    )
