"""What must stand beside the picture of each panel, computed without the panel and its figure.

`expected_rows` goes from the values of a panel's controls straight to the numerics. What is on
display must be the same words and units, with as many digits; only the last one may differ by one.
"""

import html
import re
from collections.abc import Callable, Mapping

import numpy as np
from scipy.constants import arcminute, arcsecond, degree, g, hour, micro, milli

from driftlab.algorithm_table import ALGORITHMS, coning_drift
from driftlab.attitude_algorithms import integrate
from driftlab.cayley import cayley_vector
from driftlab.compass_voyage import ship, take_along
from driftlab.drift import (
    asymptotic_roots,
    direction_from_angles,
    drift_per_turn,
    exact_roots,
    measured_rate,
    principal_drifts,
)
from driftlab.error_model import ERROR_MODELS, FULL
from driftlab.figures import calibration_run, turn_estimates
from driftlab.gyrocompass import align, alignment_attitude_error, alignment_errors
from driftlab.horizon_axes import attitude_from_angles, wrapped
from driftlab.installation import skew_matrix
from driftlab.motions import Coning, FixedAxis, Sway
from driftlab.observability import expected_covariance, null_directions, passage
from driftlab.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    rotate,
    rotation_angle,
)
from driftlab.sensors import Noise, Spread
from driftlab.turn_calibration import TurnExperiment, fit_turns, weighing
from driftlab.turntable import Scheme
from driftlab.voyage import sensed_at_rest
from driftlab.word_length import integrate_in_word

Values = Mapping[str, float | int | bool | str]
Rows = list[tuple[str, str]]
"""Names and what stands after them, in the order of the panel."""

NUMBER = r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
# Larin's shapes of the deformation, once more, from his paper and the chapter.
SHAPES = {
    "symmetric": np.ones((3, 3)) - np.eye(3),
    "skew": np.cross(np.eye(3), [-1.0, -1.0, -1.0]),
    "third axis bent, as in Larin's table": np.outer([0, 0, 1], [1, -1, 0]),
    "x leans to axis 2 only": np.outer([1, 0, 0], [0, 1, 0]),
    "scale factor of all three": np.eye(3),
}


def shown_numbers(table: str) -> Rows:
    """Names and values in the HTML of a panel's table."""
    pairs = re.findall(r">([^<>]*) <b>([^<>]*)</b>", table)
    return [(html.unescape(name), html.unescape(value)) for name, value in pairs]


def assert_shown(explorer: str, values: Values, shown: Rows) -> None:
    """Fail unless what a panel shows is what the numerics give."""
    for _, text in shown:
        assert not re.search(r"-0(\.0*)?(?![\d.])", text), f"a negative zero: {text}"
    rows = list(shown)
    expected = BY_EXPLORER[explorer](values)
    assert expected, "nothing to compare with"
    for name, text in expected:
        at = next((i for i, row in enumerate(rows) if row[0] == name), None)
        assert at is not None, f"{name} is missing"
        assert_same_text(rows[at][1], text, name)
        del rows[: at + 1]


def assert_same_text(shown: str, expected: str, name: str) -> None:
    """Fail unless two texts differ by rounding only."""
    assert re.sub(NUMBER, "#", shown) == re.sub(NUMBER, "#", expected), f"{name}: {shown}"
    pairs = zip(re.findall(NUMBER, shown), re.findall(NUMBER, expected), strict=True)
    for ours, theirs in pairs:
        digits = [len(number.partition("e")[0].partition(".")[2]) for number in (ours, theirs)]
        assert digits[0] == digits[1], f"{name}: {shown}, expected {expected}"
        place = 10.0 ** (int(theirs.partition("e")[2] or 0) - digits[1])
        assert abs(float(ours) - float(theirs)) < 1.01 * place, f"{name}: {shown} not {expected}"


def listed(values: Values, names: str) -> np.ndarray:
    return np.array([values[name] for name in names.split()], dtype=float)


def axis_of(values: Values) -> np.ndarray:
    return direction_from_angles(*np.radians(listed(values, "azimuth elevation")))


def error_motion(values: Values) -> Rows:
    rate = np.radians(listed(values, "rate1 rate2 rate3"))
    measured = rate + np.radians(listed(values, "error1 error2 error3"))
    fast = np.degrees(exact_roots(rate, measured).imag.max())
    sizes = np.degrees(np.linalg.norm([rate, measured], axis=-1))
    return [
        ("true rate", f"{sizes[0]:.3f} deg/s"),
        ("measured rate", f"{sizes[1]:.3f} deg/s"),
        ("their sum, fast", f"{fast:.3f} deg/s"),
        ("their difference, slow", f"{sizes[1] - sizes[0]:.3f} deg/s"),
    ]


def roots(values: Values) -> Rows:
    rate = axis_of(values)
    misalignment = values["size"] * SHAPES[values["shape"]]
    measured = measured_rate(rate, misalignment)
    slow = np.linalg.norm(measured) - np.linalg.norm(rate)
    first, second = (asymptotic_roots(rate, misalignment, order=n).imag for n in (1, 2))
    return [
        (name, f"{fast:.9f} i, {slow:.9f} i")
        for name, fast, slow in (
            ("exact", exact_roots(rate, measured).imag.max(), slow),
            ("first order, (2.2)", first[0], first[2]),
            ("with the next term", second[0], second[2]),
        )
    ]


def drift(values: Values) -> Rows:
    entries = [values[f"m{row}{column}"] for row in (1, 2, 3) for column in (1, 2, 3)]
    misalignment = 1e-3 * np.reshape(entries, (3, 3))
    axis = axis_of(values)
    first_order = 2 * np.pi * axis @ misalignment @ axis
    extremes, _ = principal_drifts(misalignment, exact=True)
    worst = 2 * np.pi * extremes[np.abs(extremes).argmax()]
    return [
        ("drift a turn, exact", f"{drift_per_turn(axis, misalignment) / arcminute:.3f} arcmin"),
        ("first order", f"{first_order / arcminute:.3f} arcmin"),
        ("drift a turn about the worst axis", f"{worst / arcminute:.3f} arcmin"),
    ]


def turn_calibration(values: Values) -> Rows:
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
    return [
        (f"σ{index}{suffix}", f"{1e3 * true:.3f}, {1e3 * mean:.6f}")
        for index, true, mean in zip("₁₂₃", (s1, s2, s3), found.mean(axis=0), strict=True)
    ]


def cayley_map(values: Values) -> Rows:
    angle = abs(values["angle"])
    rotation = from_rotation_vector(np.radians(values["angle"]) * axis_of(values))

    def both(name: str, sign: int, dimension: int, infinite: bool) -> Rows:
        if infinite:
            return [(name, "infinite"), ("length", "infinite")]
        vector = cayley_vector(sign * rotation, dimension)
        words = ", ".join(f"{entry:.3f}" for entry in vector)
        return [(name, f"({words})"), ("length", f"{np.linalg.norm(vector):.4f}")]

    return [
        *both("dimension 3", 1, 3, angle == 180),
        ("from its singularity", f"{abs(angle - 180):.0f}°"),
        *both("dimension 4", 1, 4, angle == 360),
        ("from its singularity", f"{360 - angle:.0f}°"),
        *both("shadow", -1, 4, angle == 0),
    ]


def algorithm_laboratory(values: Values) -> Rows:
    kinds = {"coning": Coning, "swaying ship": Sway, "fixed axis": FixedAxis}
    motion = kinds[values["motion"]](np.radians(values["amplitude"]), values["frequency"])
    short = values["word"] == "32 bits"
    method = integrate_in_word if short else integrate
    floor = 1e-5 if short else 1e-12
    rows = []
    for name in (name for name in ALGORITHMS if values[name]):
        worst = {}
        for rate in (12, 24, 48, 96, 192):
            attitude = method(
                motion.increments(1 / rate, 2 * rate), name, start=motion.attitude(0.0)
            )
            ends = np.arange(1, len(attitude) + 1) * (2 * rate // len(attitude)) / rate
            error = rotation_angle(multiply(conjugate(motion.attitude(ends)), attitude))
            worst[rate] = error.max()
        seen = {rate: error for rate, error in worst.items() if floor < error < 1e-2}
        order = "none"
        if len(seen) > 2:
            order = f"{-np.polyfit(np.log(list(seen)), np.log(list(seen.values())), 1)[0]:.2f}"
        rows.append((name, f"{worst[values['rate']] / arcsecond:.2e}″, order {order}"))
    return rows


def split_triad(values: Values) -> Rows:
    units = np.where(np.eye(3, dtype=bool), micro, arcsecond)
    matrix = units * [[values[f"k{row}{column}"] for column in "xyz"] for row in "xyz"]
    rows = []
    for i, (j, k) in enumerate(((0, 1), (0, 2), (1, 2))):
        # The vector of a skew matrix: K_zy, K_xz, K_yx less their mirrors, halved.
        a, b = (i + 2) % 3, (i + 1) % 3
        turned = 0.5 * (matrix[a, b] - matrix[b, a])
        rows += [
            (f"scale {'xyz'[i]}", f"{matrix[i, i] / micro:.1f} ppm"),
            (
                f"non-orthogonality {'xyz'[j]}{'xyz'[k]}",
                f"{0.5 * (matrix[j, k] + matrix[k, j]) / arcsecond:.1f}″",
            ),
            (f"misalignment about {'xyz'[i]}", f"{turned / arcsecond:.1f}″"),
        ]
    return rows


def observability(values: Values) -> Rows:
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
    after = dict(
        zip(model.names, np.sqrt(np.diag(expected_covariance(way, noise, Spread()))), strict=True)
    )

    def row(kind: str, size: float, unit: str) -> tuple[str, str]:
        found = (f"{after[f'{kind} {axis}'] / size:.2g}" for axis in "xyz")
        return f"{kind} x, y, z", f"{', '.join(found)} {unit}"

    dark = null_directions(way)
    size = len(model.names)
    return [
        ("rank", f"{size - len(dark.directions)} of {size}"),
        *(("in the dark", words) for words in dark.words),
        row("gyro bias", degree / hour, "deg/h"),
        row("gyro scale", micro, "ppm"),
        row("accelerometer bias", micro * g, "µg"),
        row("accelerometer scale", micro, "ppm"),
    ]


def calibration(values: Values) -> Rows:
    trial = calibration_run.trial(values["frame"])
    found = trial.calibration
    at = np.abs(found.times - 60 * values["minute"]).argmin()
    state = 6 + calibration_run.PARAMETERS.index(values["parameter"])
    name = found.model.names[state]
    size, unit = micro, "ppm"
    if "bias" in name:
        size, unit = (degree / hour, "deg/h") if "gyro" in name else (micro * g, "µg")
    if "orthogonality" in name or "installation" in name:
        size, unit = arcsecond, "arc seconds"
    estimate, three = found.state[at, state] / size, 3 * found.deviations[at, state] / size
    return [
        ("moment", f"{found.times[at] / 60:.1f} min"),
        ("estimate", f"{estimate:.4f} {unit}"),
        ("true", f"{estimate + trial.errors[at, state] / size:.4f} {unit}"),
        ("error", f"{trial.errors[at, state] / size:.4f} {unit}"),
        ("three deviations", f"{three:.4g} {unit}"),
    ]


def alignment_budget(values: Values) -> Rows:
    angles = np.radians(listed(values, "heading pitch roll"))
    latitude = np.radians(values["latitude"])
    drifts = listed(values, "gyro_forward gyro_up gyro_right") * degree / hour
    offsets = listed(values, "acc_forward acc_up acc_right") * milli * g
    attitude = attitude_from_angles(*angles)
    rate, force = sensed_at_rest(attitude, latitude)
    true, found = align(rate, force), align(rate + drifts, force + offsets)
    turned = rotation_angle(multiply(found.attitude, conjugate(true.attitude)))
    if abs(values["pitch"]) == 90:  # no heading and no roll; a pitch that can only fall
        return [
            ("sum, first order", "none"),
            ("exact", "none"),
            ("roll error, exact", "none"),
            ("attitude error, exact", f"{np.degrees(turned):.4f}°"),
        ]
    local = rotate(attitude, drifts), rotate(attitude, offsets)
    formula = alignment_errors(angles[0], angles[1], latitude, *local)

    def exact(name: str) -> str:
        return f"{np.degrees(wrapped(getattr(found, name) - getattr(true, name))):.4f}°"

    first_order = alignment_attitude_error(latitude, *local)
    return [
        *zip(
            (
                "east gyro",
                "east acc., tan pitch",
                "north acc., tan pitch",
                "east acc., tan latitude",
            ),
            (f"{np.degrees(term):.4f}°" for term in formula.heading_terms),
            strict=True,
        ),
        ("sum, first order", f"{np.degrees(formula.heading):.4f}°"),
        ("exact", exact("heading")),
        ("pitch error, exact", exact("pitch")),
        ("pitch error, first order", f"{np.degrees(formula.pitch):.4f}°"),
        ("roll error, exact", exact("roll")),
        ("roll error, first order", f"{np.degrees(formula.roll):.4f}°"),
        ("latitude error, exact", exact("latitude")),
        ("latitude error, first order", f"{np.degrees(formula.latitude):.4f}°"),
        ("attitude error, exact", f"{np.degrees(turned):.4f}°"),
        ("attitude error, first order", f"{np.degrees(np.linalg.norm(first_order)):.4f}°"),
    ]


def gyrocompass(values: Values) -> Rows:
    latitude, course, turn = np.radians(listed(values, "latitude course turn"))
    run = take_along(
        ship(latitude, values["speed"], course, turn, 4.0),
        listed(values, "gyro_forward gyro_up gyro_right") * degree / hour,
        tuning_factor=values["tuning"],
        damping=values["damping"],
        tilt=values["tilt"] * arcminute,
        log=values["log"],
    )
    north, east = (np.abs(run.tilt[:, i]).max() / arcminute for i in (0, 1))
    return [
        ("largest heading error", f"{np.degrees(np.abs(run.heading_error).max()):.4f}°"),
        ("at the end", f"{np.degrees(run.heading_error[-1]):.4f}°"),
        ("largest tilt about North", f"{north:.3f}′"),
        ("largest tilt about East", f"{east:.3f}′"),
        ("largest speed deviation", f"{np.degrees(np.abs(run.deviation).max()):.4f}°"),
        ("yaw error at the end", f"{np.degrees(run.yaw_error[-1]):.4f}°"),
        ("compass error at the end", f"{np.degrees(run.compass_error[-1]):.4f}°"),
    ]


def capstone(values: Values) -> Rows:
    xy, xz, yz = listed(values, "pair_0 pair_1 pair_2") * arcsecond
    turned = skew_matrix(listed(values, "turn_forward turn_up turn_right") * arcsecond)
    bent = np.array([[0, xy, xz], [xy, 0, yz], [xz, yz, 0]]) + turned
    axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [1, 0, 1], [0, 1, 1]]
    cone = coning_drift(values["algorithm"], values["cone"] * arcminute, 5.0, 0.01)
    shaken = np.array([0, 0, cone])
    latitude, turn = np.radians(listed(values, "latitude turn"))
    headings = np.radians(np.arange(-180.0, 181.0, 10.0))
    attitude = attitude_from_angles(headings, 0.0, 0.0)
    rate, _ = sensed_at_rest(attitude, latitude)
    drifts = rotate(attitude, rate @ bent.T + shaken)
    aligned = alignment_errors(headings, 0.0, latitude, drifts, np.zeros(3)).heading
    way = ship(latitude, 10.0, 0.0, turn, 16.0)
    rates = way.angle_increments / way.interval
    run = take_along(way, rates @ bent.T + shaken, log=True)
    drift_a_turn = np.abs(drift_per_turn(axes, bent)).max()
    return [
        ("drift in a turn, as built", f"{drift_a_turn / arcsecond:.1f}″"),
        ("aligned heading, as built", f"{np.abs(aligned).max() / arcminute:.3f}′"),
        ("under way, as built", f"{np.degrees(np.abs(run.heading_error).max()):.4f}°"),
    ]


BY_EXPLORER: dict[str, Callable[[Values], Rows]] = {
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
