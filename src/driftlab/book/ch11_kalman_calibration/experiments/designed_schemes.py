"""Rotation schemes that a search has found for a table that stands, beside others."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration import (
    ERROR_MODELS,
    DesignTask,
    TurntableTrial,
    covariance_analysis,
    design_scheme,
    linearize_along,
)
from driftlab.calibration.error_model import ErrorModel
from driftlab.calibration.scheme_design import CRITERIA
from driftlab.checks import FloatArray, whole_number
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.monte_carlo import run_batches
from driftlab.motion.scheme import NINETEEN_POSITIONS, SCHEMES, Scheme

from .schemes import TYPICAL_NOISE, VELOCITIES

STANDING = 1e-4
"""m/s: a table that stands. Noise of the accelerometers adds half of it in a second, so that a
smaller reference velocity hardly changes anything."""
BEST, MEAN, LOOSE = "worst, two axes", "mean, two axes", "worst, for 1 cm/s"
_TASK = DesignTask("worst", latitude=TABLE_LATITUDE, noise=ImuNoise(reference_velocity=STANDING))
TASKS = {
    BEST: _TASK,
    MEAN: replace(_TASK, criterion="mean"),
    "volume, two axes": replace(_TASK, criterion="volume"),
    "worst, quarter turns": replace(_TASK, angles=(90,)),
    "worst, three axes": replace(_TASK, two_axes=False),
    LOOSE: replace(_TASK, noise=ImuNoise(reference_velocity=0.01)),
}
"""The designs of the figure, by criterion and table; the last is for a table that moves."""

RANDOM = 200
"""Random rows on two axes, the background."""
DRAWS = 100
"""Random rows from which each search begins."""
SEED = 1992
UNITS = 100
"""Simulated units that go through the filter on the nineteen positions and on the design `MEAN`."""
UNIT = "unit after "
"""Beginning of the kind of a row that is a simulated unit."""


def expected_covariance(
    scheme: Scheme,
    latitude: float = TABLE_LATITUDE,
    reference_velocity: float = TYPICAL_NOISE.reference_velocity,
    model: ErrorModel = ERROR_MODELS["averaged"],
) -> FloatArray:
    """Covariance (size, size) after a scheme, for the typical noise of the sensors and prior."""
    way = linearize_along(scheme, latitude, model)
    noise = ImuNoise(reference_velocity=reference_velocity)
    return covariance_analysis(way, noise, PriorStandardDeviations())


def designed_schemes(
    random_schemes: int = RANDOM,
    draws: int = DRAWS,
    climbs: int = 2,
    units: int = UNITS,
    positions: int = NINETEEN_POSITIONS.positions,
    duration: float = TASKS[BEST].duration,
    latitude: float = TABLE_LATITUDE,
    seed: int = SEED,
) -> DataTable:
    """Search for schemes, draw random ones, and calibrate units on the best: some minutes.

    `draws` and `climbs` are those of `driftlab.calibration.design_scheme`. A row of the table is a
    scheme, the published ones first, then the designs, then the random ones; or a unit that was
    calibrated on one of two, the same units on both. A unit has its errors instead of the
    deviations, and its NEES / 27 instead of the criteria.
    """
    rng = np.random.default_rng(whole_number(seed, "seed", least=0))
    tasks = {
        name: replace(task, positions=positions, duration=duration, latitude=latitude)
        for name, task in TASKS.items()
    }
    begin = NINETEEN_POSITIONS if positions == NINETEEN_POSITIONS.positions else None
    task = tasks[BEST]
    rows = [
        ("published", name, each.with_duration(task.duration)) for name, each in SCHEMES.items()
    ]
    for name, each in tasks.items():
        design = design_scheme(each, rng, draws=draws, climbs=climbs, begin=begin)
        rows.append(("designed", name, design.scheme))
    random = task.random_schemes(rng, random_schemes)
    rows += [("random", f"random {i}", scheme) for i, scheme in enumerate(random, 1)]
    yardstick = np.sqrt(np.diag(expected_covariance(rows[0][2], latitude, STANDING)))[6:]
    criteria, ratios = [], []
    for _, _, scheme in rows:
        covariance = expected_covariance(scheme, latitude, STANDING)
        ratios.append(np.sqrt(np.diag(covariance))[6:] / yardstick)
        criteria.append([replace(task, criterion=one).values(covariance) for one in CRITERIA])
    units = whole_number(units, "units", least=2)
    by_name = {name: scheme for _, name, scheme in rows}
    nineteen, eighteen = SCHEMES
    left = {
        name: np.array([
            task.values(expected_covariance(by_name[name], latitude, each)) for each in VELOCITIES
        ])
        for name in (nineteen, eighteen, BEST, LOOSE)
    }  # fmt: skip
    for name, scheme in ((nineteen, by_name[nineteen]), (MEAN, by_name[MEAN])):
        errors, nees = _calibrated(scheme, latitude, units, seed)
        rows += [(UNIT + name, "", scheme)] * units
        ratios += [*(errors / yardstick)]
        criteria += [[each] * len(CRITERIA) for each in nees]
    kinds, names, schemes = zip(*rows, strict=True)
    after = np.array(ratios)
    random_rows = np.array(kinds) == "random"
    low, middle, high = np.percentile(after[random_rows], [5, 50, 95], 0)
    gain, spread = _gained(*np.split(after[-2 * units :], 2))
    sensor_errors = ERROR_MODELS["averaged"].names[6:]
    return DataTable(
        {
            "kind": (kinds, "", "published, designed or random, or a unit after a scheme"),
            "name": (names, "", "of the scheme"),
            "rotations": ([scheme.rotations for scheme in schemes], "", "in order"),
            "start": ([" ".join(scheme.start) for scheme in schemes], "", "where x, y and z point"),
            "pause": (np.array([scheme.dwell for scheme in schemes]), "s", "between rotations"),
            "criterion": (np.array(criteria).T, "", "of a unit its NEES / 27", CRITERIA),
            "ratio": (
                after.T, "", "deviations, or a unit's errors, over those after 19 positions",
                sensor_errors,
            ),
            "sensor_error": (sensor_errors, "", "by name"),
            "random_5_percent": (low, "", "of the ratios of random rows"),
            "random_median": (middle, "", "likewise"),
            "random_95_percent": (high, "", "likewise"),
            "after": (
                {name: after[names.index(name)] for name in (eighteen, BEST, MEAN)}, "",
                "ratios after one scheme",
            ),
            "simulated": (gain, "", "errors of units after the design, over the others"),
            "simulated_low": (gain - spread, "", "less a standard error"),
            "simulated_high": (gain + spread, "", "plus a standard error"),
            "reference_velocity": (VELOCITIES, "mm_per_s", "standard deviation"),
            "least_known": (left, "", "what is left of the sensor error that is known worst"),
        },
        {"units": (units, "", "simulated units")},
    )  # fmt: skip


def rows_of(study: DataTable, kind: str) -> NDArray[np.intp]:
    """Return the places of all rows of a kind; that of a unit ends with the name of its scheme."""
    return np.flatnonzero(np.array(study.kind) == kind)


def scheme_of(study: DataTable, row: int) -> Scheme:
    """Return the scheme of a row."""
    x, y, z = study.start[row].split()
    return Scheme(study.rotations[row], (x, y, z), float(study.pause[row]))


def _gained(before: FloatArray, after: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Errors on the design over those on the nineteen positions, and standard errors (21,).

    Root mean squares over the units; the standard error leaves out one unit in turn, and so
    knows that both schemes had the same units.
    """
    before, after = before**2, after**2
    ratio = np.sqrt(after.mean(0) / before.mean(0))
    without = np.sqrt((after.sum(0) - after) / (before.sum(0) - before))
    return ratio, without.std(axis=0) * np.sqrt(len(without) - 1)


def _calibrated(
    scheme: Scheme, latitude: float, units: int, seed: int
) -> tuple[FloatArray, FloatArray]:
    """Errors (units, 21) and squared normalised errors (units,) of the same units each time."""
    noise = ImuNoise(reference_velocity=STANDING)
    table = TurntableTrial(latitude=latitude, sample_interval=0.1, noise=noise, keep=100_000)
    # Whole updates, and no pause is longer than it may be.
    table = replace(table, scheme=replace(scheme, dwell=scheme.dwell // 1.0))
    batches = run_batches(table.run, units, seed=seed, batch_size=25)
    errors = np.concatenate([batch.errors[:, -1, 6:] for batch in batches])
    nees = np.concatenate([batch.nees[:, -1] for batch in batches])
    return errors, nees / batches[0].errors.shape[-1]
