"""Does the averaged choice of axes deviate less? The claim after Wu Figs. 3-5, over many units."""

from typing import NamedTuple

import numpy as np
from scipy.stats import binomtest

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, Picture
from driftlab.calibration.error_model import attitude_of_axes
from driftlab.calibration.simulation import TableTrial, unit_in_axes
from driftlab.calibration.static_navigation import navigate_in_place
from driftlab.checks import FloatArray
from driftlab.monte_carlo import sweep

from .filter_consistency import QUICK
from .in_place import DURATION, FRAMES, LATITUDE, STARTS, TABLE, same_attitude

ALL_STARTS = (STARTS[0], "its own true axes", STARTS[1])
"""What the computers take for their attitudes: see `in_place`, and the exact attitude of each."""
UNITS = 200
SEED = 345


class Verdict(NamedTuple):
    """How often the averaged axes did better."""

    better: int
    units: int
    interval: tuple[float, float]  # 95 %, of the part that does better (Clopper and Pearson)
    median: float  # of the ratios


class InPlaceClaim(NamedTuple):
    """Deviation with averaged axes over that with usual axes, unit by unit."""

    ratios: dict[tuple[str, str], FloatArray]  # (start, quantity): (units,), ascending


def compute(units: int = UNITS, seed: int = SEED) -> InPlaceClaim:
    """Calibrate random units with both choices, on the same data, and let them navigate."""
    sizes: dict[tuple[str, str, str], FloatArray] = {}
    for frame in FRAMES:
        table = TableTrial(
            scheme=QUICK, frame=frame, sample_interval=0.25, update_interval=9.0, keep=10_000
        )
        found = sweep(table.run, units, seed=seed, batch=units)[0]
        _, turn = unit_in_axes(found.unit, frame)
        own = attitude_of_axes(TABLE, turn)
        if frame == "averaged":
            first, found_first = own, found.calibration.unit
        one = same_attitude(first, found_first, frame)
        starts = (one, own, np.broadcast_to(TABLE, own.shape))
        for start, axes in zip(ALL_STARTS, starts, strict=True):
            run = navigate_in_place(
                found.unit, found.calibration.unit, TABLE, start=axes, reference=axes,
                latitude=LATITUDE, duration=DURATION, interval=5.0, every=300.0,
            )  # fmt: skip
            for quantity in ("attitude", "velocity", "position"):
                squares = (getattr(run, quantity) ** 2).sum(axis=-1)
                sizes[frame, start, quantity] = np.sqrt(squares.mean(axis=-1))
    averaged, usual = FRAMES
    return InPlaceClaim({
        (start, quantity): np.sort(
            sizes[averaged, start, quantity] / sizes[usual, start, quantity]
        )
        for start in ALL_STARTS
        for quantity in ("attitude", "velocity", "position")
    })  # fmt: skip


def verdict(ratios: FloatArray) -> Verdict:
    """Count the units for which the averaged axes did better."""
    better = int((ratios < 1).sum())
    interval = binomtest(better, len(ratios)).proportion_ci(0.95, "exact")
    return Verdict(
        better, len(ratios), (float(interval.low), float(interval.high)), float(np.median(ratios))
    )


def columns(data: InPlaceClaim) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the ratios in rising order."""
    return {
        f"{quantity}, start from {start}": ratios.round(3)
        for (start, quantity), ratios in data.ratios.items()
    }


class InPlaceClaimPicture(Picture[InPlaceClaim]):
    """Distribution functions of the ratio."""

    size = (10.5, 3.9)

    def build(self) -> None:
        self.panels = self.figure.subplots(1, 3, sharey=True)
        self.figure.subplots_adjust(0.065, 0.23, 0.985, 0.91, wspace=0.08)
        for panel, start in zip(self.panels, ALL_STARTS, strict=True):
            panel.set(title=f"start from {start}", xscale="log", xlim=(0.3, 3.3), ylim=(0, 1))
            panel.set_xticks([0.3, 0.5, 1, 2, 3], ["0.3", "0.5", "1", "2", "3"])
            panel.minorticks_off()
            panel.set_xlabel("error with averaged axes / with usual axes")
            panel.axvline(1.0, color=BLACK, linewidth=0.8)
            panel.axhline(0.5, color=GREY, linewidth=0.8)
        self.panels[0].set_ylabel("part of the units below")

    def update(self, data: InPlaceClaim) -> None:
        for panel, start in zip(self.panels, ALL_STARTS, strict=True):
            for quantity, style in zip(("attitude", "velocity", "position"), SERIES, strict=False):
                ratios = data.ratios[start, quantity]
                parts = np.arange(1, len(ratios) + 1) / len(ratios)
                panel.step(ratios, parts, where="post", **style, label=quantity)
        handles, labels = self.panels[0].get_legend_handles_labels()
        self.figure.legend(handles, labels, loc="lower center", ncols=3)
