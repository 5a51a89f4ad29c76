"""The published figures of chapter 12, with their captions."""

from collections.abc import Callable
from types import ModuleType

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from . import (
    assumed_noise,
    filter_consistency,
    in_place,
    in_place_claim,
    many_runs,
    neglected_terms,
    reference_velocity,
    size_effect,
    varying_biases,
)

_DRAWN: tuple[tuple[str, Callable[..., DataTable], ModuleType, bool], ...] = (
    ("12-many-runs", experiments.squared_errors, many_runs, False),
    ("12-filter-consistency", experiments.filter_consistency, filter_consistency, False),
    ("12-size-effect", experiments.size_effect, size_effect, True),
    ("12-varying-biases", experiments.varying_biases, varying_biases, True),
    ("12-neglected-terms", experiments.neglected_terms, neglected_terms, True),
    ("12-reference-velocity", experiments.on_reference_velocity, reference_velocity, False),
    ("12-assumed-noise", experiments.assumed_noise, assumed_noise, False),
    ("12-in-place", experiments.errors_at_rest, in_place, False),
    ("12-in-place-claim", experiments.error_ratios_at_rest, in_place_claim, True),
)
"""Name, what computes it, what draws it, and whether that takes minutes."""

FIGURES = tuple(
    FigureDefinition(name, compute, module.draw, module.caption, kept=kept)
    for name, compute, module, kept in _DRAWN
)
