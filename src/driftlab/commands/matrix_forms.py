"""A unit's errors in the form of other programs, for those who go on with them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields
from typing import Any

import numpy as np

from driftlab.calibration import (
    ImucalMatrices,
    ImuTkMatrices,
    KalibrMatrices,
    PsinsMatrices,
    RosMatrices,
    imu_errors_in_frame,
)
from driftlab.imu import ImuErrors

from .findings import Table

FORMS: Mapping[str, tuple[Any, str]] = {
    "imu-tk": (ImuTkMatrices, "lower triangle accelerometers"),
    "imucal": (ImucalMatrices, ""),
    "kalibr": (KalibrMatrices, "accelerometers"),
    "psins": (PsinsMatrices, ""),
    "ros": (RosMatrices, ""),
}
"""By program, its matrices, and its body axes if the accelerometers fix them by a triangle."""


def matrices(errors: ImuErrors, form: str) -> dict[str, np.ndarray]:
    """The matrices and biases of a program, by their names there, in its own body axes."""
    kind, axes = FORMS[form]
    if axes:
        errors, _ = imu_errors_in_frame(errors, axes)
        # What the rotation leaves of zero; a program may refuse it.
        half = np.tril if axes == "accelerometers" else np.triu
        errors = errors._replace(accelerometer_error=half(errors.accelerometer_error))
    made = kind.from_imu_errors(errors)
    arrays = {
        field.name: np.asarray(getattr(made, field.name), float)
        for field in fields(made)
        if field.name != "readings"
    }
    return {name: array for name, array in arrays.items() if array.any()}


def form_values(errors: ImuErrors) -> dict[str, Any]:
    """The forms for other programs, all of them."""
    return {form: matrices(errors, form) for form in FORMS}


def form_tables(errors: ImuErrors, forms: Sequence[str]) -> list[Table]:
    """Those that were asked for, to read: a matrix is three rows."""
    tables = []
    for form in dict.fromkeys(forms):
        rows = []
        for name, array in matrices(errors, form).items():
            for number, line in enumerate(np.atleast_2d(array)):
                cells = (f"{x + 0.0:.7f}" for x in np.round(np.broadcast_to(line, 3), 7))
                rows.append((name if number == 0 else "", *cells))
        tables.append(Table(f"As {form} has it", ("", "1", "2", "3"), tuple(rows), "SI units."))
    return tables
