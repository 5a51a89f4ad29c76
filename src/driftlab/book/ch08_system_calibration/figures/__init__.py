"""The published figures of chapter 08, with their captions."""

from driftlab.book.machinery.publish import table_figure

from .. import experiments
from . import (
    calibration_errors,
    choice_of_axes,
    designed_scheme,
    filter_consistency,
    in_place,
    in_place_claim,
    scheme_directions,
    size_effect,
    table_observability,
)

FIGURES = (
    table_figure(
        "08-scheme-directions",
        experiments.up_in_body_axes,
        scheme_directions.draw,
        scheme_directions.caption,
    ),
    table_figure(
        "08-table-observability",
        experiments.states_on_a_table,
        table_observability.TableObservabilityPicture.draw,
        table_observability.caption,
    ),
    table_figure(
        "08-calibration-errors",
        experiments.calibration_errors,
        calibration_errors.draw,
        calibration_errors.caption,
    ),
    table_figure(
        "08-designed-scheme",
        experiments.designed_schemes,
        designed_scheme.draw,
        designed_scheme.caption,
        kept=True,
    ),
    table_figure(
        "08-filter-consistency",
        experiments.filter_consistency,
        filter_consistency.draw,
        filter_consistency.caption,
    ),
    table_figure(
        "08-size-effect",
        experiments.size_effect,
        size_effect.draw,
        size_effect.caption,
        kept=True,
    ),
    table_figure(
        "08-choice-of-axes",
        experiments.choice_of_axes,
        choice_of_axes.draw,
        choice_of_axes.caption,
        kept=True,
    ),
    table_figure("08-in-place", experiments.errors_at_rest, in_place.draw, in_place.caption),
    table_figure(
        "08-in-place-claim",
        experiments.error_ratios_at_rest,
        in_place_claim.draw,
        in_place_claim.caption,
        kept=True,
    ),
)
