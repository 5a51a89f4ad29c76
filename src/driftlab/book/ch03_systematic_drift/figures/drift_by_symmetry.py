"""Only the symmetric part of the deformation drifts; Larin, remark after (2.4)."""

from typing import NamedTuple

import numpy as np

from driftlab.book.machinery.picture import BLUE, SERIES, VERMILION, Picture
from driftlab.book.scenarios import SKEW, SYMMETRIC
from driftlab.checks import FloatArray
from driftlab.drift.systematic_drift import drift_per_turn

DIAGONAL: FloatArray = np.ones(3) / np.sqrt(3)
ACROSS: FloatArray = np.array([1.0, -1, 0]) / np.sqrt(2)


class DriftBySymmetry(NamedTuple):
    """Drift per turn, in rad."""

    sizes: FloatArray  # (m,)
    symmetric: FloatArray  # (m,), about the worst axis (1, 1, 1)
    skew: FloatArray  # (m,), about (1, -1, 0), across the skew matrix's own axis
    mixing: FloatArray  # (p,), rad
    mixed: FloatArray  # (p,), M = size (cos SYMMETRIC + sin SKEW), about (1, 1, 1)
    mixed_size: float


def compute(mixed_size: float = 1e-3) -> DriftBySymmetry:
    """Drift per turn against the size of the two parts, and against their mixture."""
    sizes = np.geomspace(1e-6, 1e-1, 41)
    mixing = np.linspace(0, np.pi, 73)
    cosine, sine = np.cos(mixing)[:, None, None], np.sin(mixing)[:, None, None]
    mixture = mixed_size * (cosine * SYMMETRIC + sine * SKEW)
    return DriftBySymmetry(
        sizes,
        drift_per_turn(DIAGONAL, sizes[:, None, None] * SYMMETRIC),
        drift_per_turn(ACROSS, sizes[:, None, None] * SKEW),
        mixing,
        drift_per_turn(DIAGONAL, mixture),
        mixed_size,
    )


def columns(data: DriftBySymmetry) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    return {
        "size": data.sizes,
        "symmetric_rad_per_turn": data.symmetric,
        "skew_rad_per_turn": data.skew,
    }


class DriftBySymmetryPicture(Picture[DriftBySymmetry]):
    """Slope one against slope two, and the cosine of the mixture."""

    def build(self) -> None:
        sizes, mixture = self.figure.subplots(1, 2)
        self.figure.subplots_adjust(0.085, 0.14, 0.985, 0.9, wspace=0.27)
        sizes.set(title="drift against size", xscale="log", yscale="log", xlim=(1e-6, 1e-1))
        sizes.set(xlabel="size of the deformation", ylabel="drift per turn, rad", ylim=(1e-12, 10))
        self.symmetric = self.line(sizes, **SERIES[0], label="symmetric: grows as size")
        self.skew = self.line(sizes, **SERIES[1], label="skew: grows as size squared")
        sizes.legend(loc="upper left")
        mixture.set(title="from symmetric to skew and on", xlabel="mixing angle, degrees")
        mixture.set(ylabel="drift per turn / size", xlim=(0, 180), ylim=(-15, 15))
        mixture.set_xticks([0, 45, 90, 135, 180])
        self.mixed = self.line(mixture, color=BLUE, label="exact")
        dots = {"color": VERMILION, "linestyle": "none", "marker": "x"}
        self.cosine = self.line(mixture, **dots, label=r"$4\pi\cos$ of the mixing angle")
        mixture.legend()

    def update(self, data: DriftBySymmetry) -> None:
        self.symmetric.set_data(data.sizes, data.symmetric)
        self.skew.set_data(data.sizes, data.skew)
        degrees = np.degrees(data.mixing)
        self.mixed.set_data(degrees, data.mixed / data.mixed_size)
        self.cosine.set_data(degrees[::6], 4 * np.pi * np.cos(data.mixing[::6]))
