"""Rotation schemes that a search has found, beside the published ones and beside random ones."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration.covariance import covariance_analysis
from driftlab.calibration.design_task import CRITERIA, DesignTask
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.calibration.linearization import linearize_along
from driftlab.calibration.scheme_design import design_scheme
from driftlab.calibration.simulation import TableTrial
from driftlab.checks import FloatArray, whole_number
from driftlab.imu import ImuNoise, PriorDeviations
from driftlab.monte_carlo import sweep
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


class TriedScheme(NamedTuple):
    """A scheme in the time of the nineteen positions, and what is expected after it."""

    kind: str  # "published", "designed" or "random"
    name: str
    scheme: Scheme
    criteria: FloatArray  # (3,), as `CRITERIA`
    # (21,), deviations of the sensor errors over those after the nineteen positions
    ratios: FloatArray


class DesignedSchemes(NamedTuple):
    """All schemes that were tried, and units that were calibrated on two of them."""

    schemes: list[TriedScheme]  # the published ones first, then the designs, then the random ones
    # (units, 21) each, errors of the sensor errors found by the filter, over the deviation that is
    # expected after the nineteen positions; by the name of the scheme. The same units on both
    errors: dict[str, FloatArray]
    # (units,) each, squared normalised errors of the 27 states at the end, over 27
    nees: dict[str, FloatArray]

    def named(self, name: str) -> TriedScheme:
        """Return the scheme of a name."""
        return next(each for each in self.schemes if each.name == name)

    def gained(self) -> tuple[FloatArray, FloatArray]:
        """Errors on the design over those on the nineteen positions, and standard errors (21,).

        Root mean squares over the units; the standard error leaves out one unit in turn, and so
        knows that both schemes had the same units.
        """
        before, after = ((errors**2) for errors in self.errors.values())
        ratio = np.sqrt(after.mean(0) / before.mean(0))
        without = np.sqrt((after.sum(0) - after) / (before.sum(0) - before))
        spread = without.std(axis=0) * np.sqrt(len(without) - 1)
        return ratio, spread

    def of_kind(self, kind: str) -> list[TriedScheme]:
        """Return all schemes of a kind."""
        return [each for each in self.schemes if each.kind == kind]


def expected_covariance(scheme: Scheme, latitude: float = TABLE_LATITUDE) -> FloatArray:
    """Covariance (27, 27) after a scheme, for the typical noise and prior."""
    way = linearize_along(scheme, latitude, ERROR_MODELS["averaged"])
    return covariance_analysis(way, ImuNoise(), PriorDeviations())


def designed_schemes(
    random_schemes: int = RANDOM,
    draws: int = DRAWS,
    climbs: int = 1,
    units: int = UNITS,
    positions: int = NINETEEN_POSITIONS.positions,
    duration: float = TASKS[BEST].duration,
    latitude: float = TABLE_LATITUDE,
    seed: int = SEED,
) -> DesignedSchemes:
    """Search for schemes, draw random ones, and calibrate units on the best: some minutes.

    `draws` and `climbs` are those of `driftlab.calibration.design_scheme`.
    """
    rng = np.random.default_rng(whole_number(seed, "seed", least=0))
    tasks = {
        name: replace(task, positions=positions, duration=duration, latitude=latitude)
        for name, task in TASKS.items()
    }
    begin = NINETEEN_POSITIONS if positions == NINETEEN_POSITIONS.positions else None
    task = tasks[BEST]
    rows = [("published", name, each.lasting(task.duration)) for name, each in SCHEMES.items()]
    for name, each in tasks.items():
        design = design_scheme(each, rng, draws=draws, climbs=climbs, begin=begin)
        rows.append(("designed", name, design.scheme))
    random = task.random_schemes(rng, random_schemes)
    rows += [("random", f"random {i}", scheme) for i, scheme in enumerate(random, 1)]
    yardstick = np.sqrt(np.diag(expected_covariance(rows[0][2], latitude)))[6:]
    tried = []
    for kind, name, scheme in rows:
        covariance = expected_covariance(scheme, latitude)
        ratios = np.sqrt(np.diag(covariance))[6:] / yardstick
        criteria = [float(replace(task, criterion=one).values(covariance)) for one in CRITERIA]
        tried.append(TriedScheme(kind, name, scheme, np.array(criteria), ratios))
    errors, nees = {}, {}
    for chosen in (tried[0], tried[len(SCHEMES)]):
        errors[chosen.name], nees[chosen.name] = _calibrated(
            chosen.scheme, latitude, whole_number(units, "units", least=2), seed
        )
        errors[chosen.name] /= yardstick
    return DesignedSchemes(tried, errors, nees)


def _calibrated(
    scheme: Scheme, latitude: float, units: int, seed: int
) -> tuple[FloatArray, FloatArray]:
    """Errors (units, 21) and squared normalised errors (units,) of the same units each time."""
    # An update every three seconds tells as much as three that are each so much noisier.
    noise = ImuNoise(reference_velocity=ImuNoise().reference_velocity / np.sqrt(3))
    table = TableTrial(
        latitude=latitude, sample_interval=0.1, update_interval=3.0, noise=noise, keep=100_000
    )
    # Whole updates, and no pause is longer than it may be.
    table = replace(table, scheme=replace(scheme, dwell=3.0 * (scheme.dwell // 3.0)))
    batches = sweep(table.run, units, seed=seed, batch=25)
    errors = np.concatenate([batch.errors[:, -1, 6:] for batch in batches])
    nees = np.concatenate([batch.nees[:, -1] for batch in batches])
    return errors, nees / batches[0].errors.shape[-1]
