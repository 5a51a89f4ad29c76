"""What must stand beside the picture of each panel, computed without the panel and its figure.

`expected_numbers` goes from the values of a panel's controls straight to the numerics; a number on
display may differ from its result by rounding only.
"""

import html
import re
from collections.abc import Callable, Mapping

import numpy as np
import pytest
from scipy.constants import arcminute, arcsecond, degree, g, hour, micro, milli

from driftlab.algorithm_table import ALGORITHMS, coning_drift
from driftlab.attitude_algorithms import integrate
from driftlab.cayley import cayley_vector
from driftlab.compass_voyage import ship, take_along
from driftlab.drift import (
    direction_from_angles,
    drift_per_turn,
    exact_roots,
    measured_rate,
    principal_drifts,
)
from driftlab.error_model import ERROR_MODELS, FULL
from driftlab.explorers import larin
from driftlab.figures import calibration_run, turn_estimates
from driftlab.gyrocompass import align
from driftlab.horizon_axes import attitude_from_angles
from driftlab.installation import misalignment_vector, skew_matrix, split
from driftlab.motions import Coning, FixedAxis, Sway
from driftlab.observability import expected_covariance, null_directions, passage
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotation_angle
from driftlab.sensors import Noise, Spread
from driftlab.turn_calibration import TurnExperiment, fit_turns, weighing
from driftlab.turntable import Scheme
from driftlab.voyage import sensed_at_rest
from driftlab.word_length import integrate_in_word

Values = Mapping[str, float | int | bool | str]
Numbers = dict[str, tuple[float, ...]]
"""By name, the first numbers of what stands after it."""

NUMBER = r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?"


def shown_numbers(table: str) -> list[tuple[str, str]]:
    """Names and values in the HTML of a panel's table."""
    pairs = re.findall(r">([^<>]*) <b>([^<>]*)</b>", table)
    return [(html.unescape(name), html.unescape(value)) for name, value in pairs]


def assert_shown(explorer: str, values: Values, shown: list[tuple[str, str]]) -> None:
    """Fail unless the numbers of a panel are the numerics' own, rounded."""
    expected = expected_numbers(explorer, values)
    assert expected, "nothing to compare with"
    for name, numbers in expected.items():
        (text,) = (value for shown_name, value in shown if shown_name == name)
        found = re.findall(NUMBER, text)[: len(numbers)]
        assert len(found) == len(numbers), f"{name}: {text}"
        for digits, number in zip(found, numbers, strict=True):
            mantissa, _, exponent = digits.partition("e")
            place = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
            assert float(digits) == pytest.approx(number, abs=0.51 * place, rel=1e-9), name


def expected_numbers(explorer: str, values: Values) -> Numbers:
    """Numbers for the values of an explorer, named by its class."""
    return BY_EXPLORER[explorer](values)


def listed(values: Values, names: str) -> np.ndarray:
    return np.array([values[name] for name in names.split()], dtype=float)


def axis_of(values: Values) -> np.ndarray:
    return direction_from_angles(*np.radians(listed(values, "azimuth elevation")))


def error_motion(values: Values) -> Numbers:
    rate = np.radians(listed(values, "rate1 rate2 rate3"))
    measured = rate + np.radians(listed(values, "error1 error2 error3"))
    fast, *_, slow = sorted(np.degrees(exact_roots(rate, measured).imag), reverse=True)
    sizes = np.degrees(np.linalg.norm([rate, measured], axis=-1))
    assert fast == pytest.approx(-slow)
    return {
        "true rate": (sizes[0],),
        "measured rate": (sizes[1],),
        "their sum, fast": (fast,),
        "their difference, slow": (sizes[1] - sizes[0],),
    }


def roots(values: Values) -> Numbers:
    rate = axis_of(values)
    misalignment = values["size"] * np.array(larin.SHAPES[values["shape"]])
    measured = measured_rate(rate, misalignment)
    slow = np.linalg.norm(measured) - np.linalg.norm(rate)
    return {"exact": (exact_roots(rate, measured).imag.max(), slow)}


def drift(values: Values) -> Numbers:
    entries = [values[f"m{row}{column}"] for row in (1, 2, 3) for column in (1, 2, 3)]
    misalignment = 1e-3 * np.reshape(entries, (3, 3))
    extremes, _ = principal_drifts(misalignment, exact=True)
    worst = 2 * np.pi * extremes[np.abs(extremes).argmax()]
    return {
        "drift a turn, exact": (drift_per_turn(axis_of(values), misalignment) / arcminute,),
        "drift a turn about the worst axis": (worst / arcminute,),
    }


def turn_calibration(values: Values) -> Numbers:
    s1, s2, s3, skew, scale = 1e-3 * listed(values, "sigma1 sigma2 sigma3 skew scale")
    triad = np.array(
        [[scale, s1, s2 - skew], [s1, scale, s3 + skew], [s2 + skew, s3 - skew, scale]]
    )
    plan = turn_estimates.PLANS[values["plan"]]
    noise = values["noise"] * arcsecond
    experiment = TurnExperiment(values["turns"], values["steps"], values["formula"], noise)
    runs = 12 if noise else 1
    axes = np.tile(plan.axes, (runs, 1, 1))
    estimates = experiment.estimate(triad, axes, np.random.default_rng(1987))
    if plan.method == "yates":
        found = weighing(estimates * [1, 1, 1, 1.5])
    else:
        found = fit_turns(estimates, plan.axes, plan.method).sigma
    suffix = f" true, found{f', mean of {runs}' if noise else ''}, 1e-3"
    return {
        f"σ{index}{suffix}": (1e3 * true, 1e3 * mean)
        for index, true, mean in zip("₁₂₃", (s1, s2, s3), found.mean(axis=0), strict=True)
    }


def cayley_map(values: Values) -> Numbers:
    angle = values["angle"]
    rotation = from_rotation_vector(np.radians(angle) * axis_of(values))
    singular = {"dimension 3": abs(angle) == 180, "dimension 4": abs(angle) == 360}
    vectors = {name: cayley_vector(rotation, int(name[-1])) for name in singular}
    return {name: () if singular[name] else tuple(vectors[name]) for name in singular}


def algorithm_laboratory(values: Values) -> Numbers:
    kinds = {"coning": Coning, "swaying ship": Sway, "fixed axis": FixedAxis}
    motion = kinds[values["motion"]](np.radians(values["amplitude"]), values["frequency"])
    rate, short = values["rate"], values["word"] == "32 bits"
    increments = motion.increments(1 / rate, 2 * rate)
    numbers = {}
    for name in (name for name in ALGORITHMS if values[name]):
        method = integrate_in_word if short else integrate
        attitude = method(increments, name, start=motion.attitude(0.0))
        ends = np.arange(1, len(attitude) + 1) * (2 * rate // len(attitude)) / rate
        error = rotation_angle(multiply(conjugate(motion.attitude(ends)), attitude))
        numbers[name] = (error.max() / arcsecond,)
    return numbers


def split_triad(values: Values) -> Numbers:
    units = np.where(np.eye(3, dtype=bool), micro, arcsecond)
    matrix = units * [[values[f"k{row}{column}"] for column in "xyz"] for row in "xyz"]
    _, symmetric, _ = split(matrix)
    return {
        "scale y": (matrix[1, 1] / micro,),
        "non-orthogonality xz": (symmetric[0, 2] / arcsecond,),
        "misalignment about z": (misalignment_vector(matrix)[2] / arcsecond,),
    }


def observability(values: Values) -> Numbers:
    x, y, z = values["start"].split()
    scheme = Scheme(values["rotations"], (x, y, z), values["dwell"], np.radians(values["rate"]))
    states = values["states"]
    model = FULL if states == "all 30" else ERROR_MODELS[states.removeprefix("27, ")]
    way = passage(scheme, np.radians(values["latitude"]), model)
    noise = Noise(
        values["gyro"] * 1e-3 * degree / np.sqrt(hour),
        values["accelerometer"] * micro * g,
        values["velocity"] * milli,
    )
    deviations = np.sqrt(np.diag(expected_covariance(way, noise, Spread())))
    size = len(model.names)
    return {
        "rank": (size - len(null_directions(way).directions), size),
        "gyro bias x, y, z": tuple(deviations[6:9] / (degree / hour)),
    }


def calibration(values: Values) -> Numbers:
    found = calibration_run.trial(values["frame"]).calibration
    at = np.abs(found.times - 60 * values["minute"]).argmin()
    state = 6 + calibration_run.PARAMETERS.index(values["parameter"])
    name = found.model.names[state]
    unit = arcsecond if "orthogonality" in name or "installation" in name else micro
    if "bias" in name:
        unit = degree / hour if "gyro" in name else micro * g
    three = 3 * found.deviations[at, state]
    return {"estimate": (found.state[at, state] / unit,), "three deviations": (three / unit,)}


def alignment_budget(values: Values) -> Numbers:
    angles = np.radians(listed(values, "heading pitch roll"))
    if abs(values["pitch"]) == 90:
        return {"attitude error, exact": ()}  # no heading, and no number that must be there
    rate, force = sensed_at_rest(attitude_from_angles(*angles), np.radians(values["latitude"]))
    drifts = listed(values, "gyro_forward gyro_up gyro_right") * degree / hour
    offsets = listed(values, "acc_forward acc_up acc_right") * milli * g
    error = align(rate + drifts, force + offsets).heading - angles[0]
    return {"exact": (np.degrees((error + np.pi) % (2 * np.pi) - np.pi),)}


def gyrocompass(values: Values) -> Numbers:
    latitude, course, turn = np.radians(listed(values, "latitude course turn"))
    run = take_along(
        ship(latitude, values["speed"], course, turn, 4.0),
        listed(values, "gyro_forward gyro_up gyro_right") * degree / hour,
        tuning_factor=values["tuning"],
        damping=values["damping"],
        tilt=values["tilt"] * arcminute,
        log=values["log"],
    )
    return {
        "at the end": (np.degrees(run.heading_error[-1]),),
        "largest tilt about North": (np.abs(run.tilt[:, 0]).max() / arcminute,),
        "yaw error at the end": (np.degrees(run.yaw_error[-1]),),
    }


def capstone(values: Values) -> Numbers:
    xy, xz, yz = listed(values, "pair_0 pair_1 pair_2") * arcsecond
    turned = skew_matrix(listed(values, "turn_forward turn_up turn_right") * arcsecond)
    bent = np.array([[0, xy, xz], [xy, 0, yz], [xz, yz, 0]]) + turned
    axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [1, 0, 1], [0, 1, 1]]
    cone = coning_drift(values["algorithm"], values["cone"] * arcminute, 5.0, 0.01)
    way = ship(*np.radians([values["latitude"]]), 10.0, 0.0, np.radians(values["turn"]), 16.0)
    rates = way.angle_increments / way.interval
    run = take_along(way, rates @ bent.T + np.array([0, 0, cone]), log=True)
    return {
        "drift in a turn, as built": (np.abs(drift_per_turn(axes, bent)).max() / arcsecond,),
        "under way, as built": (np.degrees(np.abs(run.heading_error).max()),),
    }


BY_EXPLORER: dict[str, Callable[[Values], Numbers]] = {
    "ErrorMotionExplorer": error_motion,
    "RootsExplorer": roots,
    "DriftExplorer": drift,
    "TurnCalibrationExplorer": turn_calibration,
    "CayleyMapExplorer": cayley_map,
    "AlgorithmLaboratoryExplorer": algorithm_laboratory,
    "SplitExplorer": split_triad,
    "ObservabilityExplorer": observability,
    "CalibrationRunExplorer": calibration,
    "AlignmentBudgetExplorer": alignment_budget,
    "GyrocompassExplorer": gyrocompass,
    "CapstoneExplorer": capstone,
}
