"""The figures of chapter 02: roots of the characteristic equation, and their errors."""

import numpy as np
from hypothesis import given

from driftlab.book.ch02_characteristic_equation.experiments import characteristic_roots
from driftlab.book.scenarios import SYMMETRIC
from support import directions, matrices


@given(matrices(1.0), directions())
def test_roots_picture_shows_the_biquadratic(shape: np.ndarray, direction: np.ndarray) -> None:
    data = characteristic_roots(0.1, shape, direction)
    # The copy's equation spoils the sum of the squares and keeps their product.
    squares = data.roots[..., 0] ** 2 * data.roots[..., 2] ** 2
    np.testing.assert_allclose(squares[3], squares[0], rtol=1e-6, atol=1e-12)


def test_roots_errors_have_the_slopes_of_the_text() -> None:
    data = characteristic_roots(0.1, SYMMETRIC, [1, 1, 0.3])
    small = (data.sizes > 1e-4) & (data.sizes < 1e-2)
    slopes = [
        np.polyfit(np.log(data.sizes[small]), np.log(error[small]), 1)[0]
        for error in data.error.reshape(-1, len(data.sizes))
    ]
    # first order: fast, slow; with the next term: fast, slow; in the copy: fast, slow
    np.testing.assert_allclose(slopes, [2, 2, 3, 3, 2, 3], atol=0.05)
