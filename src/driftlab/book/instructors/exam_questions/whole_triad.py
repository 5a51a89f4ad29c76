"""A question on Part III: an error matrix taken apart, and what navigation can find of it."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from driftlab.body_frames import misalignment_vector
from driftlab.triad import split_error_matrix

from .question import Question, matrix, plain, question, shown
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
    """Chapter 10: scale factors, non-orthogonality, misalignment, and what nobody can find."""
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
    mounted = draw.permutation(np.arange(41, 90))[:3] * draw.choice([-1, 1], 3)
    other = mounted + draw.permutation(np.arange(5, 35))[:3] * draw.choice([-1, 1], 3)
    known = int(draw.choice([20, 30, 40, 60]))
    rows = [f"({', '.join(plain(x) for x in each)})" for each in (mounted, other)]
    return question(
        draw,
        rf"""
        10, 8 minutes: Three parts of one matrix
        split an error matrix into scale factors, non-orthogonality and misalignment

        The gyros of a box measure $(I + K)\,\omega$ with $K = {matrix(entries)}$ arc seconds.

        (a) Gyros and accelerometers together have 24 errors, biases included. Why can navigation
        find only 21 of them, which three remain unknown, and what would determine these?
        = Rotating gyros and accelerometers together by a small angle gives the same box in another
        mounting, so no motion reveals these three angles. They remain unknown until the axes of the
        box are defined, or the triads are measured against the case.
        2: the common misalignment of both triads is a choice of axes; 1: no motion reveals it, so
        no scheme of turns and no better sensor helps; 1: what determines it: a definition, or a
        measurement against the case
        - Three errors named that are merely hard to see, such as vertical biases: 0.

        (a) In another box the misalignment of the gyros is {rows[0]} arc seconds and that of the
        accelerometers is {rows[1]} arc seconds, both with respect to the case. Neither is known.
        Which three numbers, computed from these six, can navigation find, and why can it not find
        the others?
        = The misalignment of the gyros with respect to the accelerometers, which is the difference.
        The two triads rotated together are the same box in another mounting, so no motion reveals
        their common misalignment.
        1: only the difference can be found; 1: three numbers; 2: the common misalignment is a
        choice of axes, which no motion reveals
        - The difference with the opposite sign, if it is stated: nothing lost.
        > gyros minus accelerometers, $x$: arc seconds | $y$: arc seconds | $z$: arc seconds

        (a) A filter starts with a standard deviation of {known}″ for each component of the
        misalignment of the gyros and of the accelerometers, all uncorrelated, and without any
        knowledge of the attitude. It then sees a long scheme of turns with excellent sensors. To
        what value can the standard deviation of one component of the misalignment of the gyros
        fall, and why no further?
        = The difference of the two misalignments becomes known. Their mean does not: no motion
        reveals it, and it keeps its initial standard deviation, {known}″$/\sqrt2$. With the
        difference known, this is also the uncertainty of each.
        2: the common misalignment is a choice of axes, which no motion reveals; 1: the difference
        becomes known; 1: the number
        - The initial value kept ({known}″), as if the difference remained unknown: 3.
        - Zero, or "as long as one turns enough": 0.
        > the remaining standard deviation: ″

        (b) Give the three entries $xy$, $xz$, $yz$ of the non-orthogonality, and the misalignment
        $\kappa$ for which the skew-symmetric part is $[\kappa\times]$, all in arc seconds. Which
        errors remain?
        = Means and half differences of mirrored entries. The scale-factor errors remain, on the
        diagonal.
        1: means, and the scale-factor errors named; 1: half differences; 1: $\kappa$, with the
        order and signs of $[\kappa\times]$
        - All of $\kappa$ with the opposite sign: 2.
        - The sums, not halved ($xy$: {shown(2 * pairs[0])}): 2.
        > the non-orthogonality $xy$: arc seconds | $xz$: arc seconds | $yz$: arc seconds |
        $\kappa_x$: arc seconds | $\kappa_y$: arc seconds | $\kappa_z$: arc seconds

        (b) The box is at rest and level: {words}. Suppose it had only the skew-symmetric part of
        $K$, $[\kappa\times]$, and started with the correct attitude. What initial attitude error
        about East, North and Up would give a box with perfect sensors the same error, apart from a
        term that is constant in body axes? The error $\varphi$ is defined by $\hat C = (I -
        [\varphi\times])\,C$.
        = $-C(0)\kappa$: a triad that is rotated as a whole acts like a wrong initial attitude.
        1: minus $\kappa$; 2: in local axes, by the initial attitude
        - $+C(0)\kappa$: 2.
        - $-\kappa$ left in body axes: 1.
        > the error about East: arc seconds | about North: arc seconds | about Up: arc seconds

        (b) The body axes are redefined so that the gyros have no misalignment, to first order. What
        is the error matrix of the gyros then? Give its entries $xy$ and $zz$, in arc seconds.
        = A new definition of the axes removes a skew-symmetric matrix. The symmetric part remains.
        2: the symmetric part remains; 1: both numbers
        - The scale-factor errors removed as well: 2.
        > the new entry $xy$: arc seconds | the new entry $zz$: arc seconds
        """,
        [*(mounted - other), known / np.sqrt(2), *pairs, *kappa, *start, pairs[0], scale[2]],
    )
