"""Rows of the panel of chapter 04."""

import numpy as np
from scipy.constants import arcsecond

from driftlab.book.ch04_calibration_by_turns.experiments import PLANS
from driftlab.drift.turn_calibration import TurnExperiment, turn_estimate
from driftlab.drift.weighing_designs import fit_turns, weighing_estimate
from driftlab.earth import EARTH_RATE

from .values import ABSENT, Rows, Values, listed


def one_sense(values: Values, experiment, axes, true, triad, sense, rng):
    """Estimates in inertial space; or about axes that err, or on the Earth, written down anew.

    In closed form: seen from the body the level part of the Earth's rate goes round backwards.
    """
    rate, k = sense * np.radians(values["rate"]), values["turns"]
    latitude = np.radians(values["latitude"]) if values["earth"] == "turning" else None
    count = k * values["steps"]
    seconds = 2 * np.pi * k / abs(rate) / count
    ends = np.sign(rate) * 2 * np.pi * k / count * np.arange(count + 1)
    n = true[:, :, None, :]
    rows = np.diff(ends)[:, None] * n
    if latitude is not None:
        level, upward = EARTH_RATE * np.cos(latitude), EARTH_RATE * np.sin(latitude)
        # North seen from a body whose axis n was swung up by the shorter way.
        swing = np.cross([0, 0, 1], n)
        twice = np.cross(swing, np.cross(swing, [0, 1, 0]))
        north = np.array([0, 1, 0]) + np.cross(swing, [0, 1, 0]) + twice / (1 + n[..., 2:])
        east = np.cross(north, n)
        sine, cosine = (np.diff(f(ends))[:, None] / rate for f in (np.sin, np.cos))
        rows = rows + upward * seconds * n + level * (sine * north - cosine * east)
    rows = rows @ (np.eye(3) + triad).T + seconds * values["bias"] * np.radians(1 / 3600)
    size = experiment.angle_noise / np.sqrt(values["steps"])
    rows = rows + (size * rng.standard_normal((len(axes), *rows.shape[-3:])) if size else 0)
    error = experiment.integrate(rows)
    return turn_estimate(error, np.sign(rate) * axes, k)


def nine(triad, axes, true, turns, deviations, rng):
    """Errors and standard deviations of the nine numbers, from the sums of both senses."""
    noise, uncertain = deviations
    sums = [
        2 * np.pi * turns * sense * true @ (np.eye(3) + triad).T
        + noise * rng.standard_normal(true.shape)
        for sense in (1, -1)
    ]
    found = (sums[0] - sums[1]) / (4 * np.pi * turns) - axes
    # Generalised least squares by normal equations; the triad from an unweighted fit.
    nearness = max(1.0, np.linalg.norm(np.linalg.pinv(axes), 2))
    second_order = np.sqrt(2 + 2 * nearness**2) * uncertain**2
    noise = np.hypot(max(noise, 1e-9) / (np.sqrt(8) * np.pi * turns), second_order)
    triad_found = np.eye(3) + np.linalg.lstsq(axes, found)[0].T
    normal, right = np.zeros((9, 9)), np.zeros(9)
    for n, half in zip(axes, found, strict=True):
        reach = uncertain * triad_found @ (np.eye(3) - np.outer(n, n))
        inverse = np.linalg.inv(np.eye(3) + reach @ reach.T / noise**2) / noise**2
        normal += np.kron(inverse, np.outer(n, n))
        right += np.kron(inverse @ half, n)
    covariance = np.linalg.inv(normal)
    matrix = (covariance @ right).reshape(3, 3) - triad
    places = [((i, i), (i, i), 1) for i in range(3)]
    places += [((i, j), (j, i), 1) for i, j in ((0, 1), (0, 2), (1, 2))]
    places += [((i, j), (j, i), -1) for i, j in ((2, 1), (0, 2), (1, 0))]
    for first, second, sign in places:
        one, two = 3 * first[0] + first[1], 3 * second[0] + second[1]
        square = covariance[one, one] + covariance[two, two] + 2 * sign * covariance[one, two]
        yield (matrix[first] + sign * matrix[second]) / 2, np.sqrt(square) / 2


PERFECT_TABLE = {
    "axis": 0.0, "earth": "none", "latitude": 37.5, "rate": 10.0, "senses": "one", "bias": 0.0
}  # fmt: skip
"""What the panel of chapter 04 has no control for."""


def turn_calibration(values: Values) -> Rows:
    values = {**PERFECT_TABLE, **values}
    s1, s2, s3, skew, scale = 1e-3 * listed(values, "sigma1 sigma2 sigma3 skew scale")
    triad = np.array(
        [[scale, s1, s2 - skew], [s1, scale, s3 + skew], [s2 + skew, s3 - skew, scale]]
    )
    plan = PLANS[values["plan"]]
    noise = values["noise"] * arcsecond
    experiment = TurnExperiment(values["turns"], values["steps"], values["formula"], noise)
    uncertain = values["axis"] * arcsecond
    runs = 12 if noise or uncertain else 1
    axes = np.tile(plan.axes, (runs, 1, 1))
    rng = np.random.default_rng(1987)
    other = np.random.default_rng(1988)
    true = axes + uncertain * np.cross(axes, other.standard_normal(axes.shape))
    true /= np.linalg.norm(true, axis=-1, keepdims=True)
    of_each = true if uncertain else axes[:1]
    senses = [1, -1] if values["senses"] == "both" else [1]
    turned = [one_sense(values, experiment, axes, of_each, triad, sense, rng) for sense in senses]
    estimates = sum(turned) / len(senses)
    if plan.method == "yates":
        found = weighing_estimate(estimates * [1, 1, 1, 1.5])
    else:
        found = fit_turns(estimates, plan.axes, plan.method).sigma
    column = f"mean of {runs}, mrad" if runs > 1 else "found, mrad"
    pairs = list(zip((s1, s2, s3), found.mean(axis=0), strict=True))
    largest = max((mean - true for true, mean in pairs), key=abs)
    rows = [("largest error", f"{largest / arcsecond:.2f}″")]
    for index, (value, mean) in zip("₁₂₃", pairs, strict=True):
        rows.append((f"σ{index}: true, mrad", f"{1e3 * value:.3f}"))
        rows.append((f"σ{index}: {column}", f"{1e3 * mean:.4f}"))
        rows.append((f"σ{index}: error, ″", f"{(mean - value) / arcsecond:.2f}"))
        rows.append((f"σ{index}: 1σ, ″", ABSENT))
    k = values["turns"]
    names = ("s x", "s y", "s z", "σ xy", "σ xz", "σ yz", "κ x", "κ y", "κ z")
    given = (scale, scale, scale, s1, s2, s3, -skew, -skew, 0.0)
    deviations = (noise * np.sqrt(k), uncertain)
    errors = nine(triad, plan.axes, true[0], k, deviations, other)
    for name, value, (error, spread) in zip(names, given, errors, strict=True):
        rows.append((f"{name}: true, mrad", f"{1e3 * value:.3f}"))
        rows.append((f"{name}: {column}", ABSENT))
        rows.append((f"{name}: error, ″", f"{error / arcsecond:.2f}"))
        rows.append((f"{name}: 1σ, ″", f"{spread / arcsecond:.2f}"))
    return rows
