"""What a word of 32 bits does to the quaternion of a step, and to an attitude of many steps."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import arcsecond

from driftlab.attitude.finite_precision import UPDATES
from driftlab.book.machinery.picture import GREY, SERIES, in_style, long_table
from driftlab.checks import FloatArray

from ..experiments import EARTH_RATE, EARTH_SECONDS, NORM_STEPS, ShortWord

LABELS = (
    r"product with $\lambda_0$",
    "small terms first",
    r"sum, with $1-\lambda_0$",
    "compensated",
)
STYLES = tuple(
    {**style, "marker": marker, "markersize": 5}
    for style, marker in zip((SERIES[1], SERIES[3], SERIES[0], SERIES[2]), "sDov", strict=True)
)


def columns(data: ShortWord) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    curves = {
        "1-l0 subtracted, over rad": (data.angles, data.subtracted),
        "1-l0 carried, over rad": (data.angles, data.carried),
    }
    for i, update in enumerate(UPDATES):
        curves[f"earth {update}, rad over Hz"] = (data.rates, data.earth[i])
    for i, update in enumerate(UPDATES):
        curves[f"norm {update}, over rad"] = (data.step_angles, data.norms[i])
    return long_table(curves)


@in_style
def draw(data: ShortWord) -> Figure:
    """Draw the digits of 1 - l0, the error on the turning Earth, and the norm."""
    figure = Figure(figsize=(10.5, 4.4))
    step, earth, norm = figure.subplots(1, 3)
    figure.subplots_adjust(0.065, 0.22, 0.985, 0.91, wspace=0.3)
    step.set(title=r"one step: $1-\lambda_0$", xlabel="angle of the step, rad")
    step.set(xscale="log", yscale="log", xlim=(1e-6, 1), ylim=(1e-10, 10))
    step.set_ylabel("relative error")
    earth.set(title=f"{EARTH_SECONDS:g} s on the turning Earth", xlabel="sample rate, Hz")
    earth.set(xscale="log", yscale="log", xlim=(8, 12500), ylim=(1e-3, 100))
    earth.set(ylabel="error of attitude, arc seconds")
    norm.set(title=f"norm after {NORM_STEPS} steps", xlabel="angle of the step, rad")
    norm.set(xscale="log", yscale="log", xlim=(7e-5, 0.14), ylim=(1e-9, 1e-2))
    norm.set(ylabel="relative error")
    turn = EARTH_RATE * EARTH_SECONDS / arcsecond
    step.plot(data.angles, data.subtracted, **SERIES[1], label=r"$\lambda_0$ stored, subtracted")
    # No error at all has no place on a logarithmic axis.
    carried = np.where(data.carried > 0, data.carried, np.nan)
    step.plot(data.angles, carried, **SERIES[0], label="computed by itself")
    step.legend(loc="lower left", bbox_to_anchor=(0.0, 0.3))
    earth.axhline(turn, color=GREY, linewidth=4, alpha=0.5)
    earth.text(9, 1.4 * turn, "what the Earth has turned", va="bottom")
    for style, error in zip(STYLES, data.earth, strict=True):
        earth.plot(data.rates, error / arcsecond, **style)
    for style, label, error in zip(STYLES, LABELS, data.norms, strict=True):
        norm.plot(data.step_angles, error, **style, label=label)
    handles, labels = norm.get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=4, bbox_to_anchor=(0.66, 0))
    return figure
