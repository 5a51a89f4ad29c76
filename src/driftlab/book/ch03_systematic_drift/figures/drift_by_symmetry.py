"""Only the symmetric part of the deformation drifts; Larin, remark after (2.4)."""

import numpy as np

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLUE, SERIES, VERMILION, decades
from driftlab.checks import FloatArray


@from_table
def draw(drawing: Drawing) -> None:
    """Slope one against slope two, and the cosine of the mixture."""
    table = drawing.table
    panels = drawing.mosaic("ab", (9.0, 3.8), (0.085, 0.14, 0.985, 0.9), spaces=(0.27, 0.2))
    sizes, mixture = panels["a"], panels["b"]
    sizes.set(title="drift against size", xscale="log", yscale="log", xlim=(1e-6, 1e-1))
    sizes.set(xlabel="size of the deformation", ylabel="drift per turn, rad")
    sizes.set_ylim(*decades([table.symmetric, table.skew], 1e-12, 10))
    for name, style in zip(("symmetric", "skew"), SERIES, strict=False):
        label = f"{name}: {_growth(table.shown(name))}"
        drawing.curve(sizes, "sizes", name, **style, label=label)
    sizes.legend(loc="upper left")
    mixture.set(title="from symmetric to skew and on", xlabel="mixing angle, degrees")
    mixture.set(ylabel="drift per turn / size", xlim=(0, 180))
    mixture.set_xticks([0, 45, 90, 135, 180])
    reach = max(15.0, 1.2 * np.abs(table.mixed_per_size).max())
    mixture.set_ylim(-reach, reach)
    drawing.curve(mixture, "mixing", "mixed_per_size", color=BLUE, label="exact")
    drawing.curve(
        mixture, "mixing", "first_order_per_size", every=6, color=VERMILION, linestyle="none",
        marker="x", label="first order: cosine of the mixing angle",
    )  # fmt: skip
    mixture.legend()


def _growth(drift: FloatArray) -> str:
    """How a drift grows over `sizes`, in words; its slope halfway up."""
    middle = len(drift) // 2
    if drift[middle] < 1e-14:
        return "none"
    power = round(np.log10(drift[middle] / drift[middle - 8]))  # eight sizes make a decade
    return {1: "grows as size", 2: "grows as size squared"}.get(power, f"grows as size^{power}")
