"""A question on Part III: an error matrix taken apart, and what navigation can find of it."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from driftlab.body_frames import misalignment_vector
from driftlab.triad import split_error_matrix

from .question import Answer, Part, Question, matrix, shown, two_of
from .turns import ARCSEC

AXES = "xyz"
MOUNTINGS = {
    "$x$ points East, $y$ North, $z$ Up": np.eye(3),
    "$x$ points North, $y$ West, $z$ Up": np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]]),
    "$x$ points West, $y$ South, $z$ Up": np.diag([-1.0, -1, 1]),
    "$x$ points South, $y$ East, $z$ Up": np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]]),
}
"""How a level box may stand, with its attitude matrix, body to East, North, Up."""


def three_parts(draw: Generator) -> Question:
    """Chapter 07: scale factors, non-orthogonality, misalignment."""
    scale = draw.permutation([-1, 1, 1]) * draw.integers(15, 60, 3)
    sums = draw.permutation([-1, 1, -1]) * draw.integers(5, 25, 3)
    turn = draw.permutation([-1, 1, 1]) * draw.permutation(np.arange(8, 40))[:3]
    words = list(MOUNTINGS)[int(draw.integers(len(MOUNTINGS)))]
    entries = np.diag(scale).astype(float)
    for (i, j), mean in zip(((1, 2), (2, 0), (0, 1)), sums, strict=True):
        half = turn[3 - i - j]
        entries[i, j], entries[j, i] = mean - half, mean + half
    parts = split_error_matrix(entries * ARCSEC)
    pairs = [parts.non_orthogonality[i, j] / ARCSEC for i, j in ((0, 1), (0, 2), (1, 2))]
    kappa = misalignment_vector(entries * ARCSEC) / ARCSEC
    start = -MOUNTINGS[words] @ kappa
    return Question(
        "Three parts of one matrix",
        "07",
        "take an error matrix apart into scale, non-orthogonality and misalignment",
        8,
        rf"The gyros of a box measure $(I + K)\,\omega$ with $K = {matrix(entries)}$ arc seconds.",
        two_of(
            draw,
            Part(
                "Gyros and accelerometers together have 24 errors, biases included. Why can "
                "navigation find 21 of them only, which three are left, and what would decide "
                "them?",
                "Gyros and accelerometers turned together by one small rotation are the same box "
                "in another mounting: three numbers that no motion of the box shows. They stay "
                "open until somebody says how its axes are defined, or measures the triads "
                "against the case.",
                (),
                (
                    (2, "the common misalignment of both triads is a choice of axes"),
                    (1, "no motion shows it, so no scheme of turns and no better sensor helps"),
                    (1, "what would decide it: a statement, or a measurement against the case"),
                ),
                ("Three errors named that are hard to see (say, upright biases): 0.",),
            ),
            Part(
                r"Give the three entries $xy$, $xz$, $yz$ of the non-orthogonality, and the "
                r"misalignment $\kappa$ for which the skew part is $[\kappa\times]$, all in arc "
                "seconds. What is left?",
                "Means and half differences of mirrored entries; what is left are the scale "
                "errors, on the diagonal.",
                (
                    *(
                        Answer(f"the non-orthogonality ${name}$", float(x), "arc seconds")
                        for name, x in zip(("xy", "xz", "yz"), pairs, strict=True)
                    ),
                    *(
                        Answer(rf"$\kappa_{name}$", float(x), "arc seconds")
                        for name, x in zip(AXES, kappa, strict=True)
                    ),
                ),
                (
                    (1, "means, and scale errors named"),
                    (1, "half differences"),
                    (1, r"$\kappa$ with the order and signs of $[\kappa\times]$"),
                ),
                (
                    r"All of $\kappa$ with the opposite sign: 2.",
                    f"The sums without the half ($xy$: {shown(2 * pairs[0])}): 2, once.",
                ),
            ),
            Part(
                rf"The box rests, level: {words}. With the skew part alone it begins with a right "
                "attitude. With which attitude error, about East, North and Up, would a box "
                "without any sensor error have to begin to err in the same way, but for what is "
                r"constant in the body? The error $\varphi$ is that of $\hat C = (I - "
                r"[\varphi\times])\,C$.",
                r"With $-C(0)\kappa$: a triad turned as a whole does what a wrong attitude at the "
                "start does.",
                tuple(
                    Answer(f"the error about {name}", float(x), "arc seconds")
                    for name, x in zip(("East", "North", "Up"), start, strict=True)
                ),
                ((1, r"minus $\kappa$"), (2, "in local axes, by the attitude at the start")),
                (r"$+C(0)\kappa$: 2. $-\kappa$ left in body axes: 1.",),
            ),
            Part(
                "The axes of the body are defined anew, so that the gyros have no misalignment "
                "to first order. Which matrix of errors have they then? Give its entries $xy$, "
                "$yx$ and $zz$, in arc seconds.",
                "A new definition of the axes takes off a skew matrix. The symmetric part is left.",
                (
                    Answer("the new entry $xy$", float(pairs[0]), "arc seconds"),
                    Answer("the new entry $yx$", float(pairs[0]), "arc seconds"),
                    Answer("the new entry $zz$", float(scale[2]), "arc seconds"),
                ),
                ((2, "the symmetric part is left"), (1, "three numbers")),
                ("The scale-factor errors taken off as well: 2.",),
            ),
        ),
    )
