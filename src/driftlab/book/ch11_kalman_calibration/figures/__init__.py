"""The published figures of chapter 11, with their captions."""

from collections.abc import Callable
from types import ModuleType

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from . import (
    calibration_errors,
    designed_scheme,
    error_growth,
    scheme_directions,
    table_observability,
)

_DRAWN: tuple[tuple[str, Callable[..., DataTable], ModuleType, bool], ...] = (
    ("11-scheme-directions", experiments.up_in_body_axes, scheme_directions, False),
    ("11-error-growth", experiments.error_growth, error_growth, False),
    ("11-table-observability", experiments.states_on_a_table, table_observability, False),
    ("11-calibration-errors", experiments.calibration_errors, calibration_errors, False),
    ("11-designed-scheme", experiments.designed_schemes, designed_scheme, True),
)
"""Name, what computes it, what draws it, and whether that takes minutes."""

FIGURES = tuple(
    FigureDefinition(name, compute, module.draw, module.caption, kept=kept)
    for name, compute, module, kept in _DRAWN
)
