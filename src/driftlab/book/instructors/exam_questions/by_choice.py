"""Questions on the chapters that not every course has: 05, 06, 08 and 13."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator
from scipy.constants import hour

from driftlab.attitude.cayley import cayley_vector, shadow
from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.attitude.integration import step_rotation_vectors
from driftlab.calibration.kalman import correct, predict
from driftlab.quaternion import from_rotation_vector

from .question import Question, plain, question, shown
from .turns import ARCSEC


def cayley_vectors(draw: Generator) -> Question:
    """Chapter 06: two vectors of one rotation, the shadow, and where they become infinite."""
    angle = int(draw.choice([100, 110, 130, 140, 160, 200, 220, 230, 250, 260]))
    more = int(draw.choice([25, 35, 45]))
    rate = int(draw.choice([8, 12, 16, 24, 30]))
    length, known = draw.choice([0.3, 0.4, 0.5, 0.6, 0.7]), draw.choice([0.8, 1.5, 2, 2.5, 3])
    axis = np.zeros(3)
    axis[draw.permutation(3)[:2]] = draw.choice([-1, 1], 2) * np.array([0.6, 0.8])
    first_of = int(draw.choice(np.flatnonzero(axis)))
    name = f"component {first_of + 1}"

    def vector(degrees: float, dimension: int) -> float:
        turned = from_rotation_vector(np.radians(degrees) * axis)
        return float(cayley_vector(turned, dimension)[first_of])

    both = [vector(each, dimension) for each in (angle, angle + more) for dimension in (3, 4)]
    four = cayley_vector(from_rotation_vector(np.radians(angle) * axis), 4)
    back = -4 * float(np.degrees(np.arctan(length)))
    shorter = float(np.tan(np.arctan(known) / 2))
    return question(
        draw,
        rf"""
        06, 12 minutes: A rotation without a sine
        turn a rotation into a Cayley vector of dimension 3 or 4

        A body is rotated by {angle}° about the axis $e = ({", ".join(f"{x:g}" for x in axis)})$.
        The Cayley vectors of a rotation are $-\tan(\varphi/2)\,e$ in dimension 3 and
        $-\tan(\varphi/4)\,e$ in dimension 4.

        (a) Give {name} of its Cayley vector of dimension 3 and of that of dimension 4.
        = $e_{first_of + 1} = {axis[first_of]:g}$.
        1: dimension 3; 1: dimension 4
        - The two dimensions exchanged, or the minus missing: 1.
        > in dimension 3 | in dimension 4

        (a) The body turns through another {more}° about the same axis. Give {name} of both Cayley
        vectors of its new attitude, of dimension 3 and of dimension 4.
        = The angle is now {angle + more}°; $e_{first_of + 1} = {axis[first_of]:g}$.
        1: dimension 3; 1: dimension 4
        - The vectors of both rotations added: 0.
        > in dimension 3, after both rotations, | in dimension 4, after both rotations,

        (a) A rotation about the same axis has the Cayley vector ${known:g}\,e$ of dimension 3. By
        what factor must $e$ be multiplied to give its Cayley vector of dimension 4?
        = The angle is ${shown(float(-2 * np.degrees(np.arctan(known))))}°$.
        1: the angle of the rotation, or a formula for half of an angle; 1: the factor, with its
        sign
        - Half of {known:g}: 0.
        > the factor

        (b) Give {name} of the shadow of the Cayley vector of dimension 4 of the rotation by
        {angle}°. To which angle about the same axis does the shadow belong, and when would you
        switch to it?
        = $-k/|k|^2$. It belongs to {angle}° − 360° = {plain(angle - 360)}°, the same attitude
        reached the other way round. One switches when $|k| > 1$, that is, beyond half a turn; here
        $|k| = {shown(float(np.linalg.norm(four)))}$.
        1: the shadow; 1: its angle; 2: at length one, or half a turn
        - The shadow without its minus: 0 for the first mark.
        - The angle {360 - angle}° about the reversed axis: nothing lost.
        > the component of the shadow | its angle: degrees

        (b) In another motion the body starts from zero and turns about this axis at {rate}°/s.
        After how many seconds does each of the two vectors first become infinite?
        = After half a turn in dimension 3, after a whole turn in dimension 4.
        2: half a turn for dimension 3; 2: a whole turn for dimension 4
        - A quarter of a turn and half a turn: 0.
        > the time in dimension 3: s | the time in dimension 4: s

        (b) A rotation about the same axis has the Cayley vector ${length:g}\,e$ of dimension 4.
        Through what angle about $e$ does it turn the body, with its sign?
        = $\tan(\varphi/4) = -{length:g}$: a rotation in the opposite direction.
        2: four times the arc tangent; 1: the number; 1: its sign
        - By the formula of dimension 3 ({shown(back / 2)}°): 2.
        > the angle: degrees
        """,
        [*both, shorter, shadow(four)[first_of], angle - 360, 180 / rate, 360 / rate, back],
    )


def coning_step(draw: Generator) -> Question:
    """Chapter 07: one step with a coning correction, and the drift without."""
    one, two = np.array([draw.permutation([-3, -2, -1, 1, 2, 3, 4])[:3] for _ in range(2)])
    while not np.cross(one, two).all():
        two = draw.permutation([-3, -2, -1, 1, 2, 3, 4])[:3]
    increments = 0.01 * np.array([one, two], dtype=float)
    half_angle, frequency = float(draw.choice([0.5, 0.8, 1.2, 1.5])), int(draw.integers(8, 26))
    samples = int(draw.choice([100, 200, 400]))
    allowed = float(draw.choice([0.5, 1.0, 2.0, 5.0]))
    correction, reverse = (
        1e4 * (step_rotation_vectors(each, "rotation-vector-2")[0] - increments.sum(axis=0))
        for each in (increments, increments[::-1])
    )
    size = float(np.linalg.norm(correction)) * 1e-4 / ARCSEC
    cone = np.radians(half_angle), frequency
    drift, halved = (
        float(coning_drift("picard-1", *cone, 1 / rate)) / np.radians(1) * hour
        for rate in (samples, 2 * samples)
    )
    turn = 2 * np.pi * frequency / samples
    rows = [f"$({', '.join(map(str, row))})$" for row in (one, two)]
    narrow = float(half_angle * np.sqrt(allowed / abs(drift)))
    unreduced = drift / (1 - np.sin(turn) / turn)
    return question(
        draw,
        rf"""
        07, 12 minutes: A step on a cone
        predict the drift on a coning motion from a closed formula

        Two successive angle increments are $\gamma_1 =$ {rows[0]} and $\gamma_2 =$ {rows[1]}
        hundredths of a radian. In (b) an axis describes a cone with a half angle of {half_angle}°,
        {frequency} times per second, and the gyros are read {samples} times per second. An
        algorithm that adds the increments without a coning correction has a drift of magnitude
        $\tfrac12\beta^2\Omega\,(1 - \sin x/x)$, where $\beta$ is the half angle, $\Omega$ the rate
        around the cone and $x$ the angle around the cone between two samples.

        (a) Give the coning correction of the two-sample algorithm of fourth order for these
        increments: three components, in units of 0.0001 rad.
        = $\tfrac23\,\gamma_1\times\gamma_2$.
        1: the factor; 1: the cross product, in this order; 1: three numbers
        - $\gamma_2\times\gamma_1$, so that all signs are reversed: 2.
        - The factor 1/2 (one product of the whole series): 2.
        > component 1: · 0.0001 rad | component 2: · 0.0001 rad | component 3: · 0.0001 rad

        (a) The two increments are added without a coning correction. Through what angle, in arc
        seconds, is the attitude wrong after this step, according to the two-sample algorithm of
        fourth order?
        = The magnitude of the missing correction, $\tfrac23\,|\gamma_1\times\gamma_2|$.
        1: the factor; 1: the cross product; 1: its magnitude, in arc seconds
        - The factor 1/2 (one product of the whole series): 2.
        > the angle: arc seconds

        (a) The same two increments could also occur in reverse order. By what vector does the
        rotation vector of the step, by the two-sample algorithm of fourth order, differ between the
        two cases ($\gamma_1$ first minus $\gamma_2$ first)? Give three components, in units of
        0.0001 rad.
        = The sum is the same and the correction $\tfrac23\,\gamma_1\times\gamma_2$ changes its
        sign, so the difference is $\tfrac43\,\gamma_1\times\gamma_2$.
        1: the factor; 1: the cross product, in this order; 1: three numbers
        - One correction instead of two: 2.
        > component 1 of the difference: · 0.0001 rad | component 2: · 0.0001 rad |
        component 3: · 0.0001 rad

        (b) What is the drift of this algorithm, in °/h, and does the computed attitude run ahead of
        the motion or lag behind it?
        = $\Omega = {shown(2 * np.pi * frequency)}$ rad/s and $x = {shown(turn)}$ rad. The computed
        attitude lags behind.
        1: $\Omega$ and $x$, in radians; 1: the number; 1: it lags behind
        - $\tfrac12\beta^2\Omega$ alone ({shown(abs(unreduced))}), as if the gyros sensed nothing of
        the cone: 1.
        > the drift, by magnitude,: °/h

        (b) By what factor does the drift decrease if the gyros are read twice as often? Name a
        motion on which this algorithm has no error at all, so that a test with it proves nothing.
        = The bracket is $x^2/6$ for small $x$, so the factor is nearly 4. A rotation about a fixed
        axis needs no correction.
        1: about four; 2: a fixed axis, or another motion without coning
        - Two, because there are twice as many samples: 0 for the first mark.
        > the factor

        (b) What half angle of the cone, in degrees, would keep the drift at {plain(allowed)} °/h?
        By what factor does the drift change if the half angle is halved?
        = The drift is proportional to $\beta^2$: half the angle gives a quarter of the drift.
        1: solved for $\beta$; 1: the number; 1: a quarter
        - The drift taken as proportional to the angle: 1.
        > the half angle: degrees
        """,
        [*correction, size, *(correction - reverse), abs(drift), drift / halved, narrow],
    )


def calibration_step(draw: Generator) -> Question:
    """Chapter 11: one step of a Kalman filter with two states, by hand."""
    angle, bias = float(draw.integers(2, 6)), float(draw.integers(2, 6))
    time = float(draw.choice([2.0, 3.0]))
    noise = float(draw.integers(3, 8))
    kept = float(draw.choice([0.8, 0.9]))
    prior = np.diag([angle**2, bias**2])
    before, longer = (
        predict(prior, np.array([[1.0, each], [0.0, 1.0]]), np.zeros((2, 2)))
        for each in (time, 2 * time)
    )
    nis = 4.0
    while abs(nis - 4) < 0.5:  # or rounding would decide what to think of it
        measured = float(draw.choice([-1, 1]) * draw.integers(6, 20))
        update = correct(before, [measured], [[1.0, 0.0]], [[noise**2]])
        nis = float(update.nis)
    later = np.sqrt(correct(longer, [measured], [[1.0, 0.0]], [[noise**2]]).covariance[1, 1])
    after = np.sqrt(np.diag(update.covariance))
    gains = before[:, 0] / (before[0, 0] + noise**2)
    # The variance of the innovation with which the bias keeps this part of its deviation.
    needed = before[0, 1] ** 2 / (bias**2 * (1 - kept**2))
    wished, spread = np.sqrt([needed - before[0, 0], before[0, 0]])
    uncoupled = measured * bias**2 / (bias**2 + noise**2)
    believed = "larger than" if update.nis > 4 else "consistent with"
    gain = rf"""The gain is the column of covariances with the measured quantity, divided by
            $S = {before[0, 0] + noise**2:g}$ (in ″²)."""
    return question(
        draw,
        rf"""
        11, 12 minutes: One step of a filter
        write one step of a Kalman filter in ten lines

        A filter has two states, an angle (standard deviation {angle:g}″) and the bias of the gyro
        that measures it ({bias:g}″/min), uncorrelated; both estimates are zero. {time:g} minutes
        pass, in which the gyro adds no noise. Then the angle is measured as {plain(measured)}″ with
        a standard deviation of {noise:g}″.

        (a) What are the filter's estimates of the angle and of the bias after the measurement, and
        what is the standard deviation of the bias?
        = {gain} The bias changes although only the angle was measured, because the two have become
        correlated.
        1: $S$, with the noise included; 1: both estimates; 1: the standard deviation
        - The bias left at zero because it was not measured: 1 at most.
        - The bias corrected as if it had been measured ({shown(uncoupled)}): 1.
        > the angle: ″ | the bias: ″/min | the standard deviation of the bias: ″/min

        (a) With what gains does the measurement correct the angle and the bias, and what is the
        standard deviation of the angle afterwards?
        = {gain} The variance of the angle is multiplied by 1 minus its gain.
        1: $S$, with the noise included; 1: both gains; 1: the standard deviation
        - The noise left out of $S$, so that the first gain is 1: 1.
        > the gain of the angle | the gain of the bias: /min | the standard deviation of the angle:
        ″

        (a) What standard deviation of the measurement, instead of {noise:g}″, would leave the bias
        with a standard deviation of exactly {plain(kept * bias)}″/min?
        = The variance of the bias falls by $P_{{12}}^2/S$ with $P_{{12}} = {before[0, 1]:g}$ (in
        ″²/min), which gives $S = {shown(needed)}$. The variance of the angle, {before[0, 0]:g} (in
        ″²), is part of it; the rest is the noise.
        1: the decrease of the variance, $P_{{12}}^2/S$; 1: solved for $S$; 1: the number
        - The variance of the angle not subtracted ({shown(float(np.sqrt(needed)))}): 2.
        > the standard deviation needed: ″

        (b) What is the standard deviation of the angle just before the measurement, and what is its
        covariance with the bias then?
        = $\Phi P\Phi^T$ with $\Phi = \begin{{pmatrix}}1 & T\\ 0 & 1\end{{pmatrix}}$: the angle has
        its own variance plus $T^2$ times that of the bias; the covariance is $T$ times the variance
        of the bias.
        2: the standard deviation; 1: the covariance
        - Standard deviations added ({shown(angle + time * bias)}): 0 for the first two marks.
        > the standard deviation before: ″ | the covariance: ″²/min

        (b) How large is the normalised innovation squared (NIS)? Does it give reason to doubt the
        filter, and what does a single good NIS not prove?
        = The innovation divided by its own standard deviation, squared. It is {believed} what is
        expected of one component: one on average, and above four once in twenty times. A good NIS
        does not prove that what the measurement cannot see is right.
        1: the number; 1: compared with one; 1: what is unseen remains unproved
        - The innovation divided by the noise alone, squared ({shown((measured / noise) ** 2)}): 0
        for the first mark.
        > the NIS

        (b) To what standard deviation would the bias be known if {2 * time:g} minutes had passed
        before the same measurement, and why?
        = $\Phi P\Phi^T$ with twice the time: more of the angle is due to the bias, the correlation
        is closer, and the same measurement says more about the bias.
        2: the number; 1: a closer correlation
        - Half the standard deviation because of twice the time: 0.
        > the later standard deviation of the bias: ″/min
        """,
        [*update.correction, after[1], *gains, after[0], wished, spread, before[0, 1], nis, later],
    )


def turned_by_hand(draw: Generator) -> Question:
    """Chapter 17: whole turns by hand in both directions, and an Allan plot."""
    turns = int(draw.choice([5, 10]))
    seconds = int(draw.choice([30, 40, 50, 60]))
    number = float(draw.choice([-1, 1]) * draw.integers(20, 90)) * 1e-4
    offset = float(draw.choice([-1, 1]) * draw.integers(3, 20)) * 0.01
    stop = float(draw.choice([0.5, 0.8, 1.0, 1.5]))
    wanted = float(draw.choice([1, 2, 4])) * 1e-4
    short, deviation = int(draw.choice([1, 4, 9])), float(draw.integers(9, 30))
    long = int(draw.choice([400, 900, 1600]))
    more, longer = int(draw.integers(12, 20)), int(draw.integers(7, 13)) * 10
    walk = deviation * np.sqrt(short) / 60  # deg/√h
    by_noise = deviation * np.sqrt(short / long)
    seen = float(np.round(by_noise * float(draw.choice([5, 6, 8])), 1))
    angles = [round(sense * 360 * turns * (1 + number) + offset * seconds, 1) for sense in (1, -1)]
    found = (angles[0] - angles[1]) / (720 * turns) - 1
    found_offset = sum(angles) / (2 * seconds)
    rest = round(found_offset * 100, 1)
    predicted = 360 * more * (1 + found) + found_offset * longer
    with_rest = (angles[0] - rest * seconds / 100) / (360 * turns) - 1
    half = stop / np.sqrt(2) / (360 * turns)
    many = stop / np.sqrt(2) / (360 * wanted)
    return question(
        draw,
        rf"""
        17, 12 minutes: Turned by hand
        calibrate a gyro by turning it with your hands

        Somebody turns a phone about its axis {turns} whole times in {seconds} seconds; its gyro
        adds up to {plain(angles[0])}°. The same number of turns back, in the same time, give
        {plain(angles[1])}°.

        (a) Find Larin's number, the fraction by which the gyro reads too much along its axis, and
        the offset in °/s. What contributes to the offset?
        = Half the difference divided by the true angle, minus one; half the sum divided by the
        time. The bias of the gyro contributes, and the Earth, up to 0.004°/s.
        1: Larin's number; 1: the offset; 1: bias and Earth
        - One direction alone ({shown(angles[0] / (360 * turns) - 1)}): 1 for both numbers.
        > Larin's number | the offset: °/s

        (a) The phone is then turned {more} times in the first direction, in {longer} seconds.
        Predict the angle that its gyro adds up to, in degrees, to one decimal.
        = Half the difference of the two readings belongs to {turns} turns and is proportional to
        the number of turns. Half the sum belongs to {seconds} seconds and is proportional to the
        time.
        1: half the difference, for {more} turns; 1: half the sum, for {longer} seconds; 1: the
        number
        - The first reading times {more}/{turns} ({shown(angles[0] * more / turns, 5)}): 1.
        > the predicted angle: °: 5

        (a) The run back was not saved. But at rest, in the same place, the gyro adds up to
        {plain(rest)}° in 100 seconds. Find Larin's number, the fraction by which the gyro reads too
        much along its axis, from this and the first run. Why is the rest needed?
        = At rest the gyro shows its bias and the Earth. They add to the angle in proportion to the
        time: subtract {seconds}/100 of {plain(rest)}° from the first reading, divide by the true
        angle, subtract one.
        1: the rest, for {seconds} seconds; 1: the number; 1: bias and Earth
        - The rest ignored ({shown(angles[0] / (360 * turns) - 1)}): 0.
        > Larin's number, with the rest,

        (b) The final position of a run is met to {stop}° (one standard deviation). What is then the
        standard deviation of Larin's number from two runs in opposite directions, and how would you
        halve it without a better stop?
        = Half the difference of two runs has the standard deviation of one run divided by $\sqrt2$;
        divide it by the angle turned. Twice as many turns per run halve it; so do four times as
        many runs.
        1: the number; 2: more turns per run, or four times the runs
        - Twice as many runs: 0 for the last two marks, as this gives a factor of $\sqrt2$.
        > the standard deviation

        (b) At rest, the Allan deviation of the gyro is {deviation:g}°/h at {short} s, where it
        falls with the square root of the time. What is the angle random walk, in °/√h? What Allan
        deviation would white noise alone leave at {long} s, and what do you conclude from the
        {seen}°/h that are observed there?
        = $\sigma(\tau) = N/\sqrt\tau$; with $\tau$ in hours $N$ is in °/√h. There is more than
        white noise: bias instability or a random walk of the bias, and averaging for so long does
        not help.
        1: $N$ in its unit; 1: white noise at the long time; 1: the conclusion
        - $N$ with $\tau$ left in seconds ({shown(60 * walk)}): 0 for it.
        > the angle random walk: °/√h | white noise alone: °/h

        (b) The final position of a run is met to {stop}° (one standard deviation). How many whole
        turns must a run have so that two runs in opposite directions give Larin's number to
        {shown(wanted, 1)} (one standard deviation)? Why do more samples per second not help?
        = The standard deviation is {stop}° divided by $\sqrt2$ and by the angle turned. It is due
        to the stop and not to the noise of the samples. The number is rounded up.
        2: the number; 1: the stop is the limit
        - Without $\sqrt2$ ({shown(float(many) * 2**0.5)}): 2.
        > the turns, before rounding up,
        """,
        [found, found_offset, predicted, with_rest, half, walk, by_noise, many],
    )
