"""Attitude from a million increments by two algorithms and by the peers.

The body goes round a cone, so that the true attitude and the increments are known in closed form.
Errors are against that truth: what an algorithm leaves out counts. They are the largest of the
first two minutes, because not all peers go through the whole in a bearable time.
"""

from collections.abc import Iterator
from functools import partial

import numpy as np
from scipy.spatial.transform import Rotation

from driftlab.attitude import ALGORITHMS, integrate
from driftlab.earth import earth_rate
from driftlab.motion import Coning
from driftlab.quaternion import conjugate, multiply

from . import floor
from .measuring import Contender, Row, and_by_numpy, copy_of, in_c, largest_angle
from .navigation import INTERVAL, LATITUDE, NED, attitudes_of_pyins, by_pyins

COUNT, SOME, WITH_NAVIGATION = 10**6 - 10**6 % 12, 12_000, 120_000
"""Increments; those for a Python loop and for the errors; those for pyins."""


def rows() -> Iterator[Row]:
    motion = Coning(np.radians(1.0), 5.0)
    increments = np.ascontiguousarray(motion.increments(INTERVAL, COUNT))
    attitudes = motion.attitude(INTERVAL * np.arange(SOME + 1))
    true = multiply(conjugate(attitudes[0]), attitudes[1:])

    def numpy_quaternion() -> Contender:
        import quaternion

        def run() -> np.ndarray:
            steps = quaternion.from_rotation_vector(increments)
            return quaternion.as_float_array(np.multiply.accumulate(steps))

        def error(found: np.ndarray) -> float:
            return largest_angle(np.roll(found[:SOME], -1, axis=-1), true)

        return Contender("numpy-quaternion, accumulate", run, error)

    def ahrs() -> Contender:
        from ahrs.filters import AngularRate

        method = AngularRate(frequency=1 / INTERVAL)

        def run() -> np.ndarray:
            attitude = np.array([1.0, 0.0, 0.0, 0.0])
            for rate in increments[:SOME] / INTERVAL:
                attitude = method.update(attitude, rate, method="closed")
            return np.roll(attitude, -1)

        last = partial(largest_angle, true=true[-1])
        return Contender("ahrs AngularRate, a Python loop", run, last, SOME / COUNT)

    def pyins() -> Contender:
        rows = increments[:WITH_NAVIGATION]
        # Without altitude and forces it stays where it is, but for the free fall that is held.
        run = by_pyins(np.eye(3), np.hstack([rows, np.zeros_like(rows)]), with_altitude=False)

        def error(way: object) -> float:
            # Its reference frame turns with the Earth.
            turned = Rotation.from_rotvec(INTERVAL * SOME * NED @ earth_rate(LATITUDE))
            return largest_angle((turned * attitudes_of_pyins(way)[SOME]).as_quat(), true[-1])

        # Its integrator carries velocity and position along; there is none for attitude alone.
        why = "It corrects coning, which picard-1 does not; two-step-4 above does."
        name, part = "pyins, compiled, with navigation", WITH_NAVIGATION / COUNT
        return Contender(name, run, error, part, why)

    # What one has without a choice, and what multiplies the increments as they are, as most peers.
    for name, title in (("two-step-4", "two-step-4 (the default)"), ("picard-1", "picard-1")):
        samples = ALGORITHMS[name].samples

        def error(found: np.ndarray, samples: int = samples) -> float:
            return largest_angle(found[: SOME // samples], true[samples - 1 :: samples])

        row = Row(
            f"{title}, {COUNT} increments",
            Contender("driftlab", partial(integrate, increments, name), error),
            [numpy_quaternion, ahrs, pyins],
            [copy_of(increments), in_c(partial(floor.attitude, increments, name), error)],
            (COUNT, "an increment"),
            "rad in two minutes",
        )
        yield from and_by_numpy(row)
