"""States of a calibration filter that describe `HigherOrderErrors`, in groups to choose from."""

from __future__ import annotations

from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from driftlab.checks import FloatArray, shown
from driftlab.core.lever_arms import lever_matrices
from driftlab.core.vectors import cross_matrix
from driftlab.higher_order_errors import (
    NO_HIGHER_ORDER_ERRORS,
    HigherOrderErrors,
    checked_higher_order_errors,
)
from driftlab.imu import PriorDeviations

from ._triad_bases import AXES

_PAIRS = [f"{i}{j}" for i in AXES for j in AXES]


class Group(NamedTuple):
    """States that are chosen together: a field of `HigherOrderErrors`, row by row."""

    field: str
    prior: str
    names: tuple[str, ...]


GROUPS = MappingProxyType({
    "lever arms": Group(
        "lever_arms", "lever_arm", tuple(f"accelerometer lever arm {pair}" for pair in _PAIRS)
    ),
    "time skew": Group("time_skew", "time_skew", ("accelerometer time skew",)),
    "accelerometer quadratic": Group(
        "accelerometer_quadratic",
        "accelerometer_quadratic",
        tuple(f"accelerometer quadratic {axis}" for axis in AXES),
    ),
    "gyro g-sensitivity": Group(
        "gyro_g_sensitivity",
        "gyro_g_sensitivity",
        tuple(f"gyro g-sensitivity {pair}" for pair in _PAIRS),
    ),
})  # fmt: skip
"""What can be added to the states of bias and matrix."""


def checked_groups(chosen: tuple[str, ...]) -> tuple[str, ...]:
    """Return chosen groups in the order of `GROUPS`, each once, refusing unknown ones."""
    for name in chosen:
        if not isinstance(name, str) or name not in GROUPS:
            raise ValueError(f"states: expected some of {', '.join(GROUPS)}, got {shown(name)}.")
    return tuple(name for name in GROUPS if name in chosen)


def unpacked(values: FloatArray, chosen: tuple[str, ...]) -> HigherOrderErrors:
    """Errors (...) of states (..., m); zero for the groups that are not chosen."""
    fields, begin = {}, 0
    for name in chosen:
        group = GROUPS[name]
        part = values[..., begin : begin + len(group.names)]
        shape = getattr(NO_HIGHER_ORDER_ERRORS, group.field).shape
        fields[group.field] = part.reshape((*values.shape[:-1], *shape))
        begin += len(group.names)
    return NO_HIGHER_ORDER_ERRORS._replace(**fields)


def packed(higher_order: HigherOrderErrors, chosen: tuple[str, ...]) -> FloatArray:
    """States (..., m) of errors (...)."""
    errors = checked_higher_order_errors(higher_order)
    lead = errors.time_skew.shape
    parts = [getattr(errors, GROUPS[name].field).reshape(*lead, -1) for name in chosen]
    return np.concatenate([np.zeros((*lead, 0)), *parts], axis=-1)


def prior_deviations(prior: PriorDeviations, chosen: tuple[str, ...]) -> FloatArray:
    """Standard deviations (m,) of the states before a calibration."""
    groups = [GROUPS[name] for name in chosen]
    return np.array([getattr(prior, group.prior) for group in groups for _ in group.names])


def effects(
    chosen: tuple[str, ...],
    times: FloatArray,
    angle: FloatArray,
    velocity: FloatArray,
    rate_change: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Errors of gyros and accelerometers (..., 3 n, m), three rows a node, of each state.

    The derivatives of `driftlab.higher_order_errors.felt_besides`.
    """
    lead = np.broadcast_shapes(times.shape, angle.shape[:-1], velocity.shape[:-1])
    seconds = times[..., np.newaxis]
    of_gyros, of_accelerometers = [], []
    for name in chosen:
        count = len(GROUPS[name].names)
        turned = pushed = np.zeros((*lead, 3, count))
        if name == "lever arms":
            arms = lever_matrices(times, angle, rate_change)
            pushed = _on_the_diagonal(arms)
        elif name == "time skew":
            pushed = (np.cross(angle, velocity) / seconds)[..., np.newaxis]
        elif name == "accelerometer quadratic":
            pushed = (velocity**2 / seconds)[..., np.newaxis] * np.eye(3)
        else:
            rows = np.broadcast_to(velocity[..., np.newaxis, :], (*velocity.shape, 3))
            turned = _on_the_diagonal(rows)
        of_gyros.append(np.broadcast_to(turned, (*lead, 3, count)))
        of_accelerometers.append(np.broadcast_to(pushed, (*lead, 3, count)))
    shape = (*lead[:-1], 3 * lead[-1], -1)
    return (
        np.concatenate(of_gyros, axis=-1).reshape(shape),
        np.concatenate(of_accelerometers, axis=-1).reshape(shape),
    )


def of_a_jump(chosen: tuple[str, ...], change: FloatArray) -> FloatArray:
    """Velocity (..., 3, m) in body axes that a jump (..., 3) of the rate makes of each state."""
    count = sum(len(GROUPS[name].names) for name in chosen)
    pushes = np.zeros((*change.shape[:-1], 3, count))
    if "lever arms" in chosen:  # which stand first; the others do not feel it
        pushes[..., :9] = _on_the_diagonal(cross_matrix(change))
    return pushes


def _on_the_diagonal(rows: FloatArray) -> FloatArray:
    """Matrices (..., 3, 9): row i of (..., 3, 3) acts on the i-th three of nine states."""
    blocks = np.eye(3)[:, :, np.newaxis] * rows[..., :, np.newaxis, :]
    return blocks.reshape(*rows.shape[:-1], 9)
