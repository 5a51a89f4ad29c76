"""Rows of the panel of chapter 04."""

import numpy as np
from scipy.constants import arcsecond

from driftlab.book.ch04_calibration_by_turns.experiments import PLANS
from driftlab.drift.turn_calibration import TurnExperiment, turn_estimate
from driftlab.drift.weighing_designs import fit_turns, weighing_estimate
from driftlab.earth import EARTH_RATE

from .values import Rows, Values, listed


def one_sense(values: Values, experiment, axes, triad, sense, rng):
    """Estimates in inertial space; or on the Earth, from increments written down anew.

    In closed form: seen from the body the level part of the Earth's rate goes round backwards.
    """
    if values["earth"] == "none" and not values["bias"]:
        return experiment.estimate(axes, triad, rng)
    rate, k = sense * np.radians(values["rate"]), values["turns"]
    latitude = np.radians(values["latitude"]) if values["earth"] == "turning" else None
    count = k * values["steps"]
    seconds = 2 * np.pi * k / abs(rate) / count
    ends = np.sign(rate) * 2 * np.pi * k / count * np.arange(count + 1)
    n = axes[0, :, None, :]
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
    rows = rows + (size * rng.standard_normal((len(axes), *rows.shape)) if size else 0)
    error = experiment.integrate(rows)
    return turn_estimate(error, np.sign(rate) * axes, k)


def turn_calibration(values: Values) -> Rows:
    s1, s2, s3, skew, scale = 1e-3 * listed(values, "sigma1 sigma2 sigma3 skew scale")
    triad = np.array(
        [[scale, s1, s2 - skew], [s1, scale, s3 + skew], [s2 + skew, s3 - skew, scale]]
    )
    plan = PLANS[values["plan"]]
    noise = values["noise"] * arcsecond
    experiment = TurnExperiment(values["turns"], values["steps"], values["formula"], noise)
    runs = 12 if noise else 1
    axes = np.tile(plan.axes, (runs, 1, 1))
    rng = np.random.default_rng(1987)
    senses = [1, -1] if values["senses"] == "both" else [1]
    turned = [one_sense(values, experiment, axes, triad, sense, rng) for sense in senses]
    estimates = sum(turned) / len(senses)
    if plan.method == "yates":
        found = weighing_estimate(estimates * [1, 1, 1, 1.5])
    else:
        found = fit_turns(estimates, plan.axes, plan.method).sigma
    column = f"mean of {runs}, mrad" if noise else "found, mrad"
    pairs = list(zip((s1, s2, s3), found.mean(axis=0), strict=True))
    largest = max((mean - true for true, mean in pairs), key=abs)
    rows = [("largest error", f"{largest / arcsecond:.2f}″")]
    for index, (true, mean) in zip("₁₂₃", pairs, strict=True):
        rows.append((f"σ{index}: true, mrad", f"{1e3 * true:.3f}"))
        rows.append((f"σ{index}: {column}", f"{1e3 * mean:.4f}"))
        rows.append((f"σ{index}: error, ″", f"{(mean - true) / arcsecond:.2f}"))
    return rows
