"""One calibration by turns: estimated against true non-orthogonality, with noise repeated."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.machinery.picture import BLACK, BLUE, VERMILION, Picture
from driftlab.checks import FloatArray, finite_array
from driftlab.drift.turn_calibration import (
    PAIR_AXES,
    YATES_AXES,
    TurnExperiment,
    fit_turns,
    weighing,
)
from driftlab.triad import non_orthogonality

SIX_AXES: FloatArray = np.vstack([PAIR_AXES, np.eye(3)])
REPEATS = 12


class Plan(NamedTuple):
    """About which axes to turn, and how to combine the estimates."""

    axes: FloatArray
    method: str


PLANS = {
    "three pair axes, (3.4)": Plan(PAIR_AXES, "none"),
    "four axes, Yates's weighing": Plan(YATES_AXES, "yates"),
    "four axes, least squares": Plan(YATES_AXES, "none"),
    "four axes, least squares and common scale": Plan(YATES_AXES, "common"),
    "six axes, least squares and three scales": Plan(SIX_AXES, "each"),
}


class TurnEstimates(NamedTuple):
    """True and estimated [sigma1, sigma2, sigma3]."""

    true: FloatArray  # (3,)
    runs: FloatArray  # (REPEATS, 3)
    axes: FloatArray  # (m, 3)


def compute(
    misalignment: ArrayLike,
    plan: str = "three pair axes, (3.4)",
    experiment: TurnExperiment | None = None,
    seed: int = 1987,
) -> TurnEstimates:
    """Calibrate one triad `REPEATS` times (once, if there is no noise).

    Parameters
    ----------
    misalignment : array_like, shape (3, 3)
    plan : str
        A name in `PLANS`.
    experiment : TurnExperiment, optional
    seed : int
        Of the noise.
    """
    misalignment = finite_array(misalignment, "misalignment", 3, 3)
    if plan not in PLANS:
        raise ValueError(f"plan: expected one of {', '.join(PLANS)}, got {plan!r}.")
    experiment = experiment or TurnExperiment()
    axes, method = PLANS[plan]
    repeats = REPEATS if experiment.angle_noise else 1
    repeated = np.broadcast_to(axes, (repeats, *axes.shape))
    estimates = experiment.estimate(misalignment, repeated, np.random.default_rng(seed))
    if method == "yates":
        runs = weighing(estimates * [1, 1, 1, 1.5])
    else:
        runs = fit_turns(estimates, axes, method).sigma
    sigma = non_orthogonality(misalignment)[..., [0, 0, 1], [1, 2, 2]]
    return TurnEstimates(sigma, np.broadcast_to(runs, (REPEATS, 3)), axes)


def columns(data: TurnEstimates) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    return {
        "true": data.true,
        "mean_estimate": data.runs.mean(axis=0),
        "deviation": data.runs.std(axis=0),
    }


class TurnEstimatesPicture(Picture[TurnEstimates]):
    """Estimates over true values, and their errors on a logarithmic axis."""

    size = (9.0, 3.8)

    def build(self) -> None:
        values, errors = self.figure.subplots(1, 2, gridspec_kw={"width_ratios": [1, 1.1]})
        self.figure.subplots_adjust(0.08, 0.14, 0.985, 0.9, wspace=0.28)
        names = [r"$\sigma_1$", r"$\sigma_2$", r"$\sigma_3$"]
        values.set(title="true and estimated", ylabel=r"$10^{-3}$ rad", ylim=(-3, 3))
        errors.set(title="size of the error", ylabel="rad", yscale="log", ylim=(1e-9, 1))
        for axes in (values, errors):
            axes.set(xlim=(0.4, 3.6), xticks=[1, 2, 3])
            axes.set_xticklabels(names)
        dot = {"color": BLUE, "linestyle": "none", "marker": "o", "markersize": 4}
        self.runs = self.line(values, **dot, label="estimated, each run")
        self.run_errors = self.line(errors, **dot, label="each run")
        true = {"color": BLACK, "linestyle": "none", "marker": "_", "markersize": 14}
        self.true = self.line(values, **true, markeredgewidth=2, label="true")
        mean = {"color": VERMILION, "linestyle": "none", "marker": "D", "fillstyle": "none"}
        self.mean_error = self.line(errors, **mean, markersize=9, label="of the mean of all runs")
        values.legend(loc="lower left")
        errors.legend(loc="upper left")

    def update(self, data: TurnEstimates) -> None:
        index = np.arange(1, 4)
        spread = np.linspace(-0.25, 0.25, REPEATS)
        places = (index + spread[:, np.newaxis]).ravel()
        floor = 1e-9
        self.true.set_data(index, 1e3 * data.true)
        self.runs.set_data(places, 1e3 * data.runs.ravel())
        sizes = np.maximum(np.abs(data.runs - data.true), floor)
        self.run_errors.set_data(places, sizes.ravel())
        mean = np.maximum(np.abs(data.runs.mean(axis=0) - data.true), floor)
        self.mean_error.set_data(index, mean)
