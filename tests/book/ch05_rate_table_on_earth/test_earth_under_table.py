"""The figure of the Earth under a rate table."""

import numpy as np
import pytest
from scipy.constants import arcsecond, degree

from driftlab.book.machinery.figure.publish import PublishedFigure
from published import published


@published("05-earth-under-table")
def test_simulated_turns_lie_on_the_formula(figure: PublishedFigure) -> None:
    data = figure.data
    places = np.searchsorted(data.latitude, data.turned_latitude - 1e-9)
    np.testing.assert_allclose(data.latitude[places], data.turned_latitude, atol=1e-12)
    # The first-order formula errs by the cube of 2.5e-4, times pi squared.
    np.testing.assert_allclose(data.turned, data.offset[:, places], rtol=0, atol=1e-9)
    np.testing.assert_allclose(data.offset[0], 3 * data.offset[1], rtol=1e-12)


@published("05-earth-under-table")
def test_the_mean_of_both_directions_ends_at_the_true_sigma(figure: PublishedFigure) -> None:
    data = figure.data
    assert data.mean[-1] == pytest.approx(data.sigma, abs=0.01 * arcsecond)
    half = (data.there - data.back) / 2
    # The triad measures the Earth wrongly too: a product with sigma, 1.5e-4.
    assert half == pytest.approx(7.292115e-5 * np.sin(data.place) / (10 * degree), rel=2e-4)
    assert "the mean of both ends at the true -30" in figure.caption
