"""Innovations and errors found: what contradicts what the filter was told."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.constants import arcsecond, degree, g, hour, micro
from scipy.stats import chi2, norm

from driftlab.calibration import FULL, Calibration, InnovationTest, innovation_test
from driftlab.calibration.calibration_history import CONFIDENCE
from driftlab.calibration.filter import _normalised_innovations
from driftlab.imu import PriorDeviations

# Innovations


def innovations(squares, mean):
    return InnovationTest(np.array(squares), 0.8, 1.2, np.array(mean), 2.0, np.zeros(2), 0.1)


@pytest.mark.parametrize(
    ("squares", "mean", "found"),
    [
        ([1.0, 1.1], [1.0, 1.9], None),
        ([1.0, 1.49], [0.0, 0.0], None),  # a quarter above the bound
        ([1.0, 1.51], [0.0, 0.0], (1, "squared innovations (NIS / 3) from 0.8 to 1.2, got 1.51")),
        ([3.0, 1.0], [0.0, 3.9], (0, "squared innovations (NIS / 3) from 0.8 to 1.2, got 3")),
        ([3.0, 1.0], [0.0, 4.1], (1, "squared mean of the innovations from 0 to 2, got 4.1")),
        ([1.0, 0.9], [2.1, 0.0], (0, "squared mean of the innovations from 0 to 2, got 2.1")),
    ],
)
def test_the_worst_of_both_tests_is_told(squares, mean, found):
    told = innovations(squares, mean)._contradiction()
    assert told == (found and (found[0], f"expected {found[1]}"))


def test_normalised_innovations_have_the_nis_for_square():
    rng = np.random.default_rng(2)
    half, innovation = rng.normal(size=(4, 3, 3)), rng.normal(size=(4, 3))
    predicted = half @ np.swapaxes(half, -1, -2)
    found = _normalised_innovations(innovation, predicted, 0.3)
    nis = [
        v @ np.linalg.inv(p + 0.3 * np.eye(3)) @ v
        for v, p in zip(innovation, predicted, strict=True)
    ]
    np.testing.assert_allclose(np.sum(found**2, axis=-1), nis, rtol=1e-12)


def passes(state, deviations=None):
    """What is read of a calibration."""
    return SimpleNamespace(model=FULL, state=np.asarray(state), deviations=deviations)


def test_errors_beyond_the_prior_are_told_in_their_units_the_largest_of_each_kind():
    prior, start = PriorDeviations(), np.array([[0.0, 0.0, 0.0, 1.0]] * 2)
    known = np.sqrt(np.diag(FULL.covariance(prior, start[0])))
    kinds = {
        "gyro bias": (degree / hour, " deg/h"),
        "accelerometer bias": (micro * g, " µg"),
        "gyro scale": (1e-6, " ppm"),
        "gyro installation": (arcsecond, " arc seconds"),
    }
    for kind, (unit, word) in kinds.items():
        first, second = [k for k, name in enumerate(FULL.names) if name.startswith(kind)][:2]
        state = np.zeros((2, 3, FULL.size))
        state[..., :6] = 1.0  # attitude and velocity are no errors of the unit
        state[0, -1, first] = 6.5 * known[first]
        state[1, -1, first], state[1, -1, second] = -6.1 * known[first], 7.0 * known[second]
        run, said = Calibration._beyond_prior(passes(state), prior, start)
        assert run == 1
        assert said == [
            f"{FULL.names[second]}: found {7 * known[second] / unit:.3g}{word} where the prior "
            f"says {known[second] / unit:.3g}"
        ]
        state[1] = state[0] = 0.0
        state[0, -1, first] = 5.9 * known[first]
        assert Calibration._beyond_prior(passes(state), prior, start)[1] == []


@pytest.mark.parametrize("size", [1.0, 1.05])
def test_second_order_is_the_square_of_the_largest_error_over_the_least_deviation(size):
    scale = [k for k, name in enumerate(FULL.names) if " scale " in name]
    state, deviations = np.zeros((2, 2, FULL.size)), np.full((2, 2, FULL.size), 1e-2)
    deviations[..., scale[0]] = 0.0  # known before
    deviations[:, -1, scale[1]] = [1e-6, 4.5e-6]
    state[:, -1, scale[2]] = [1e-3, -3e-3 * size]
    state[:, 0] = 1.0  # of the beginning nothing counts
    said = Calibration._too_large(passes(state, deviations))
    assert [line.split("got ")[1][:4] for line in said] == ["2.21"] * (size > 1)


# Bounds of the innovations' tests


def kept(rows):
    """A calibration of which only the innovations are asked."""
    nothing = np.zeros(1)
    return Calibration(FULL, *[nothing] * 6, rows)


@pytest.mark.parametrize("count", [2, 40])
def test_bounds_are_quantiles_of_chi_square_and_of_the_normal(count):
    rows = np.random.default_rng(3).normal(size=(count, 3))
    test, chance = innovation_test(kept(rows)), CONFIDENCE
    assert test.squares == pytest.approx(np.mean(rows**2))
    low, high = chi2.interval(chance, 3 * count)
    assert (test.lower, test.upper) == pytest.approx((low / (3 * count), high / (3 * count)))
    assert test.mean == pytest.approx(np.sum(rows.mean(axis=0) ** 2) * count / 3)
    assert test.mean_upper == pytest.approx(chi2.ppf(chance, 3) / 3)
    assert test.correlation == pytest.approx(np.sum(rows[1:] * rows[:-1]) / np.sum(rows**2))
    assert test.correlation_bound == pytest.approx(norm.interval(chance)[1] / np.sqrt(3 * count))
    assert innovation_test(kept(np.zeros((2, 3)))).correlation == 0


def test_without_innovations_nothing_is_tested():
    with pytest.raises(ValueError, match=r"^calibration: expected the innovations of some updates"):
        innovation_test(kept(np.zeros((0, 3))))
    assert Calibration._field_defaults["innovations"].shape == (0, 3)
