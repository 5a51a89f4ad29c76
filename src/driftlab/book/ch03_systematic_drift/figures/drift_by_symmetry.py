"""Only the symmetric part of the deformation drifts; Larin, remark after (2.4)."""

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLUE, SERIES, VERMILION, decades, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import DriftBySymmetry


def columns(data: DriftBySymmetry) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, those of the right panel over the mixing angle."""
    return {
        "size": data.sizes,
        "symmetric_rad_per_turn": data.symmetric,
        "skew_rad_per_turn": data.skew,
        "mixing_deg": np.degrees(data.mixing),
        "mixed_per_size": data.mixed / data.mixed_size,
        "first_order_per_size": data.first_order / data.mixed_size,
    }


@in_style
def draw(data: DriftBySymmetry, sheet: Sheet) -> Figure:
    """Slope one against slope two, and the cosine of the mixture."""
    figure, panels = sheet.mosaic("ab", (9.0, 3.8), (0.085, 0.14, 0.985, 0.9), spaces=(0.27, 0.2))
    sizes, mixture = panels["a"], panels["b"]
    sizes.set(title="drift against size", xscale="log", yscale="log", xlim=(1e-6, 1e-1))
    sizes.set(
        xlabel="size of the deformation",
        ylabel="drift per turn, rad",
        ylim=decades([data.symmetric, data.skew], 1e-12, 10),
    )
    sizes.plot(
        data.sizes, data.symmetric, **SERIES[0], label=f"symmetric: {_growth(data.symmetric)}"
    )
    sizes.plot(data.sizes, data.skew, **SERIES[1], label=f"skew: {_growth(data.skew)}")
    sizes.legend(loc="upper left")
    mixture.set(title="from symmetric to skew and on", xlabel="mixing angle, degrees")
    mixture.set(ylabel="drift per turn / size", xlim=(0, 180))
    mixture.set_xticks([0, 45, 90, 135, 180])
    degrees, exact = np.degrees(data.mixing), data.mixed / data.mixed_size
    reach = max(15.0, 1.2 * np.abs(exact).max())
    mixture.set_ylim(-reach, reach)
    mixture.plot(degrees, exact, color=BLUE, label="exact")
    mixture.plot(
        degrees[::6],
        data.first_order[::6] / data.mixed_size,
        color=VERMILION,
        linestyle="none",
        marker="x",
        label="first order: cosine of the mixing angle",
    )
    mixture.legend()
    return figure


def _growth(drift: FloatArray) -> str:
    """How a drift grows over `sizes`, in words; its slope halfway up."""
    middle = len(drift) // 2
    if drift[middle] < 1e-14:
        return "none"
    power = round(np.log10(drift[middle] / drift[middle - 8]))  # eight sizes make a decade
    return {1: "grows as size", 2: "grows as size squared"}.get(power, f"grows as size^{power}")
