"""In which body axes the neglected second order is least: what the book says of it."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from scipy.constants import arcsecond

from driftlab.book.ch11_kalman_calibration.experiments import quick_trial
from driftlab.book.ch12_calibration_consistency.experiments import (
    EQUATIONS,
    MOUNTINGS,
    WAYS,
    error_equations,
    neglected,
    on_the_computed_path,
)
from driftlab.book.ch12_calibration_consistency.experiments.neglected_terms import (
    BATCH,
    SEED,
    STEP,
)
from driftlab.book.machinery.figure.publish import PublishedFigure
from driftlab.checks import FloatArray
from driftlab.imu import NO_ERRORS, ImuErrors, PriorStandardDeviations, random_imu_errors
from driftlab.monte_carlo import run_batches
from driftlab.motion.scheme import SCHEMES, Scheme
from driftlab.motion.turntable import turntable_trajectory
from driftlab.quaternion import from_rotation_vector, to_matrix
from published import published

pytestmark = pytest.mark.slow
LATITUDE = np.radians(37.5)
AVERAGED, UPPER, LOWER, TRIANGLE, OTHER = range(5)
"""Places in `BODY_FRAMES`; a column of rivals lacks the first."""


def on_the_table(scheme: str, unit: ImuErrors, latitude: float = LATITUDE) -> FloatArray:
    short = replace(SCHEMES[scheme], dwell=20.0)
    true = turntable_trajectory(short, latitude, 0.25, multiple_of=STEP)
    return np.array([*error_equations(true, unit, latitude)])


@published("12-neglected-terms")
@pytest.mark.parametrize("filters", [False, pytest.param(True, marks=pytest.mark.long)])
def test_study_is_read_from_what_the_code_makes(figure: PublishedFigure, filters: bool) -> None:
    """The study takes minutes, so its first units are computed anew, for one of six cases."""
    scheme, mounting, spreads = 1, MOUNTINGS.index("gyros built worse"), (400, 100)
    case = [*SCHEMES][scheme], *(spread * arcsecond for spread in spreads)

    def equations(rng: np.random.Generator, size: int) -> FloatArray:
        trial = quick_trial(case[0], 400, 63.0)
        unit = random_imu_errors(trial.prior, rng, size)
        built = np.where(np.eye(3), 1.0, 0.25)
        unit = unit._replace(accelerometer_error_matrix=built * unit.accelerometer_error_matrix)
        true = turntable_trajectory(trial.scheme, LATITUDE, 0.25, multiple_of=36)
        return np.swapaxes([*error_equations(true, unit, LATITUDE)], 0, 1)

    task = partial(neglected, *case, 0.01, 63.0) if filters else equations
    (found,) = run_batches(task, BATCH, seed=SEED, batch_size=BATCH)
    kept = figure.data.size_of_first[scheme, mounting][:, : found.shape[1]]
    # A covariance of 27 states keeps seven digits or so.
    np.testing.assert_allclose(found.mean(axis=-1), kept, rtol=1e-5)


@published("12-neglected-terms")
def test_averaged_axes_leave_out_least_in_the_error_equations(figure: PublishedFigure) -> None:
    """What the ledger says: with triads alike in all 32 comparisons, else in 62 of 64."""
    better = figure.data.part_low[..., : len(EQUATIONS)] > 0.5
    worse = figure.data.part_high[..., : len(EQUATIONS)] < 0.5
    alike = MOUNTINGS.index("both alike")
    assert better[:, alike].all()
    assert (better[:, alike].size, better.sum(), worse.sum()) == (32, 94, 1)
    lost = 0, 0, OTHER - 1, EQUATIONS.index("table's path, attitude")
    assert worse[lost]
    assert figure.data.better[lost] == 245
    size = figure.data.size[:, alike, :, : len(EQUATIONS)]
    assert (size.argmin(axis=1) == AVERAGED).all()


@pytest.mark.parametrize(
    ("scheme", "degrees", "size"),
    [
        ("19 positions", -34, 400),
        ("18 rotations", 69, 200),
        ("19 positions", 37.5, 100),
        *(pytest.param(*case, marks=pytest.mark.long) for case in (
            ("18 rotations", -34, 400), ("19 positions", 69, 200), ("18 rotations", 37.5, 100),
        )),
    ],
)  # fmt: skip
def test_the_same_elsewhere_and_for_smaller_errors(scheme: str, degrees: float, size: int) -> None:
    unit = random_imu_errors(PriorStandardDeviations(installation=size * arcsecond), 5, 60)
    averaged, *rivals = on_the_table(scheme, unit, np.radians(degrees)).swapaxes(0, 1)
    # Of 60 fair coins 40 fall on one side in one of a hundred cases.
    assert ((averaged < rivals).sum(axis=-1) >= 40).all()


@pytest.mark.parametrize(
    "scheme", ["18 rotations", pytest.param("19 positions", marks=pytest.mark.long)]
)
def test_about_the_computed_path_it_depends_on_what_is_called_an_error(scheme: str) -> None:
    unit = random_imu_errors(PriorStandardDeviations(installation=400 * arcsecond), 5, 60)
    true = turntable_trajectory(replace(SCHEMES[scheme], dwell=63.0), LATITUDE, 0.25,
                                multiple_of=STEP)  # fmt: skip
    ahead = []
    for corrections in (True, False):
        found = np.array([*on_the_computed_path(true, unit, LATITUDE, corrections=corrections)])
        averaged, *rivals = found.swapaxes(0, 1)
        ahead.append((averaged < rivals).sum(axis=-1))
    of_corrections, of_measured = ahead
    assert (of_corrections >= 40).all()  # of 60, as above
    if scheme == "18 rotations":
        assert (of_measured[[UPPER - 1, LOWER - 1, OTHER - 1]] <= 27).all()
        assert (of_measured[[UPPER - 1, LOWER - 1], 1] <= 20).all()
    else:
        assert (of_measured[[UPPER - 1, LOWER - 1]] > 20).all()  # about equal
        assert of_measured[OTHER - 1, 0] <= 20


@pytest.mark.long
def test_of_many_units_more_err_less_in_the_upper_triangle_but_not_in_the_mean() -> None:
    """On the eighteen rotations, fed back and re-linearised; 1 in 10 000 by chance is 1083."""
    trial = quick_trial("18 rotations", 400, 63.0)
    averaged, upper = (
        np.concatenate([
            replace(trial, frame=frame).run(seed, 200).nees[:, -1] for seed in range(10)
        ])
        for frame in ("averaged", "upper triangle")
    )  # fmt: skip
    assert 1083 < (upper < averaged).sum() < 1200  # of 2000
    assert averaged.mean() < upper.mean()


@published("12-neglected-terms")
def test_on_a_table_that_stands_the_accelerometers_triangle_loses_its_lead(
    figure: PublishedFigure,
) -> None:
    data, alike = figure.data, MOUNTINGS.index("both alike")
    relinearised = WAYS.index("fed back, re-linearised")
    loose = data.better[:, alike, :, relinearised]
    still = data.still_better[..., relinearised - len(EQUATIONS)]
    # Of 600 units; the leads of averaged accelerometers remain, that of averaged axes over the
    # lower triangle grows.
    assert (still[:, TRIANGLE - 1] > loose[:, TRIANGLE - 1] + 35).all()
    assert (still[:, OTHER - 1] < loose[:, OTHER - 1]).all()
    assert (still[:, LOWER - 1] > loose[:, LOWER - 1]).all()
    better, worse = figure.data.still_low > 0.5, figure.data.still_high < 0.5
    opened, *fed_back, again = range(len(WAYS) - len(EQUATIONS))
    assert not worse[..., [opened, again]].any()
    assert not better[..., again].any()
    # Of eight comparisons with axes tied to the accelerometers, seven at 1 cm/s.
    assert worse[:, [TRIANGLE - 1, OTHER - 1]][..., fed_back].sum() == 4


@pytest.mark.parametrize(
    ("turns", "rival", "most"), [("+90X +90Y +90Z", LOWER, 84), ("+90Z +90Z", UPPER, 10)]
)
def test_on_other_sequences_a_triangle_of_the_gyros_can_leave_out_less(
    turns: str, rival: int, most: int
) -> None:
    """Velocity about each choice's own path; 84 of 200 fair coins are one in a hundred."""
    repeats = 6 if rival == LOWER else 4
    scheme = Scheme(" ".join([turns] * repeats), dwell=63.0)
    unit = random_imu_errors(PriorStandardDeviations(installation=400 * arcsecond), 7, 200)
    true = turntable_trajectory(scheme, LATITUDE, 0.25, multiple_of=STEP)
    velocity = next(error_equations(true, unit, LATITUDE))
    assert (velocity[AVERAGED] < velocity[rival]).sum() < most


@published("12-neglected-terms")
def test_in_filters_it_depends_on_where_they_are_linearised(figure: PublishedFigure) -> None:
    better, worse = figure.data.part_low > 0.5, figure.data.part_high < 0.5
    opened, *fed_back, again = range(len(EQUATIONS), len(WAYS))
    assert not worse[:, :, [UPPER - 1, LOWER - 1]].any()
    assert not worse[..., [opened, again]].any()
    assert not better[..., again].any()
    assert better[..., opened].sum() == 19  # of 24
    # Axes tied to the accelerometers, where these are built better, alike and worse; of eight.
    tied = np.ix_([0, 1], range(3), [TRIANGLE - 1, OTHER - 1], fed_back)
    assert worse[tied].sum(axis=(0, 2, 3)).tolist() == [8, 7, 0]
    assert better[tied].sum(axis=(0, 2, 3)).tolist() == [0, 0, 8]


@pytest.mark.parametrize("scheme", SCHEMES)
def test_equations_leave_out_the_second_order_and_nothing_of_the_first(scheme: str) -> None:
    """Twice the errors leave four times as much, but for the computation's own error."""
    unit = random_imu_errors(PriorStandardDeviations(installation=400 * arcsecond), 1, 10)
    twice = ImuErrors(*(2 * each for each in unit))
    two, one = ((on_the_table(scheme, each) ** 2).mean(axis=-1) for each in (twice, unit))
    np.testing.assert_allclose(np.sqrt(two / one), 4.0, rtol=0.1)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_misalignment_of_the_triads_leaves_less_in_the_accelerometers_matrix(scheme: str) -> None:
    """The authors' reason: there it enters the velocity alone."""
    vectors = 400 * arcsecond * np.random.default_rng(1).standard_normal((20, 3))
    turned = to_matrix(from_rotation_vector(vectors)) - np.eye(3)
    left = on_the_table(scheme, NO_ERRORS._replace(accelerometer_error_matrix=turned))
    # Nothing else is wrong: three choices leave it to the accelerometers, two to the gyros.
    gyros, accelerometers = left.mean(axis=-1)[:, OTHER], left.mean(axis=-1)[:, AVERAGED]
    assert (gyros > 3 * accelerometers).all()


def test_filters_fed_back_agree_where_nothing_is_bent() -> None:
    """Two gains and two passes: about the table's path, as the package has it, and once more."""
    rng = np.random.default_rng(0)
    bent = neglected("18 rotations", arcsecond, arcsecond, 0.01, 20.0, rng, 12)
    table, package, again = bent[:, len(EQUATIONS) + 1 :].swapaxes(0, 1)
    np.testing.assert_allclose(table, package, rtol=0.02)
    np.testing.assert_allclose(again, package, rtol=0.02)
