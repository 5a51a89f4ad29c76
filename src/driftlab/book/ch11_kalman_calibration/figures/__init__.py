"""The published figures of chapter 11, with their captions."""

from collections.abc import Callable
from types import ModuleType

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from . import (
    calibration_errors,
    designed_scheme,
    filter_consistency,
    in_place,
    in_place_claim,
    neglected_terms,
    scheme_directions,
    size_effect,
    table_observability,
)

_DRAWN: tuple[tuple[str, Callable[..., DataTable], ModuleType, bool], ...] = (
    ("11-scheme-directions", experiments.up_in_body_axes, scheme_directions, False),
    ("11-table-observability", experiments.states_on_a_table, table_observability, False),
    ("11-calibration-errors", experiments.calibration_errors, calibration_errors, False),
    ("11-designed-scheme", experiments.designed_schemes, designed_scheme, True),
    ("11-filter-consistency", experiments.filter_consistency, filter_consistency, False),
    ("11-size-effect", experiments.size_effect, size_effect, True),
    ("11-neglected-terms", experiments.neglected_terms, neglected_terms, True),
    ("11-in-place", experiments.errors_at_rest, in_place, False),
    ("11-in-place-claim", experiments.error_ratios_at_rest, in_place_claim, True),
)
"""Name, what computes it, what draws it, and whether that takes minutes."""

FIGURES = tuple(
    FigureDefinition(name, compute, module.draw, module.caption, kept=kept)
    for name, compute, module, kept in _DRAWN
)
