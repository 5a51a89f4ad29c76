"""Rows of the panel of chapter 04."""

import numpy as np
from scipy.constants import arcsecond

from driftlab.book.ch04_calibration_by_turns.experiments import PLANS
from driftlab.drift.turn_calibration import TurnExperiment
from driftlab.drift.weighing_designs import fit_turns, weighing

from .values import Rows, Values, listed


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
    estimates = experiment.estimate(axes, triad, np.random.default_rng(1987))
    if plan.method == "yates":
        found = weighing(estimates * [1, 1, 1, 1.5])
    else:
        found = fit_turns(estimates, plan.axes, plan.method).sigma
    suffix = f" true, found{f', mean of {runs}' if noise else ''}, 1e-3"
    return [
        (f"σ{index}{suffix}", f"{1e3 * true:.3f}, {1e3 * mean:.6f}")
        for index, true, mean in zip("₁₂₃", (s1, s2, s3), found.mean(axis=0), strict=True)
    ]
