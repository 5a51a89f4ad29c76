"""The filter against least squares with the nonlinear navigation, and what it finds and keeps."""

import re

import numpy as np
import pytest

from driftlab.calibration.body_axes import attitude_error, attitude_of_axes, imu_errors_in_frame
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.calibration.filter import _updates, calibrate
from driftlab.calibration.simulation import TurntableTrial
from driftlab.imu import NO_ERRORS, ImuErrors, ImuNoise, PriorStandardDeviations, random_imu_errors
from driftlab.increments import Increments, measure
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme
from driftlab.motion.turntable import turntable_trajectory
from driftlab.quaternion import from_rotation_vector, multiply
from driftlab.strapdown import final_state, navigate, stationary_state
from support import EPS, replaced

LATITUDE = float(np.radians(37.5))
SPREAD = PriorStandardDeviations()


# A whole calibration against least squares with the navigation itself


SHORT = Scheme("+90X +90Y +90Z -90X +90Y +90Z", dwell=24.0, rate=np.radians(6))
TOLD = ImuNoise(angle_random_walk=0.0, velocity_random_walk=0.0, reference_velocity=0.01)


def tilted(phi, attitude):
    """Attitude with an error phi: (I - [phi×]) C."""
    return multiply(from_rotation_vector(-np.asarray(phi)), attitude)


class Navigator:
    """What a unit computes on the table if nobody corrects it, for whole rows of states.

    The place is put right each time, as in the filter: it is not among the states.
    """

    def __init__(self, model, latitude, interval=0.1, samples=30):
        self.model, self.latitude, self.interval, self.samples = model, latitude, interval, samples
        self.record = turntable_trajectory(SHORT, latitude, interval, multiple_of=samples)
        self.updates = len(self.record.increments.angle) // samples

    def start(self, states):
        return tilted(states[..., :3], self.record.attitude[0])

    def measured(self, states):
        return measure(self.record.increments, self.model.imu_errors(states))

    def errors(self, states):
        """Velocity errors (..., updates, 3), and the attitude error (..., 3) at the end."""
        measured = self.measured(states)
        home = stationary_state(self.latitude, self.start(states))
        now, errors = home, []
        for first in range(0, measured.angle.shape[-2], self.samples):
            here = final_state(navigate(now, measured.part(first, first + self.samples)))
            now = home._replace(velocity=here.velocity, attitude=here.attitude)
            errors.append(here.velocity)
        return np.stack(errors, axis=-2), attitude_error(now.attitude, self.record.attitude[-1])

    def derivatives(self, sizes):
        """Of both errors by all states but the velocity, by central differences."""
        steps = np.diag(sizes)[np.array(sizes) > 0]
        ways = self.errors(steps), self.errors(-steps)
        whole = np.array(sizes)[np.array(sizes) > 0]
        velocity, attitude = (
            np.moveaxis(plus - minus, 0, -1) / (2 * whole)
            for plus, minus in zip(*ways, strict=True)
        )
        return velocity.reshape(-1, len(whole)), attitude


@pytest.mark.parametrize(
    ("frame", "latitude"),
    [("averaged", LATITUDE), ("upper triangle", -1.2), ("averaged accelerometers", 0.0)],
)
def test_calibration_is_least_squares_with_the_nonlinear_navigation(frame, latitude):
    model = ERROR_MODELS[frame]
    navigator = Navigator(model, latitude)
    first = model.covariance(SPREAD, navigator.record.attitude[0])
    standard_deviations = np.sqrt(np.diag(first))
    free = np.flatnonzero(standard_deviations)
    assert model.size - free.size == 3
    prior = first[np.ix_(free, free)]
    # A thousandth of the usual errors: what is of second order is a millionth.
    small = 1e-3
    velocity, attitude = navigator.derivatives(small * standard_deviations)
    posterior = np.linalg.inv(
        np.linalg.inv(prior) + velocity.T @ velocity / TOLD.reference_velocity**2
    )
    to_end = np.concatenate([attitude, velocity[-3:], np.eye(free.size)[3:]])
    covariance = to_end @ posterior @ to_end.T

    rng = np.random.default_rng(5)
    true = np.zeros(model.size)
    true[free] = small * np.linalg.cholesky(prior) @ rng.standard_normal(free.size)
    reference = small * TOLD.reference_velocity * rng.standard_normal((navigator.updates, 3))
    shown, tilt = navigator.errors(true)
    nothing, _ = navigator.errors(np.zeros(model.size))
    found = calibrate(
        navigator.measured(true),
        reference + nothing,  # what a perfect unit shows is the algorithm's, not the filter's
        latitude=latitude,
        start=navigator.start(true),
        model=model,
        prior=SPREAD,
        noise=TOLD,
    )
    data = (shown - nothing - reference).ravel()
    expected = to_end @ posterior @ velocity.T @ data / TOLD.reference_velocity**2
    state = found.state[-1].copy()
    state[:3] = tilt - attitude_error(found.attitude[-1], navigator.record.attitude[-1])
    state[3:6] = shown[-1] - found.velocity[-1]

    # The filter takes forces at the middle of each 0.2 s, and the local axes at each place for
    # those of the beginning of an update: 1e-3 of the deviations, the errors being some of them.
    units = np.sqrt(np.diag(covariance))
    correlation = (found.covariance[-1] - covariance) / np.outer(units, units)
    np.testing.assert_allclose(correlation, 0, atol=3e-3)
    np.testing.assert_allclose((state - expected) / (small * units), 0, atol=1e-2)
    # The bounds would mean nothing if there were little to find.
    assert (np.abs(expected) / (small * units)).max() > 100
    assert (units[6:] / standard_deviations[6:]).max() < 0.9


# What a calibration finds without noise, and keeps


WHOLE = Scheme(
    NINETEEN_POSITIONS.rotations, NINETEEN_POSITIONS.start, dwell=30.0, rate=np.radians(4)
)
SMALL = ImuErrors(
    np.array([3e-8, -2e-8, 5e-8]),
    1e-7 * np.array([[30.0, 10.0, -5.0], [10.0, -20.0, 15.0], [-5.0, 15.0, 40.0]]),
    np.array([2e-5, -1e-5, 3e-5]),
    1e-7 * np.array([[-20.0, 10.0, 25.0], [-35.0, 10.0, 5.0], [15.0, -40.0, 30.0]]),
)
"""Some hundredths of the usual errors, in the averaged axes already."""


@pytest.fixture(scope="module")
def record():
    return turntable_trajectory(WHOLE, LATITUDE, 0.25, multiple_of=24)


@pytest.fixture(scope="module")
def brief():
    """A record too short to find much, but the same filter."""
    return turntable_trajectory(Scheme("+90X -90Y", dwell=60.0), LATITUDE, 0.25, multiple_of=24)


def calibrated(
    record, imu_errors, phi=(0.0, 0.0, 0.0), frame="averaged", reference=None, **changes
):
    measured = measure(record.increments, imu_errors)
    if reference is None:
        reference = np.zeros((len(record.increments.angle) // 24, 3))
    settings = {
        "latitude": LATITUDE,
        "start": tilted(phi, record.attitude[0]),
        "model": ERROR_MODELS[frame],
        "prior": SPREAD,
        "noise": ImuNoise(),
    }
    return calibrate(measured, reference, **(settings | changes))


@pytest.fixture(scope="module")
def nothing(record):
    """A perfect unit, told as an ordinary one, with every update kept."""
    return calibrated(record, NO_ERRORS, keep=1)


def test_perfect_unit_has_no_errors_to_find(nothing):
    # Nothing but what steps of 2 degrees leave of rotating axes: 1/24 of their cube, a push.
    np.testing.assert_allclose(nothing.state[-1] / nothing.standard_deviations[-1], 0, atol=0.05)
    np.testing.assert_allclose(nothing.nis, 0, atol=1e-3)


def test_true_unit_is_found_without_noise(record):
    """An error of the estimate that no noise drives is a part of the error at first.

    Let it be A x. Then P is at least A P0 A^T, and by Cauchy's inequality each component of A x is
    at most sqrt(x^T P0^-1 x) of its deviation. A velocity good to 0.1 mm/s makes deviations small.
    """
    assumed_noise = ImuNoise(
        angle_random_walk=0.0, velocity_random_walk=0.0, reference_velocity=1e-4
    )
    phi = 1e-5 * np.array([1.0, -2.0, 1.5])
    model = ERROR_MODELS["averaged"]
    true = model.state(SMALL)
    first = model.covariance(SPREAD, record.attitude[0])
    kept = [0, 1, 2, *range(6, model.size)]
    at_first = np.concatenate([phi, true[6:]])
    size = np.sqrt(at_first @ np.linalg.solve(first[np.ix_(kept, kept)], at_first))
    # A perfect unit's estimate is an error of the algorithm's; the rest is of the unit.
    usual = calibrated(record, NO_ERRORS, noise=assumed_noise)
    found = calibrated(record, SMALL, phi, noise=assumed_noise)
    error = np.abs(found.state[-1] - usual.state[-1] - true)[6:]
    standard_deviations = found.standard_deviations[-1, 6:]
    assert (error < size * standard_deviations).all()


@pytest.fixture(scope="module")
def in_all_axes(record):
    """One usual unit, half of it and none of it, calibrated in each choice of axes."""
    rng = np.random.default_rng(3)
    phi = SPREAD.attitude * rng.standard_normal(3)
    imu_errors = random_imu_errors(SPREAD, rng)
    sizes = np.array([1.0, 0.5, 0.0])
    units = ImuErrors(*(np.multiply.outer(sizes, part) for part in imu_errors))
    return {frame: calibrated(record, units, np.outer(sizes, phi), frame) for frame in ERROR_MODELS}


@pytest.mark.parametrize("frame", [frame for frame in ERROR_MODELS if frame != "averaged"])
def test_estimates_in_other_axes_differ_by_the_change_of_axes(in_all_axes, record, frame):
    """To second order: half the errors leave a quarter of the difference."""
    usual, other = in_all_axes["averaged"], in_all_axes[frame]
    translated, turn = imu_errors_in_frame(usual.imu_errors, frame)
    scaled = (other.model.state(translated) - other.state[:, -1])[:, 6:]
    scaled = np.abs((scaled - scaled[2]) / other.standard_deviations[2, -1, 6:]).max(axis=-1)
    assert scaled[0] < 0.2
    # A quarter, and third order.
    assert scaled[0] / scaled[1] == pytest.approx(4, abs=0.4)
    # The attitude belongs to the axes. Their turn is of first order.
    attitude = attitude_of_axes(usual.attitude[:, -1], turn)
    phi = attitude_error(other.attitude[:, -1], attitude)
    apart = np.abs(phi - phi[2]) / other.standard_deviations[2, -1, :3]
    not_turned = attitude_error(other.attitude[0, -1], usual.attitude[0, -1])
    assert apart[0].max() < 0.2
    assert (np.abs(not_turned) / other.standard_deviations[2, -1, :3]).max() > 2


def test_attitude_and_velocity_found_are_those_of_the_table(record):
    """A start that is wrong by a minute of arc, and a unit that is right."""
    phi = np.array([[1.0, -1.0, 0.5], [0.0, 0.0, 0.0]]) * SPREAD.attitude
    found = calibrated(record, NO_ERRORS, phi, keep=1)
    places = np.round(found.times / record.increments.interval).astype(int)
    errors = attitude_error(found.attitude, record.attitude[places])
    # What each is wrong by counts from what the algorithm makes of a right start.
    errors = np.abs(errors[0] - errors[1]) / found.standard_deviations[1, :, :3]
    # The error is sqrt(1 + 1 + 1/4) of its deviations at first, and never more; see above.
    assert (errors <= 1.5 + 1e-3).all()
    # A quarter of an hour shows the level; what it shows of the heading is less than was known.
    assert (found.standard_deviations[1, -1, :2] < 0.1 * SPREAD.attitude).all()
    velocity = np.abs(found.velocity[0] - found.velocity[1]) / found.standard_deviations[1, :, 3:6]
    assert (velocity <= 1.5 + 1e-3).all()


# A second pass, linearised about the first


def test_a_second_pass_over_small_errors_finds_what_the_first_found(brief):
    """So the prior counts once: a record so short leaves most of what is known to it."""
    phi = 1e-6 * np.array([1.0, -2.0, 1.5])
    reference = 1e-3 * np.random.default_rng(6).standard_normal((34, 3))
    first = calibrated(brief, SMALL, phi, reference=reference)
    again = calibrated(brief, SMALL, phi, reference=reference, linearization_point=first)
    size = first.standard_deviations[-1]
    # Some hundredths of the usual errors: their squares are thousandths.
    np.testing.assert_allclose((again.state[-1] - first.state[-1]) / size, 0, atol=2e-3)
    np.testing.assert_allclose(again.standard_deviations[-1], size, rtol=2e-3)
    phi = attitude_error(again.attitude[-1], first.attitude[-1])
    np.testing.assert_allclose(phi / size[:3], 0, atol=2e-3)
    np.testing.assert_allclose((again.velocity - first.velocity)[-1] / size[3:6], 0, atol=2e-3)
    np.testing.assert_allclose(again.nis, first.nis, atol=2e-3 * first.nis.max())
    # Twice counted, the prior would make them smaller by up to the root of two.
    assert (
        size[6:] > 0.9 * np.sqrt(np.diag(first.model.covariance(SPREAD, [0, 0, 0, 1])))[6:]
    ).any()


PASSED = "averaged", "lower triangle"


@pytest.fixture(scope="module")
def three_passes(record):
    """A unit bent by 400 arc seconds, and its half, in two choices of axes: three passes."""
    drawn = random_imu_errors(PriorStandardDeviations(installation=2e-3), np.random.default_rng(4))
    units = ImuErrors(*(np.multiply.outer([1.0, 0.5], part) for part in drawn))
    found = {}
    for frame in PASSED:
        row = [calibrated(record, units, frame=frame, check=False)]
        for _ in range(2):
            row.append(
                calibrated(record, units, frame=frame, linearization_point=row[-1], check=False)
            )
        found[frame] = row
    return found


@pytest.mark.slow
@pytest.mark.parametrize("frame", PASSED)
def test_second_pass_takes_away_the_second_order_and_a_third_finds_nothing_more(
    three_passes, frame
):
    """Half of the errors leave a quarter of what the second pass finds: that is second order."""
    first, second, third = (found.state[:, -1, 6:] for found in three_passes[frame])
    size = three_passes[frame][0].standard_deviations[:, -1, 6:]
    changes = [np.abs((b - a) / size).max(axis=-1) for a, b in ((first, second), (second, third))]
    assert changes[0][0] > 1
    assert changes[0][0] / changes[0][1] == pytest.approx(4, abs=0.4)
    # The transition matrices are right within a hundredth; see the least squares above.
    assert (changes[1] < 0.01 * changes[0]).all()


@pytest.mark.parametrize("frame", PASSED[1:])
def test_after_a_second_pass_the_choice_of_axes_does_not_matter(three_passes, frame):
    apart = []
    for usual, other in zip(three_passes["averaged"], three_passes[frame], strict=True):
        translated, _ = imu_errors_in_frame(usual.imu_errors, frame)
        gap = (other.model.state(translated) - other.state[:, -1])[:, 6:]
        apart.append(np.abs(gap / other.standard_deviations[:, -1, 6:]).max(axis=-1))
    # In standard deviations that the filter states.
    assert apart[0][0] > 0.5
    assert apart[1][0] < 0.03
    assert apart[2][0] < 0.01


def test_a_pass_about_another_model_or_other_runs_is_refused(brief):
    first = calibrated(brief, SMALL)
    words = (
        r"^linearization_point: expected runs \(\) with the model 'upper triangle' of 27 states, "
        r"got \(\) with"
    )
    with pytest.raises(ValueError, match=words):
        calibrated(brief, SMALL, frame="upper triangle", linearization_point=first)
    two = ImuErrors(*(np.stack([part, part]) for part in SMALL))
    with pytest.raises(
        ValueError, match=r"^linearization_point: expected runs \(2,\) with .* got \(\) with"
    ):
        calibrated(brief, two, linearization_point=first)
    with pytest.raises(
        ValueError, match=r"^linearization_point: expected a Calibration\(.*\), got 'first'"
    ):
        calibrated(brief, SMALL, linearization_point="first")


# The history


def test_history_keeps_each_so_many_updates_and_the_last(brief):
    updates = len(brief.increments.angle) // 24
    every = calibrated(brief, SMALL, keep=1)
    np.testing.assert_allclose(every.times, 6.0 * np.arange(1, updates + 1), rtol=4 * EPS)
    assert every.nis.shape == (updates,)
    assert updates == 34
    for keep, kept in ((10, [10, 20, 30, 34]), (1, range(1, 35)), (100, [34])):
        found = calibrated(brief, SMALL, keep=keep)
        rows = np.array(kept) - 1
        for name in ("times", "state", "covariance", "attitude", "velocity", "standard_deviations"):
            # Other histories lie elsewhere in memory, so that in each update sums over the states
            # may be taken in another order.
            bound = updates * every.state.shape[-1] * EPS
            np.testing.assert_allclose(
                getattr(found, name), getattr(every, name)[rows], rtol=bound, err_msg=name
            )
        np.testing.assert_array_equal(found.nis, every.nis)


def test_deviations_of_the_sensor_errors_only_shrink(record, nothing):
    """No noise drives the errors of the sensors themselves."""
    model = nothing.model
    first = np.sqrt(np.diag(model.covariance(SPREAD, record.attitude[0])))
    every = np.concatenate([first[np.newaxis], nothing.standard_deviations])[:, 6:]
    assert (np.diff(every, axis=0) <= 1e-12 * every[:-1]).all()
    assert (every[-1] < 0.2 * every[0]).all()


# Several runs at once


def test_each_of_several_runs_is_the_run_alone(brief):
    rng = np.random.default_rng(7)
    units = random_imu_errors(SPREAD, rng, 2, 3)
    reference = 0.01 * rng.standard_normal((3, len(brief.increments.angle) // 24, 3))
    phi = SPREAD.attitude * rng.standard_normal((2, 3, 3))
    together = calibrated(brief, units, phi, reference=reference, keep=4)
    updates = reference.shape[-2]
    assert together.nis.shape == (2, 3, updates)
    for index in np.ndindex(2, 3):
        imu_errors = ImuErrors(*(part[index] for part in units))
        alone = calibrated(brief, imu_errors, phi[index], reference=reference[index[1]], keep=4)
        assert alone.state.shape == (len(alone.times), 27)
        # All runs are told that their attitudes are that of the first: wrong by 3e-4 or so.
        standard_deviations = alone.standard_deviations
        for one, many, units_of in (
            (alone.state, together.state[index], standard_deviations),
            (alone.standard_deviations, together.standard_deviations[index], standard_deviations),
            (alone.velocity, together.velocity[index], standard_deviations[:, 3:6]),
        ):
            np.testing.assert_allclose(one / units_of, many / units_of, rtol=0, atol=2e-3)
        apart = attitude_error(alone.attitude, together.attitude[index])
        np.testing.assert_allclose(apart / standard_deviations[:, :3], 0, atol=2e-3)
        np.testing.assert_allclose(alone.nis, together.nis[index], rtol=0, atol=1e-2)


# Refusals


EXACT = ImuNoise(reference_velocity=0.0)
GOOD = {
    "increments": Increments(0.25, np.full((24, 3), 1e-6), np.full((24, 3), [0.0, 0.0, 2.45])),
    "reference_velocity": np.zeros((4, 3)),
    "latitude": LATITUDE,
    "start": np.array([0.0, 0.0, 0.0, 1.0]),
    "model": ERROR_MODELS["averaged"],
    "prior": SPREAD,
    "noise": ImuNoise(),
}


@pytest.mark.parametrize(
    "shape", [(3,), (5, 3), (24, 3), (8, 3), (25, 3), (48, 3), (2, 7, 3)], ids=str
)
def test_updates_that_do_not_halve_evenly_are_refused(shape):
    """Also 24 updates of one increment, and 8 of three: a step of the navigation takes two."""
    with pytest.raises(
        ValueError,
        match=r"^reference_velocity: expected shape \(\.\.\., updates, 3\), with a number of "
        r"updates that divides 24 increments into even parts, "
        rf"got shape {re.escape(str(shape))}\. Velocities of other moments go with their "
        r"reference_times\.$",
    ):
        calibrate(**GOOD | {"reference_velocity": np.zeros(shape)})
    calibrate(**GOOD | {"reference_velocity": np.zeros((12, 3)), "check": False})


def test_a_table_that_stands_is_looked_at_each_second_if_nothing_is_said():
    ends, velocities = _updates(4000, 0.001, None, None, None)
    assert list(ends) == [1000, 2000, 3000, 4000]
    np.testing.assert_array_equal(velocities, np.zeros((4, 3)))


def test_half_an_interval_after_the_start_is_a_time_of_a_reference():
    ends, velocities = _updates(8, 0.25, [[1.0, 2.0, 3.0]] * 2, [0.125, 2.0], None)
    assert list(ends) == [2, 8]
    np.testing.assert_array_equal(velocities, [[1.0, 2.0, 3.0]] * 2)
    with pytest.raises(
        ValueError, match=r"from half an interval, 0\.125 s, to 2 s, got .* 0\.12 to"
    ):
        _updates(8, 0.25, None, [0.12, 2.0], None)


NOT_FINITE = "finite numbers, got 1 NaN or infinite"


def with_nan(name):
    argument, _, field = name.partition(".")
    bad = np.array(getattr(GOOD[argument], field, GOOD[argument]), dtype=float)
    bad.flat[-1] = np.nan
    return bad


@pytest.mark.parametrize(
    ("name", "bad", "words"),
    [
        *(
            (name, with_nan(name), NOT_FINITE)
            for name in (
                "increments.angle",
                "increments.velocity",
                "reference_velocity",
                "start",
                "increments.interval",
                "latitude",
            )
        ),
        ("increments.angle", np.ones((24, 2)), r"shape \(\.\.\., 3\), got shape \(24, 2\)"),
        ("start", [0.0, 0.0, 1.0], r"shape \(\.\.\., 4\), got shape \(3,\)"),
        ("latitude", np.pi / 2, "at most 89.9 degrees from the equator"),
        ("increments.interval", 0.0, "a positive number, got 0.0"),
        ("increments.interval", 20.5, "a positive time of at most 20 s, got 20.5"),
        ("noise", EXACT, r"a deviation of the reference velocity above 0, got 0\.0 m/s\.$"),
        ("keep", 0, "a whole number of at least 1, got 0"),
        ("increments.velocity", np.ones((20, 3)), "as many as increments.angle"),
    ],
)
def test_bad_arguments_are_refused_by_name(name, bad, words):
    with pytest.raises(ValueError, match=f"^{name}: expected {words}"):
        calibrate(**replaced(GOOD, {name: bad}))


def test_biases_that_lead_astray_are_told_how_to_do_without():
    """Degrees a second in the gyros, and updates so seldom that the first one turns the unit."""
    true = turntable_trajectory(Scheme("+90X -90X +90Y", dwell=20.0), 0.9, 0.5)
    bias = np.radians([3.0, -2.0, 1.0])
    with pytest.raises(ValueError, match=r"^prior: .* got a gyro_bias of 0\.0524 .* mean at rest"):
        calibrate(
            measure(true.increments, NO_ERRORS._replace(gyro_bias=bias)),
            latitude=0.9,
            start=true.attitude[0],
            model="averaged",
            prior=PriorStandardDeviations(gyro_bias=np.radians(3.0)),
            noise=ImuNoise(),
            update_interval=20.0,
            check=False,
        )


def test_what_was_found_can_be_written_in_other_units_without_changing_the_history():
    table = TurntableTrial(sample_interval=0.5, update_interval=10.0, states=("lever arms",))
    calibration = table.run(np.random.default_rng(1)).calibration
    history = calibration.state.copy()
    found, higher = calibration.imu_errors, calibration.model.higher_order_errors(history)
    for part in (*found, higher.lever_arms):
        part *= 206265.0
    np.testing.assert_array_equal(calibration.state, history)
