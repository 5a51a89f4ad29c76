"""The polynomial that a step puts through its increments: from halves, or from the past."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, positive_number

EDGES = {"two halves": (0.0, 0.5, 1.0), "two before": (-2.0, -1.0, 0.0, 1.0)}
"""Ends of the increments that a step from 0 to 1 uses, by way."""


def polynomials_through_increments(rate: float = 1.1) -> DataTable:
    """Fit the polynomials of one step to a sine whose phase grows by so many rad in a step."""
    around = positive_number(rate, "rate")
    columns: dict[str, dict[str, FloatArray]] = {
        name: {} for name in ("time", "true", "mean", "polynomial")
    }
    for way, edges in EDGES.items():
        ends = np.array(edges)
        powers = np.arange(len(ends) - 1)
        means = -np.diff(np.cos(around * ends)) / around / np.diff(ends)
        matrix = np.diff(ends[:, np.newaxis] ** (powers + 1), axis=0) / (powers + 1)
        fitted = np.linalg.solve(matrix, means * np.diff(ends))
        time = np.linspace(ends[0], ends[-1], 241)
        held = np.clip(ends.searchsorted(time, side="right") - 1, 0, len(means) - 1)
        columns["time"][way], columns["mean"][way] = time, means[held]
        columns["true"][way] = np.sin(around * time)
        columns["polynomial"][way] = np.polynomial.polynomial.polyval(time, fitted)
    meanings = ("in steps", "rate", "its mean over each increment", "with the same increments")
    return DataTable(
        {
            name: (values, "", meaning)
            for (name, values), meaning in zip(columns.items(), meanings, strict=True)
        }
    )
