"""`calibrate` doubts no right run; tables that stand, and reference velocities at any time."""

import numpy as np
import pytest
from scipy.constants import arcsecond

from driftlab.calibration import (
    ERROR_MODELS,
    Calibration,
    InconsistentWarning,
    calibrate,
    innovation_test,
)
from driftlab.calibration._told import FITS, evidence
from driftlab.imu import NO_ERRORS, ImuNoise, PriorDeviations, random_imu_errors
from driftlab.increments import Increments, measure
from driftlab.quaternion import from_rotation_vector, multiply
from table_records import RECORDS, STEP, told

# Right runs


def many(scheme, runs, noisy=True, size=40):
    """Right runs of different units, along a leading axis."""
    prior = PriorDeviations(installation=size * arcsecond)
    rng = np.random.default_rng(7)
    run = told(scheme, noisy, prior=prior, errors=random_imu_errors(prior, rng, runs))
    tilts = from_rotation_vector(prior.attitude * rng.standard_normal((runs, 3)))
    shape = (runs, *run["reference_velocity"].shape)
    reference = noisy * run["noise"].reference_velocity * rng.standard_normal(shape)
    start = multiply(tilts, RECORDS[scheme].attitude[0])
    # `told` draws one noise for all; each run has its own.
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
    told = found.told._replace(reference=np.full((1, 3), 0.03))
    for rows, start in zip(zip(*noisy["increments"][1:], strict=True), noisy["start"], strict=True):
        seen = evidence(Increments(STEP, *rows))
        assert seen.misfit(told._replace(start=start)) < 0.8 * FITS


def test_units_bent_too_much_for_one_pass_are_told_to_pass_again():
    run = many("19 positions", 3, size=400)
    with pytest.warns(InconsistentWarning, match="too large for first order.*go over the record"):
        first = calibrate(**run)
    assert (innovation_test(first).verdict == "consistent").all()  # these see nothing
    calibrate(**run, about=first)  # without a word


# A table that stands, and reference velocities at any time


def test_table_that_stands_is_told_by_nothing():
    """Zeros at every second, or as often as is said; what is left over goes to the last update."""
    run = told(noisy=False)
    run.pop("reference_velocity")
    seconds = len(run["increments"].angle) * STEP
    usual = calibrate(**run)
    assert len(usual.nis) == round(seconds / (2 * STEP))  # pairs are longer than a second
    found = calibrate(**run, update_interval=31.0)
    assert found.times[-1] == seconds
    assert len(found.nis) == np.ceil(seconds / (42 * STEP))  # the nearest number of pairs
    evenly = calibrate(**told(noisy=False))
    same = calibrate(**run, update_interval=40 * STEP)
    for name in ("state", "covariance", "nis", "innovations"):
        np.testing.assert_array_equal(getattr(same, name), getattr(evenly, name))
    odd = run | {"increments": run["increments"].part(0, len(run["increments"].angle) - 1)}
    assert calibrate(**odd, update_interval=30.0).times[-1] == seconds - 2 * STEP


def test_noise_of_a_table_that_stands_is_found_from_the_innovations():
    """Less and less until the innovations are as large as told; the estimates stay right."""
    run = told(noisy=False)
    verdicts, stated = [], []
    for deviation in (1e-2, 1e-3, 1e-4, 1e-5):
        found = calibrate(**run | {"noise": ImuNoise(reference_velocity=deviation)})
        verdicts.append(str(innovation_test(found).verdict))
        stated.append(found.deviations[-1, 6:])
    assert verdicts[0] == "too cautious"
    assert verdicts[-1] == "consistent"
    assert (np.diff(stated, axis=0) < 0).all()


def test_velocities_at_any_time_are_those_of_the_nearest_pair():
    run = told()
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
    again = calibrate(**some, reference_times=ends[kept], about=found)
    np.testing.assert_allclose(
        (again.state[-1] - found.state[-1]) / found.deviations[-1].clip(1e-12), 0, atol=0.5
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
    run = told()
    if len(changes.get("reference_times", [])) == 2:
        run["reference_velocity"] = None
    with pytest.raises(ValueError, match=f"^{words}"):
        calibrate(**run | changes)


def test_innovations_are_the_roots_of_their_squares():
    found = calibrate(**told())
    np.testing.assert_allclose(np.sum(found.innovations**2, axis=-1), found.nis, rtol=1e-6)


def test_a_calibration_without_innovations_cannot_be_tested():
    none = np.zeros((1, 27))
    empty = Calibration(ERROR_MODELS["averaged"], none[0], none, none, none, none, none[0])
    assert empty.innovations.shape == (0, 3)
    with pytest.raises(ValueError, match=r"^calibration: expected the innovations"):
        innovation_test(empty)
