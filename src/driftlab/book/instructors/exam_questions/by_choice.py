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

from .question import Answer, Part, Question, plain, shown, two_of


def cayley_vectors(draw: Generator) -> Question:
    """Chapter 05: two vectors of one rotation, the shadow, and where they become infinite."""
    angle = int(draw.choice([100, 110, 130, 140, 160, 200, 220, 230, 250, 260]))
    rate = int(draw.choice([8, 12, 16, 24, 30]))
    length = float(draw.choice([0.3, 0.4, 0.5, 0.6, 0.7]))
    pair = draw.permutation(3)[:2]
    signs = draw.choice([-1, 1], 2)
    axis = np.zeros(3)
    axis[pair] = signs * np.array([0.6, 0.8])
    quaternion = from_rotation_vector(np.radians(angle) * axis)
    three, four = (cayley_vector(quaternion, dimension) for dimension in (3, 4))
    first = pair[0]
    other = shadow(four)
    back = -4 * float(np.degrees(np.arctan(length)))
    return Question(
        "A rotation without a sine",
        "05",
        "turn a rotation into a Cayley vector of dimension 3 or 4",
        12,
        f"A body is turned by {angle}° about the axis $e = ({', '.join(f'{x:g}' for x in axis)})$. "
        r"Cayley vectors are $-\tan(\varphi/2)\,e$ in dimension 3 and $-\tan(\varphi/4)\,e$ in "
        "dimension 4.",
        two_of(
            draw,
            Part(
                f"Give the component {first + 1} of its Cayley vector of dimension 3, and that of "
                "dimension 4.",
                rf"$-\tan(\varphi/2)\,e$ and $-\tan(\varphi/4)\,e$; $e_{first + 1} = "
                rf"{axis[first]:g}$.",
                (
                    Answer("that of dimension 3", float(three[first])),
                    Answer("that of dimension 4", float(four[first])),
                ),
                ((1, "dimension 3"), (1, "dimension 4")),
                ("The two dimensions exchanged: 1.", "Without the minus: 1."),
            ),
            Part(
                f"Give component {first + 1} of the shadow of the vector of dimension 4. Of which "
                "angle about the same axis is it the vector, and when would you step over to it?",
                rf"$-k/|k|^2$. It is the vector of {angle}° − 360° = {plain(angle - 360)}°, the "
                "same attitude reached the other way round. One steps over when $|k| > 1$, so past "
                "half a turn; here "
                f"$|k| = {shown(float(np.linalg.norm(four)))}$.",
                (
                    Answer("the component of the shadow", float(other[first])),
                    Answer("its angle", float(angle - 360), "degrees"),
                ),
                ((1, "the shadow"), (1, "its angle"), (2, "at length one, half a turn")),
                (
                    "The shadow without its minus: 0 for the first mark, the others stand.",
                    f"The angle given as {360 - angle}° without a sign: nothing off, if the axis "
                    "is said to be reversed.",
                ),
            ),
            Part(
                f"From rest at zero the body turns about this axis at {rate}°/s. After how many "
                "seconds is each of the two vectors infinite for the first time?",
                "At half a turn and at a whole one.",
                (
                    Answer("dimension 3", 180 / rate, "s"),
                    Answer("dimension 4", 360 / rate, "s"),
                ),
                ((2, "half a turn for dimension 3"), (2, "a whole one for dimension 4")),
                ("A quarter and half a turn: 0.",),
            ),
            Part(
                "The vector of dimension 4 of another rotation about the same axis is "
                f"${length:g}\\,e$. By which angle about $e$ does it turn the body, with its sign?",
                r"$\tan(\varphi/4)$ is minus this length: a turn in the other direction.",
                (Answer("the angle", back, "degrees"),),
                ((2, "four times the arc tangent"), (1, "the number"), (1, "its sign")),
                (f"By the formula of dimension 3 ({shown(back / 2)}°): 2.",),
            ),
        ),
    )


def coning_step(draw: Generator) -> Question:
    """Chapter 06: one step with a coning correction, and the drift without."""
    first, second = np.array([draw.permutation([-3, -2, -1, 1, 2, 3, 4])[:3] for _ in range(2)])
    while not np.cross(first, second).all():
        second = draw.permutation([-3, -2, -1, 1, 2, 3, 4])[:3]
    increments = 0.01 * np.array([first, second], dtype=float)
    half_angle, frequency = float(draw.choice([0.5, 0.8, 1.2, 1.5])), int(draw.integers(8, 26))
    samples = int(draw.choice([100, 200, 400]))
    vector = step_rotation_vectors(increments, "rotation-vector-2")[0]
    correction = 1e4 * (vector - increments.sum(axis=0))
    cone = np.radians(half_angle), frequency
    drift, halved = (
        float(coning_drift("picard-1", *cone, 1 / rate)) / np.radians(1) * hour
        for rate in (samples, 2 * samples)
    )
    turn = 2 * np.pi * frequency / samples
    rows = [f"$({', '.join(map(str, row))})$" for row in (first, second)]
    allowed = float(draw.choice([0.5, 1.0, 2.0, 5.0]))
    narrow = half_angle * np.sqrt(allowed / abs(drift))
    unreduced = drift / (1 - np.sin(turn) / turn)
    return Question(
        "A step on a cone",
        "06",
        "predict the drift on a coning motion from a closed formula",
        12,
        rf"Two successive angle increments are $\gamma_1 =$ {rows[0]} and $\gamma_2 =$ {rows[1]} "
        f"hundredths of a radian. In (b) an axis goes round a cone of half angle {half_angle}°, "
        f"{frequency} times a second, and the gyros are read {samples} times a second. An "
        "algorithm that adds up the increments without a correction has a drift of the size "
        r"$\tfrac12\beta^2\Omega\,(1 - \sin x/x)$, with the half angle $\beta$, the rate "
        r"$\Omega$ round the cone and the angle $x$ that is gone round between two samples.",
        two_of(
            draw,
            Part(
                "Give the coning correction of the step of both by the two-sample algorithm of "
                "fourth order: three components, in units of 0.0001 rad.",
                r"$\tfrac23\,\gamma_1\times\gamma_2$; the rotation vector is the sum plus this.",
                tuple(
                    Answer(f"component {i + 1}", float(x), "· 0.0001 rad")
                    for i, x in enumerate(correction)
                ),
                ((1, "the weight"), (1, "the cross product, in this order"), (1, "three numbers")),
                (
                    r"$\gamma_2\times\gamma_1$, all signs reversed: 2.",
                    "The weight 1/2 (one product of the whole series): 2.",
                ),
            ),
            Part(
                "Which drift has this algorithm, in degrees an hour, and does what it computes "
                "run ahead of the motion or lag behind?",
                rf"$\Omega = {shown(2 * np.pi * frequency)}$ rad/s, $x = {shown(turn)}$ rad. What "
                "is computed lags behind the motion.",
                (Answer("the drift, by size,", abs(drift), "°/h"),),
                ((1, r"$\Omega$ and $x$, in radians"), (1, "the number"), (1, "it lags behind")),
                (
                    rf"$\tfrac12\beta^2\Omega$ alone ({shown(abs(unreduced))}), as if nothing of "
                    "the cone were seen: 1.",
                ),
            ),
            Part(
                "By what factor does the drift shrink if the gyros are read twice as often? Which "
                "motion would flatter this algorithm, so that a test with it proves nothing?",
                "The bracket is $x^2/6$ for small $x$, so nearly 4. A turn about a fixed axis "
                "needs no correction at all.",
                (Answer("the factor", drift / halved),),
                ((1, "about four"), (2, "a fixed axis, or another motion without a cone")),
                ("Two, because there are twice as many samples: 0 for the first mark.",),
            ),
            Part(
                f"A drift of {plain(allowed)}°/h would be allowed. How wide may the "
                "cone be then, as its half angle in degrees, and by how much does the drift fall "
                "with half of this angle?",
                r"The drift goes with $\beta^2$: half of the angle is a quarter of the drift.",
                (Answer("the half angle", float(narrow), "degrees"),),
                ((1, r"solved for $\beta$"), (1, "the number"), (1, "a quarter")),
                ("The drift taken as going with the angle: 1.",),
            ),
        ),
    )


def calibration_step(draw: Generator) -> Question:
    """Chapter 08: one step of a Kalman filter with two states, by hand."""
    angle, bias = float(draw.integers(2, 6)), float(draw.integers(2, 6))
    time = float(draw.choice([2.0, 3.0]))
    noise = float(draw.integers(3, 8))
    transition = np.array([[1.0, time], [0.0, 1.0]])
    before = predict(np.diag([angle**2, bias**2]), transition, np.zeros((2, 2)))
    nis = 4.0
    while abs(nis - 4) < 0.5:  # or rounding would decide what to think of it
        measured = float(draw.choice([-1, 1]) * draw.integers(6, 20))
        update = correct(before, [measured], [[1.0, 0.0]], [[noise**2]])
        nis = float(update.nis)
    longer = predict(
        np.diag([angle**2, bias**2]), np.array([[1.0, 2 * time], [0.0, 1.0]]), np.zeros((2, 2))
    )
    later = np.sqrt(correct(longer, [measured], [[1.0, 0.0]], [[noise**2]]).covariance[1, 1])
    after = np.sqrt(np.diag(update.covariance))
    spread = np.sqrt(before[0, 0] + noise**2)
    uncoupled = measured * bias**2 / (bias**2 + noise**2)
    believed = "larger than" if update.nis > 4 else "in keeping with"
    return Question(
        "One step of a filter",
        "08",
        "write one step of a Kalman filter in ten lines",
        12,
        f"A filter has two states, an angle (standard deviation {angle:g}″) and the bias of the "
        f"gyro behind it ({bias:g}″ a minute), uncorrelated; both estimates are zero. "
        f"{time:g} minutes pass, the gyro has no noise. Then the angle is measured: "
        f"{plain(measured)}″, with a standard deviation of {noise:g}″.",
        two_of(
            draw,
            Part(
                "Which estimates has the filter after the measurement, of the angle and of the "
                "bias, and which standard deviation has the bias now?",
                "The gain is the column of covariances with what is measured, over "
                rf"$S = {spread**2:g}$. The bias moves although only the angle was seen, because "
                "the two have become correlated.",
                (
                    Answer("the angle", float(update.correction[0]), "″"),
                    Answer("the bias", float(update.correction[1]), "″ a minute"),
                    Answer("the deviation of the bias", float(after[1]), "″ a minute"),
                ),
                ((1, "$S$, with the noise in it"), (1, "both estimates"), (1, "the deviation")),
                (
                    "The bias left at zero, for it was not measured: 1 of the three at most.",
                    f"The bias corrected as if measured itself ({shown(uncoupled)}): 1.",
                ),
            ),
            Part(
                "Which standard deviation has the angle before it is measured, and which is its "
                "covariance with the bias then?",
                r"$\Phi P\Phi^T$ with $\Phi = " + r"\begin{pmatrix}1 & T\\ 0 & 1\end{pmatrix}$: "
                "the angle has its own variance and $T^2$ times that of the bias; the covariance "
                "is $T$ times that of the bias.",
                (
                    Answer("the deviation of the angle", float(np.sqrt(before[0, 0])), "″"),
                    Answer("the covariance", float(before[0, 1]), "″² a minute"),
                ),
                ((2, "the deviation"), (1, "the covariance")),
                (f"Deviations added ({shown(angle + time * bias)}): 0 for the first two marks.",),
            ),
            Part(
                "How large is the normalised innovation squared (NIS)? Would you believe the "
                "filter, and what does a single good one not prove?",
                f"The innovation in units of its own deviation, squared; it is {believed} what "
                "one expects of one component, one on average and above four once in twenty "
                "times. A good one does not prove that what the measurement cannot see is right.",
                (Answer("the NIS", float(update.nis)),),
                ((1, "the number"), (1, "compared with one"), (1, "what is unseen stays unproved")),
                (
                    "The innovation over the noise alone, squared "
                    f"({shown((measured / noise) ** 2)}): 0 for the first mark.",
                ),
            ),
            Part(
                f"How well would the bias be known if {2 * time:g} minutes had passed before the "
                "same measurement, as a standard deviation, and why?",
                r"$\Phi P\Phi^T$ with twice the time: the angle carries more of the bias, the "
                "correlation is closer, so the same measurement says more about the bias.",
                (Answer("the deviation of the bias, later,", float(later), "″ a minute"),),
                ((2, "the number"), (1, "a closer correlation")),
                ("Half of the deviation, because of twice the time: 0.",),
            ),
        ),
    )


def turned_by_hand(draw: Generator) -> Question:
    """Chapter 13: whole turns by hand in both senses, and an Allan plot."""
    turns = int(draw.choice([5, 10]))
    seconds = int(draw.choice([30, 40, 50, 60]))
    number = float(draw.choice([-1, 1]) * draw.integers(20, 90)) * 1e-4
    offset = float(draw.choice([-1, 1]) * draw.integers(3, 20)) * 0.01
    stop = float(draw.choice([0.5, 0.8, 1.0, 1.5]))
    wanted = float(draw.choice([1, 2, 4])) * 1e-4
    short, deviation = int(draw.choice([1, 4, 9])), float(draw.integers(9, 30))
    long = int(draw.choice([400, 900, 1600]))
    walk = deviation * np.sqrt(short) / 60  # deg/√h
    by_noise = deviation * np.sqrt(short / long)
    seen = float(np.round(by_noise * float(draw.choice([5, 6, 8])), 1))
    angles = [round(sense * 360 * turns * (1 + number) + offset * seconds, 1) for sense in (1, -1)]
    found = (angles[0] - angles[1]) / (720 * turns) - 1
    found_offset = sum(angles) / (2 * seconds)
    half = stop / np.sqrt(2) / (360 * turns)
    many = stop / np.sqrt(2) / (360 * wanted)
    return Question(
        "Turned by hand",
        "13",
        "calibrate a gyro by turning it with your hands",
        12,
        f"Somebody turns a phone {turns} whole times about its axis, in {seconds} seconds; its "
        f"gyro adds up to {plain(angles[0])}°. As many turns back in the same time give "
        f"{plain(angles[1])}°.",
        two_of(
            draw,
            Part(
                "Find Larin's number, the part by which the gyro reads too much along its axis, "
                "and the offset in degrees a second. What is in the offset?",
                "The half difference over the true angle, less one; the half sum over the time. "
                "In it are the bias of the gyro and the Earth, up to 0.004 degrees a second.",
                (
                    Answer("Larin's number", found),
                    Answer("the offset", found_offset, "°/s"),
                ),
                ((1, "the number"), (1, "the offset"), (1, "bias and Earth")),
                (f"One sense alone ({shown(angles[0] / (360 * turns) - 1)}): 1 for both.",),
            ),
            Part(
                f"A stop is met to {stop}° (standard deviation of the angle of one run). Which "
                "standard deviation has Larin's number, and how would you halve it without a "
                "better stop?",
                r"The half difference of two runs has the deviation of one over $\sqrt2$. Twice "
                "as many turns in a run halve it; four times as many runs do, too.",
                (Answer("the standard deviation", half),),
                ((1, "the number"), (2, "more turns in a run, or four times the runs")),
                ("Twice as many runs: 0 for the last two marks, it is the root of two.",),
            ),
            Part(
                f"At rest, the Allan deviation of the gyro is {deviation:g} degrees an hour at "
                f"{short} s, where it falls with the root of the time. How large is the angle "
                f"random walk, in degrees per root hour? What would white noise alone leave at "
                f"{long} s, and what do you conclude from the {seen} degrees an hour that are "
                "seen there?",
                r"$\sigma(\tau) = N/\sqrt\tau$; with $\tau$ in hours $N$ is in degrees per root "
                "hour. There is more than white noise: an instability or a walk of the bias, and "
                "averaging so long does not help.",
                (
                    Answer("the angle random walk", float(walk), "°/√h"),
                    Answer("white noise alone", float(by_noise), "°/h"),
                ),
                ((1, r"$N$ in its unit"), (1, "white noise at the long time"), (1, "conclusion")),
                (rf"$N$ with $\tau$ left in seconds ({shown(60 * walk)}): 0 for its mark.",),
            ),
            Part(
                f"A stop is met to {stop}° (standard deviation of the angle of one run). Of how "
                "many whole turns must a run be, so that two runs in both directions give Larin's "
                f"number to {shown(wanted, 1)}, one standard deviation? Why do more samples a "
                "second not help?",
                r"The stop over $\sqrt2$, over the angle turned, is the deviation; what limits it "
                "is the stop, not the noise of the samples. The number is rounded up.",
                (Answer("the turns, before rounding up,", many),),
                ((2, "the number"), (1, "the stop limits it")),
                (rf"Without $\sqrt2$ ({shown(many * 2**0.5)}): 2.",),
            ),
        ),
    )
