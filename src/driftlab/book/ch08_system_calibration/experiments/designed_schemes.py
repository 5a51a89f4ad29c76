"""Rotation schemes that a search has found, beside the published ones and beside random ones."""

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
from driftlab.calibration.scheme_design import CRITERIA
from driftlab.checks import FloatArray, whole_number
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.monte_carlo import run_batches
from driftlab.motion.scheme import NINETEEN_POSITIONS, SCHEMES, Scheme

BEST, FREE = "worst, two axes", "worst, three axes"
TASKS = {
    BEST: DesignTask("worst", latitude=TABLE_LATITUDE),
    "mean, two axes": DesignTask("mean", latitude=TABLE_LATITUDE),
    "volume, two axes": DesignTask("volume", latitude=TABLE_LATITUDE),
    "worst, quarter turns": DesignTask("worst", latitude=TABLE_LATITUDE, angles=(90,)),
    FREE: DesignTask("worst", latitude=TABLE_LATITUDE, two_axes=False),
}
"""The designs of the figure, by criterion and table."""

RANDOM = 200
"""Random rows on two axes, the background."""
DRAWS = 100
"""Random rows from which each search begins."""
SEED = 1992
UNITS = 100
"""Simulated units that go through the filter on the nineteen positions and on the design."""
UNIT = "unit after "
"""Beginning of the kind of a row that is a simulated unit."""
CLASSES = np.geomspace(0.024, 1.1, 25)
"""Limits of the bars that count random schemes: what is left of the error that is known worst."""


def expected_covariance(scheme: Scheme, latitude: float = TABLE_LATITUDE) -> FloatArray:
    """Covariance (27, 27) after a scheme, for the typical noise and prior."""
    way = linearize_along(scheme, latitude, ERROR_MODELS["averaged"])
    return covariance_analysis(way, ImuNoise(), PriorStandardDeviations())


def designed_schemes(
    random_schemes: int = RANDOM,
    draws: int = DRAWS,
    climbs: int = 1,
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
    yardstick = np.sqrt(np.diag(expected_covariance(rows[0][2], latitude)))[6:]
    criteria, ratios = [], []
    for _, _, scheme in rows:
        covariance = expected_covariance(scheme, latitude)
        ratios.append(np.sqrt(np.diag(covariance))[6:] / yardstick)
        criteria.append([replace(task, criterion=one).values(covariance) for one in CRITERIA])
    units = whole_number(units, "units", least=2)
    for _, name, scheme in (rows[0], rows[len(SCHEMES)]):
        errors, nees = _calibrated(scheme, latitude, units, seed)
        rows += [(UNIT + name, "", scheme)] * units
        ratios += [*(errors / yardstick)]
        criteria += [[each] * len(CRITERIA) for each in nees]
    kinds, names, schemes = zip(*rows, strict=True)
    worst, after = np.array(criteria)[:, 0], np.array(ratios)
    random_rows = np.array(kinds) == "random"
    low, middle, high = np.percentile(after[random_rows], [5, 50, 95], 0)
    gain, spread = _gained(*np.split(after[-2 * units :], 2))
    counts, _ = np.histogram(worst[random_rows], CLASSES)
    _, eighteen = SCHEMES
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
                {name: after[names.index(name)] for name in (eighteen, FREE, BEST)}, "",
                "ratios after one scheme",
            ),
            "simulated": (gain, "", "errors of units after the design, over the others"),
            "simulated_low": (gain - spread, "", "less a standard error"),
            "simulated_high": (gain + spread, "", "plus a standard error"),
            "worst_of_random_rows": ((CLASSES[1:] + CLASSES[:-1]) / 2, "", "middle of a class"),
            "random_rows": (counts, "", "in this class"),
            "least_known": (
                {name: worst[[names.index(name)]] for name in (*SCHEMES, BEST, FREE)}, "",
                "what is left of the sensor error that is known worst",
            ),
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
    # An update every three seconds tells as much as three that are each so much noisier.
    noise = ImuNoise(reference_velocity=ImuNoise().reference_velocity / np.sqrt(3))
    table = TurntableTrial(
        latitude=latitude, sample_interval=0.1, update_interval=3.0, noise=noise, keep=100_000
    )
    # Whole updates, and no pause is longer than it may be.
    table = replace(table, scheme=replace(scheme, dwell=3.0 * (scheme.dwell // 3.0)))
    batches = run_batches(table.run, units, seed=seed, batch_size=25)
    errors = np.concatenate([batch.errors[:, -1, 6:] for batch in batches])
    nees = np.concatenate([batch.nees[:, -1] for batch in batches])
    return errors, nees / batches[0].errors.shape[-1]
