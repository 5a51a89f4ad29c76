"""Rows of the panel of chapter 12."""

import numpy as np
from scipy.stats import chi2

from .values import Rows, Values


def consistency(values: Values) -> Rows:
    states, runs = values["states"], values["runs"]
    rng = np.random.default_rng(values["draw"])
    mean = values["factor"] ** 2 * rng.chisquare(states, 200)[:runs].sum() / (states * runs)
    low, high = chi2.ppf([0.025, 0.975], states * runs) / (states * runs)
    says = "too small" if mean < low else "consistent" if mean <= high else "too large"
    return [
        ("mean squared error over expected", f"{mean:.3f}"),
        ("should lie between, 95 %", f"{low:.3f} and {high:.3f}"),
        ("so the test says", says),
        ("mean to expect", f"{values['factor'] ** 2:.3f}"),
    ]
