"""Is the filter as good as it says? Squared normalised errors and innovations over many runs."""

from typing import NamedTuple

import numpy as np
from scipy.constants import arcsecond

from driftlab.book.machinery.picture import BLACK, SERIES, Picture, long_table
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.calibration.simulation import TableTrial
from driftlab.checks import FloatArray
from driftlab.imu import Spread
from driftlab.monte_carlo import mean_square_bounds, sweep
from driftlab.motion.turntable import NINETEEN_POSITIONS, Scheme
from driftlab.triad import BODY_FRAMES

RUNS = 60
"""Calibrations in the left and the middle panel."""
RUNS_BY_FRAME = 100
"""Calibrations for each dot of the right one."""
SEED = 2018
SIZES: FloatArray = np.array([40.0, 100.0, 200.0, 400.0]) * arcsecond
"""Spreads of the installation errors, rad."""
QUICK = Scheme(NINETEEN_POSITIONS.rotations, NINETEEN_POSITIONS.start, dwell=63.0)
"""The nineteen positions with pauses half as long, for the right panel."""


class FilterConsistency(NamedTuple):
    """Means over the runs, divided by what they should be."""

    times: FloatArray  # (k,), s
    states: FloatArray  # (k,): squared normalised errors of the 27 states
    state_bounds: tuple[float, float]  # of 95 % of them
    innovation_times: FloatArray  # (u,), s
    innovations: FloatArray  # (u,): squared normalised innovations
    innovation_bounds: tuple[float, float]
    innovation_mean: float  # over all times as well
    innovation_mean_bounds: tuple[float, float]
    inside: float  # part of the innovations inside their bounds
    sizes: FloatArray  # (m,), rad
    by_frame: FloatArray  # (4, m): states at the end of a calibration, by choice of axes


def compute(runs: int = RUNS, seed: int = SEED) -> FilterConsistency:
    """Calibrate random units again and again."""
    table = TableTrial(sample_interval=0.1, update_interval=3.0, keep=7)
    found = sweep(table.run, runs, seed=seed, batch=runs)[0]
    size = found.calibration.model.size
    surprise = found.calibration.surprise
    innovations = surprise.mean(axis=0) / 3
    low, high = (bound / 3 for bound in mean_square_bounds(3, runs))
    by_frame = np.empty((len(BODY_FRAMES), len(SIZES)))
    for i, frame in enumerate(BODY_FRAMES):
        for j, spread in enumerate(SIZES):
            quick = TableTrial(
                scheme=QUICK,
                frame=frame,
                spread=Spread(installation=float(spread)),
                sample_interval=0.25,
                update_interval=9.0,
                keep=10_000,
            )
            # The same units and noise for each choice of axes.
            last = sweep(quick.run, RUNS_BY_FRAME, seed=seed, batch=RUNS_BY_FRAME)[0]
            by_frame[i, j] = last.squared_errors[:, -1].mean() / size
    updates = np.arange(1.0, surprise.shape[-1] + 1) * table.update_interval
    return FilterConsistency(
        found.calibration.times,
        found.squared_errors.mean(axis=0) / size,
        _each(mean_square_bounds(size, runs), size),
        updates,
        innovations,
        (low, high),
        float(surprise.mean() / 3),
        _each(mean_square_bounds(3, surprise.size), 3),
        float(np.mean((innovations > low) & (innovations < high))),
        SIZES,
        by_frame,
    )


def _each(bounds: tuple[float, float], freedom: int) -> tuple[float, float]:
    return bounds[0] / freedom, bounds[1] / freedom


def columns(data: FilterConsistency) -> dict[str, FloatArray]:
    """Columns of the figure's CSV; innovations each minute."""
    curves = {
        "states over time in s": (data.times, data.states),
        "innovations over time in s": (data.innovation_times[19::20], data.innovations[19::20]),
    }
    for name, values in zip(BODY_FRAMES, data.by_frame, strict=True):
        curves[f"states over installation errors in rad, {name}"] = (data.sizes, values)
    table = long_table(curves)
    return {**table, "y": table["y"].round(3)}


class FilterConsistencyPicture(Picture[FilterConsistency]):
    """Errors of the states, innovations, and the choice of axes."""

    size = (10.5, 3.9)

    def build(self) -> None:
        self.states, self.innovations, self.frames = self.figure.subplots(1, 3)
        self.figure.subplots_adjust(0.055, 0.26, 0.985, 0.91, wspace=0.22)
        self.states.set(
            title="27 states", xlabel="time, minutes", ylabel="mean over what it should be"
        )
        self.innovations.set(title="innovations", xlabel="time, minutes")
        self.frames.set(title="27 states at the end", xscale="log", yscale="log")
        self.frames.set(xlabel="installation errors, arc seconds")

    def update(self, data: FilterConsistency) -> None:
        for panel, times, values, bounds in (
            (self.states, data.times, data.states, data.state_bounds),
            (self.innovations, data.innovation_times, data.innovations, data.innovation_bounds),
        ):
            panel.plot(times / 60, values, **SERIES[0], label="mean over the runs")
            panel.lines[-1].set_linewidth(0.7 if panel is self.innovations else 1.6)
            for bound in bounds:
                panel.axhline(bound, color=BLACK, linestyle="--", linewidth=1.2)
            panel.lines[-1].set_label("95 % bounds of each value")
            panel.set(ylim=(0.3, 1.9), xlim=(0, times[-1] / 60))
        arc_seconds = data.sizes / arcsecond
        for frame, values, style, marker in zip(
            ERROR_MODELS, data.by_frame, SERIES, "os^D", strict=False
        ):
            self.frames.plot(arc_seconds, values, **style, marker=marker, markersize=4, label=frame)
        self.frames.set_xticks(arc_seconds, [f"{size:.0f}" for size in arc_seconds])
        self.frames.set_yticks([1, 2, 5, 10, 20], ["1", "2", "5", "10", "20"])
        self.frames.minorticks_off()
        handles, labels = self.states.get_legend_handles_labels()
        self.figure.legend(handles, labels, loc="lower left", ncols=2, bbox_to_anchor=(0.12, 0.04))
        self.frames.legend(loc="upper center", bbox_to_anchor=(0.45, -0.17), ncols=2)
