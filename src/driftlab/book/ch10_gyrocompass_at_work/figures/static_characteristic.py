"""Plotnikov Fig. 1, simulated from its description: heading error around the dial of a table."""

from typing import Any, NamedTuple

import numpy as np
from scipy.constants import arcminute, degree, hour

from driftlab.book.machinery.picture import BLACK, SERIES, Picture, long_table
from driftlab.book.scenarios import SARATOV_LATITUDE as LATITUDE
from driftlab.checks import FloatArray
from driftlab.frames import attitude_from_angles
from driftlab.gyrocompass.alignment import alignment_errors
from driftlab.gyrocompass.trials import table_heading_error
from driftlab.quaternion import rotate

DIAL: FloatArray = np.radians(np.arange(0.0, 361.0, 15.0))
RUNS = 3
LEVELLING, NORTH = 6 * arcminute, float(np.radians(0.1))
"""The paper's limits for the table: each axis is level, and its zero is North, within these."""
RANDOM = 0.01 * degree / hour
"""Deviation of an averaged gyro from stop to stop, rad/s: of the paper's 0.01 to 0.02 deg/h."""
LASTING: FloatArray = np.arange(0.0, 0.105, 0.01).round(2)
"""Deviation of the drift that each gyro keeps through all runs, deg/h."""
SHOWN = 4
"""Which of them the left panel shows."""
UNITS = 300
PRINTED = 0.34
"""The paper's largest averaged error, degrees."""
SEED = 1


class StaticCharacteristic(NamedTuple):
    """One unit around the dial, and the largest error of many."""

    runs: FloatArray  # (RUNS, n), rad: of the shown unit
    formula: FloatArray  # (n,), rad: of its lasting errors, first order
    lasting: FloatArray  # (m,), deg/h: deviations of the drift that lasts
    largest: FloatArray  # (m, UNITS), rad: of the averaged characteristic


def trial(lasting: float, units: int, rng: np.random.Generator) -> tuple[FloatArray, ...]:
    """Heading errors (units, RUNS, n) of units with a `lasting` drift, that drift, and the table.

    The table's errors are even within their limits, and the same for all stops of one unit.
    """
    drift = lasting * rng.standard_normal((units, 1, 1, 3))
    tilt = rng.uniform(-LEVELLING, LEVELLING, (units, 1, 1, 2))
    north = rng.uniform(-NORTH, NORTH, (units, 1, 1))
    noise = RANDOM * rng.standard_normal((units, RUNS, len(DIAL), 3))
    errors = table_heading_error(
        DIAL, drift + noise, np.zeros(3), LATITUDE, north_error=north, tilt=tilt
    )
    return errors, drift, north


def compute() -> StaticCharacteristic:
    """Turn many units around the dial, three times each."""
    rng = np.random.default_rng(SEED)
    largest = []
    for lasting in LASTING * degree / hour:
        errors, drift, north = trial(float(lasting), UNITS, rng)
        worst = np.abs(errors.mean(axis=1)).max(axis=-1)
        largest.append(worst)
        if len(largest) == SHOWN + 1:
            # The unit whose largest error is nearest to the printed one.
            unit = int(np.abs(np.degrees(worst) - PRINTED).argmin())
            local = rotate(attitude_from_angles(DIAL, 0.0, 0.0), drift[unit, 0, 0])
            aligned = alignment_errors(DIAL, 0.0, LATITUDE, local, np.zeros(3))
            formula = aligned.heading + north[unit, 0, 0]
            runs = errors[unit]
    return StaticCharacteristic(runs, formula, LASTING, np.array(largest))


def columns(data: StaticCharacteristic) -> dict[str, Any]:
    """Columns of the figure's CSV."""
    dial, worst = np.degrees(DIAL).round(6), np.degrees(data.largest)
    curves = {
        f"run {i + 1}, degrees over dial": (dial, np.degrees(run).round(7))
        for i, run in enumerate(data.runs)
    }
    curves["mean, degrees over dial"] = dial, np.degrees(data.runs.mean(axis=0)).round(7)
    curves["formula, degrees over dial"] = dial, np.degrees(data.formula).round(7)
    for share in (0.1, 0.5, 0.9):
        name = f"largest error, {share:.0%} of units, degrees over lasting drift in deg/h"
        curves[name] = data.lasting, np.quantile(worst, share, axis=1).round(7)
    return long_table(curves)


class StaticCharacteristicPicture(Picture[StaticCharacteristic]):
    """One unit around the dial, and which drift makes the printed largest error."""

    size = (10.5, 3.9)

    def build(self) -> None:
        self.panels = self.figure.subplots(1, 2)
        self.figure.subplots_adjust(0.07, 0.14, 0.985, 0.91, wspace=0.18)
        left, right = self.panels
        left.set(title=f"one unit, lasting drift drawn with {LASTING[SHOWN]:g} deg/h")
        left.set(xlabel="dial, degrees", ylabel="heading error, degrees", xlim=(0, 360))
        left.set_xticks(range(0, 361, 60))
        right.set(title=f"largest error of the mean of {RUNS} runs, {UNITS} units each")
        right.set(xlabel="deviation of the lasting drift, deg/h", ylabel="degrees")
        right.set(xlim=(-0.005, 0.105), ylim=(0, 1.6))

    def update(self, data: StaticCharacteristic) -> None:
        left, right = self.panels
        dial = np.degrees(DIAL)
        for i, run in enumerate(data.runs):
            left.plot(dial, np.degrees(run), linestyle="none", marker="os^"[i], markersize=4,
                      color=SERIES[i]["color"], label=f"run {i + 1}")  # fmt: skip
        left.plot(dial, np.degrees(data.runs.mean(axis=0)), color=BLACK, label="mean")
        left.plot(dial, np.degrees(data.formula), **SERIES[3], label="formula, lasting part")
        left.legend(loc="best", ncols=2, fontsize=8)
        worst = np.degrees(data.largest)
        middle = np.median(worst, axis=1)
        low, high = np.quantile(worst, [0.1, 0.9], axis=1)
        right.errorbar(LASTING, middle, [middle - low, high - middle], color=SERIES[0]["color"],
                       marker="o", linestyle="none", capsize=3,
                       label="median, and 10 to 90 % of the units")  # fmt: skip
        right.axhline(PRINTED, **SERIES[1], label=f"printed: {PRINTED:g}°")
        right.legend(loc="upper left", fontsize=8)
