"""`calibrate` does not believe everything: slips on purpose are named, and no right run is doubted.

Each slip is made on one of three schemes, with a reference velocity that has noise or at a table
that stands; all 156 combinations were tried once.
"""

import re
import warnings

import numpy as np
import pytest
from scipy.constants import arcsecond, g

from driftlab.calibration import (
    ERROR_MODELS,
    Calibration,
    InconsistentWarning,
    calibrate,
    innovation_test,
)
from driftlab.calibration._contradictions import Expected, evidence
from driftlab.calibration._slips import FITS
from driftlab.imu import NO_ERRORS, TYPICAL_ERRORS, ImuNoise, PriorDeviations, random_imu_errors
from driftlab.increments import Increments, measure
from driftlab.motion import SCHEMES, Scheme, table_trajectory
from driftlab.quaternion import conjugate, from_rotation_vector, multiply

LATITUDE = float(np.radians(37.5))
STEP = 0.75
"""Samples of a table that turns by 2.25 degrees in one; the filter looks every half minute."""
SIX = Scheme("+90X +90X +90Y +90Y +90Z", ("North", "West", "Up"), dwell=720.0)
RECORDS = {
    name: table_trajectory(
        Scheme(scheme.rotations, scheme.start, scheme.dwell / 4, np.radians(3.0)),
        LATITUDE,
        STEP,
        multiple_of=40,
    )
    for name, scheme in {**SCHEMES, "six positions": SIX}.items()
}


def told(scheme="19 positions", noisy=True, seed=1, prior=None, errors=TYPICAL_ERRORS):
    """Arguments of a right run."""
    record, rng = RECORDS[scheme], np.random.default_rng(seed)
    prior = PriorDeviations() if prior is None else prior
    noise = ImuNoise()
    measured = measure(record.increments, errors, noise, rng)
    tilt = from_rotation_vector(prior.attitude * rng.standard_normal(3))
    updates = measured.angle.shape[-2] // 40
    return {
        "increments": measured,
        "reference_velocity": noisy * noise.reference_velocity * rng.normal(size=(updates, 3)),
        "latitude": LATITUDE,
        "start": multiply(tilt, record.attitude[0]),
        "model": ERROR_MODELS["averaged"],
        "prior": prior,
        "noise": noise,
        "keep": 10**6,
    }


def scaled(angle=1.0, velocity=1.0, interval=1.0):
    return lambda run: (
        run
        | {
            "increments": Increments(
                run["increments"].interval * interval,
                run["increments"].angle * angle,
                run["increments"].velocity * velocity,
            )
        }
    )


def turned(angle, velocity):
    """Axes of the log in some order and with some signs: matrices or diagonals."""
    a, v = (np.diag(m) if np.ndim(m) == 1 else np.asarray(m, float) for m in (angle, velocity))
    return lambda run: (
        run
        | {
            "increments": Increments(
                STEP, run["increments"].angle @ a.T, run["increments"].velocity @ v.T
            )
        }
    )


def started(change):
    return lambda run: run | {"start": change(run["start"])}


def turned_about(axis, degrees):
    turn = from_rotation_vector(np.radians(degrees) * np.eye(3)[axis])
    return started(lambda start: multiply(turn, start))


NED = np.array([1.0, 1.0, 0.0, 0.0]) / np.sqrt(2)
FRD, SAME = [1, -1, -1], [1, 1, 1]
SWAPPED = np.eye(3)[[1, 0, 2]]
SLIPS = {
    "rates and forces": (
        scaled(1 / STEP, 1 / STEP),
        "rates taken for increments and .*specific force taken for increments",
    ),
    "rates alone": (scaled(1 / STEP), "gyros: rates taken for increments"),
    "degrees": (scaled(180 / np.pi), "gyros: degrees taken for radians"),
    "rates in degrees, forces": (
        scaled(180 / np.pi / STEP, 1 / STEP),
        "rates in degrees .* and accelerometers: specific force taken",
    ),
    "m/s^2 for m/s": (scaled(1, 1 / STEP), "accelerometers: specific force taken"),
    "g": (scaled(1, 1 / STEP / g), "specific force in g taken"),
    "mg": (scaled(1, 1000 / STEP / g), "specific force in mg taken"),
    "g s for m/s": (scaled(1, 1 / g), r"g\*s taken for m/s"),
    "exchanged": (
        lambda run: (
            run
            | {
                "increments": run["increments"]._replace(
                    angle=run["increments"].velocity, velocity=run["increments"].angle
                )
            }
        ),
        "gyros and accelerometers exchanged",
    ),
    "FRD": (turned(FRD, FRD), "x, -y, -z would be right"),
    "left-handed": (turned(SWAPPED, SWAPPED), "y, x, z would be right .left-handed"),
    "gyros with the other sign": (turned([-1, -1, -1], SAME), "gyros alone: -x, -y, -z"),
    "one gyro with the other sign": (turned([1, 1, -1], SAME), "gyros alone: x, y, -z"),
    "gravity for specific force": (turned(SAME, [-1, -1, -1]), "accelerometers alone: -x, -y"),
    "scalar first": (started(lambda q: np.roll(q, 1)), "scalar first"),
    "inverted": (started(conjugate), "from East, North, Up to the body"),
    "North, East, Down": (started(lambda q: multiply(conjugate(NED), q)), "North, East, Down"),
    "North, Up, East": (
        started(lambda q: multiply(conjugate(np.full(4, 0.5)), q)),
        "North, Up, East",
    ),
    "heading by 5 degrees": (turned_about(2, 5.0), "heading wrong by (4.9|5)"),
    "heading by 90 degrees": (
        turned_about(2, -90.0),
        "heading wrong by (89.9|90)|z, -x|-z, y|z, x",
    ),
    "tilt by 5 degrees": (turned_about(0, 5.0), "an attitude wrong by (4.9|5)"),
    "latitude's sign": (lambda run: run | {"latitude": -LATITUDE}, "latitude: the other sign"),
    "latitude too small": (
        lambda run: run | {"latitude": np.radians(LATITUDE)},
        "turned into radians twice",
    ),
    "another place": (lambda run: run | {"latitude": 0.9}, "latitude: 3[678].* degrees fits"),
    "interval by 1 %": (scaled(interval=1.01), r"interval: 0\.75 s instead of 0\.7575 s"),
    "interval twice": (scaled(interval=2.0), r"interval: 0\.75 s instead of 1\.5 s"),
}
NAMES = list(RECORDS)


def sentence_of(run):
    """The warning; the filter goes no further."""
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("error", InconsistentWarning)
        with pytest.raises(InconsistentWarning) as caught:
            calibrate(**run)
    return str(caught.value)


@pytest.mark.slow
@pytest.mark.parametrize(("slip", "place"), [(slip, k) for k, slip in enumerate(SLIPS)])
def test_slip_is_named(slip, place):
    change, words = SLIPS[slip]
    run = told(NAMES[place % 3], noisy=place % 2 == 0)
    sentence = sentence_of(change(run))
    assert re.search(words, sentence), sentence
    assert re.match(r"calibration: expected .* (to|within) \S+.*, got \S+[:;] ", sentence)


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
    test = innovation_test(calibrate(**noisy))
    assert (test.verdict == "consistent").all()
    # Squares, means and correlations scatter as they should: within four deviations of a mean.
    count = 3 * noisy["reference_velocity"].shape[-2] * 40
    assert abs(test.squares.mean() - 1) < 4 * np.sqrt(2 / count)
    assert abs(test.mean.mean() - 1) < 4 * np.sqrt(2 / 3 / 40)
    assert abs(test.correlation.mean()) < 4 / np.sqrt(count)
    assert (innovation_test(calibrate(**still)).verdict == "too cautious").all()
    expected = Expected(noisy["prior"], noisy["noise"], 0.03)
    for rows, start in zip(zip(*noisy["increments"][1:], strict=True), noisy["start"], strict=True):
        assert evidence(Increments(STEP, *rows)).misfit(start, LATITUDE, expected) < 0.8 * FITS


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
