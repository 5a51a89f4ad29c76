"""Innovations and errors found, and what contradicts what the filter was told: no right run does.

Also tables that stand, and reference velocities at any time.
"""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.constants import arcsecond, degree, g, hour, micro
from scipy.stats import chi2, norm

from driftlab.calibration import (
    ERROR_MODELS,
    FULL,
    InconsistentCalibrationWarning,
    calibrate,
    innovation_test,
)
from driftlab.calibration._filter_inputs import FITS, evidence
from driftlab.calibration.calibration_history import CONFIDENCE, Calibration, InnovationTest
from driftlab.calibration.filter import _normalised_innovations
from driftlab.imu import NO_ERRORS, ImuNoise, PriorStandardDeviations, random_imu_errors
from driftlab.increments import Increments, measure
from driftlab.quaternion import from_rotation_vector, multiply
from table_records import RECORDS, STEP, inputs

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
    said = innovations(squares, mean)._contradiction()
    assert said == (found and (found[0], f"expected {found[1]}"))


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


def passes(state, standard_deviations=None):
    """What is read of a calibration."""
    return SimpleNamespace(
        model=FULL, state=np.asarray(state), standard_deviations=standard_deviations
    )


def test_errors_beyond_the_prior_are_told_in_their_units_the_largest_of_each_kind():
    prior, start = PriorStandardDeviations(), np.array([[0.0, 0.0, 0.0, 1.0]] * 2)
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
    state, standard_deviations = np.zeros((2, 2, FULL.size)), np.full((2, 2, FULL.size), 1e-2)
    standard_deviations[..., scale[0]] = 0.0  # known before
    standard_deviations[:, -1, scale[1]] = [1e-6, 4.5e-6]
    state[:, -1, scale[2]] = [1e-3, -3e-3 * size]
    state[:, 0] = 1.0  # of the beginning nothing counts
    said = Calibration._too_large(passes(state, standard_deviations))
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


# Right runs


def many(scheme, runs, noisy=True, size=40):
    """Right runs of different units, along a leading axis."""
    prior = PriorStandardDeviations(installation=size * arcsecond)
    rng = np.random.default_rng(7)
    run = inputs(scheme, noisy, prior=prior, errors=random_imu_errors(prior, rng, runs))
    tilts = from_rotation_vector(prior.attitude * rng.standard_normal((runs, 3)))
    shape = (runs, *run["reference_velocity"].shape)
    reference = noisy * run["noise"].reference_velocity * rng.standard_normal(shape)
    start = multiply(tilts, RECORDS[scheme].attitude[0])
    # `inputs` draws one noise for all; each run has its own.
    noise = measure(
        Increments(STEP, *np.zeros((2, runs, *run["increments"].angle.shape[-2:]))),
        NO_ERRORS,
        run["noise"],
        rng,
    )
    true = measure(RECORDS[scheme].increments, random_imu_errors(prior, rng, runs))
    added = Increments(STEP, true.angle + noise.angle, true.velocity + noise.velocity)
    return run | {"increments": added, "reference_velocity": reference, "start": start}


@pytest.mark.parametrize("scheme", RECORDS)
def test_no_right_run_is_doubted(scheme):
    """Forty of each scheme, and forty at a table that stands; pytest makes errors of warnings.

    Each bound is kept but once in 10 000 runs, and the misfit of 40 has its largest near the
    three deviations of a gyro bias.
    """
    noisy, still = many(scheme, 40), many(scheme, 10, noisy=False)
    found = calibrate(**noisy)
    test = innovation_test(found)
    assert (test.verdict == "consistent").all()
    # Squares, means and correlations scatter as they should: within four deviations of a mean.
    count = 3 * noisy["reference_velocity"].shape[-2] * 40
    assert abs(test.squares.mean() - 1) < 4 * np.sqrt(2 / count)
    assert abs(test.mean.mean() - 1) < 4 * np.sqrt(2 / 3 / 40)
    assert abs(test.correlation.mean()) < 4 / np.sqrt(count)
    assert (innovation_test(calibrate(**still)).verdict == "too cautious").all()
    inputs = found.inputs._replace(reference=np.full((1, 3), 0.03))
    for rows, start in zip(zip(*noisy["increments"][1:], strict=True), noisy["start"], strict=True):
        seen = evidence(Increments(STEP, *rows))
        assert seen.misfit(inputs._replace(start=start)) < 0.8 * FITS


def test_units_bent_too_much_for_one_pass_are_told_to_pass_again():
    run = many("19 positions", 3, size=400)
    with pytest.warns(
        InconsistentCalibrationWarning, match="too large for first order.*go over the record"
    ):
        first = calibrate(**run)
    assert (innovation_test(first).verdict == "consistent").all()  # these see nothing
    calibrate(**run, linearization_point=first)  # without a word


# A table that stands, and reference velocities at any time


def test_table_that_stands_is_told_by_nothing():
    """Zeros at every second, or as often as is said; what is left over goes to the last update."""
    run = inputs(noisy=False)
    run.pop("reference_velocity")
    seconds = len(run["increments"].angle) * STEP
    usual = calibrate(**run)
    assert len(usual.nis) == round(seconds / (2 * STEP))  # pairs are longer than a second
    found = calibrate(**run, update_interval=31.0)
    assert found.times[-1] == seconds
    assert len(found.nis) == np.ceil(seconds / (42 * STEP))  # the nearest number of pairs
    evenly = calibrate(**inputs(noisy=False))
    same = calibrate(**run, update_interval=40 * STEP)
    for name in ("state", "covariance", "nis", "innovations"):
        np.testing.assert_array_equal(getattr(same, name), getattr(evenly, name))
    odd = run | {"increments": run["increments"].part(0, len(run["increments"].angle) - 1)}
    assert calibrate(**odd, update_interval=30.0).times[-1] == seconds - 2 * STEP


def test_noise_of_a_table_that_stands_is_found_from_the_innovations():
    """Less and less until the innovations are as large as told; the estimates stay right."""
    run = inputs(noisy=False)
    verdicts, stated = [], []
    for deviation in (1e-2, 1e-3, 1e-4, 1e-5):
        found = calibrate(**run | {"noise": ImuNoise(reference_velocity=deviation)})
        verdicts.append(str(innovation_test(found).verdict))
        stated.append(found.standard_deviations[-1, 6:])
    assert verdicts[0] == "too cautious"
    assert verdicts[-1] == "consistent"
    assert (np.diff(stated, axis=0) < 0).all()


def test_velocities_at_any_time_are_those_of_the_nearest_pair():
    run = inputs()
    ends = np.arange(1, len(run["reference_velocity"]) + 1) * 40 * STEP
    evenly = calibrate(**run)
    near = calibrate(**run, reference_times=ends + 0.9 * STEP * np.sin(ends))
    np.testing.assert_array_equal(near.state, evenly.state)
    # In no order of length: all but some of them, and a record that goes on.
    kept = np.delete(np.arange(len(ends)), [1, 2, 5, 20, len(ends) - 1])
    some = run | {"reference_velocity": run["reference_velocity"][kept]}
    found = calibrate(**some, reference_times=ends[kept])
    assert found.times[-1] == ends[-2]
    assert innovation_test(found).verdict == "consistent"
    again = calibrate(**some, reference_times=ends[kept], linearization_point=found)
    np.testing.assert_allclose(
        (again.state[-1] - found.state[-1]) / found.standard_deviations[-1].clip(1e-12), 0, atol=0.5
    )
    early = run | {"reference_velocity": run["reference_velocity"][:20]}
    with pytest.warns(UserWarning, match="^reference_times: the record goes on for .* not used"):
        calibrate(**early, reference_times=ends[:20])
    moved = some["reference_velocity"] + 0.0
    zeros = calibrate(**some | {"reference_velocity": 0 * moved}, reference_times=ends[kept])
    told_none = run | {"reference_velocity": None}
    none = calibrate(**told_none, reference_times=ends[kept])
    np.testing.assert_array_equal(none.state, zeros.state)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"reference_times": [1.5, 2.0]}, "reference_times: expected times that rise by more than"),
        ({"reference_times": [3.0, 1.5]}, "reference_times: expected times that rise"),
        (
            {"reference_times": [0.0, 9.0]},
            r"reference_times: expected times \(k,\) since the start",
        ),
        (
            {"reference_times": [9.0, 1e9]},
            r"reference_times: expected times \(k,\) since the start",
        ),
        ({"reference_times": [[9.0]]}, r"reference_times: expected times \(k,\) since the start"),
        ({"reference_times": [1100.0]}, r"reference_velocity: expected shape \(\.\.\., 1, 3\), as"),
        ({"update_interval": 9.0}, "update_interval: expected with a table that stands"),
        (
            {"update_interval": -1.0, "reference_velocity": None},
            "update_interval: expected a positive number",
        ),
    ],
)
def test_times_that_cannot_be_are_refused(changes, words):
    run = inputs()
    if len(changes.get("reference_times", [])) == 2:
        run["reference_velocity"] = None
    with pytest.raises(ValueError, match=f"^{words}"):
        calibrate(**run | changes)


def test_a_calibration_without_innovations_cannot_be_tested():
    none = np.zeros((1, 27))
    empty = Calibration(ERROR_MODELS["averaged"], none[0], none, none, none, none, none[0])
    assert empty.innovations.shape == (0, 3)
    with pytest.raises(ValueError, match=r"^calibration: expected the innovations"):
        innovation_test(empty)
