"""Experiments of chapter 08: what a turntable shows, calibrations, and what they are good for."""

from .at_rest import FRAMES, REST_DURATION, InPlaceErrors, errors_at_rest
from .calibration import (
    PARAMETERS,
    CalibrationErrors,
    CalibrationRun,
    calibration_errors,
    calibration_history,
    typical_trial,
    unit_of,
)
from .choice_of_axes import (
    BATCH,
    CASES,
    SIZES,
    UNITS,
    Case,
    ChoiceOfAxes,
    choice_of_axes,
    normalised_errors,
)
from .consistency import (
    QUICK_TRIAL,
    RUNS,
    FilterConsistency,
    filter_consistency,
)
from .in_place_claim import (
    AT_REST_SIZES,
    AVERAGED,
    QUANTITIES,
    TRIANGLES,
    Comparison,
    InPlaceClaim,
    error_ratios,
    error_ratios_at_rest,
)
from .scheme_run import SchemeRun, scheme_run
from .schemes import (
    SchemeDirections,
    TableObservability,
    table_observability,
    up_in_body_axes,
)
from .starts import ALL_STARTS, STARTS
from .verdicts import Verdict, verdict

__all__ = [
    "ALL_STARTS",
    "AT_REST_SIZES",
    "AVERAGED",
    "BATCH",
    "CASES",
    "FRAMES",
    "PARAMETERS",
    "QUANTITIES",
    "QUICK_TRIAL",
    "REST_DURATION",
    "RUNS",
    "SIZES",
    "STARTS",
    "TRIANGLES",
    "UNITS",
    "CalibrationErrors",
    "CalibrationRun",
    "Case",
    "ChoiceOfAxes",
    "Comparison",
    "FilterConsistency",
    "InPlaceClaim",
    "InPlaceErrors",
    "SchemeDirections",
    "SchemeRun",
    "TableObservability",
    "Verdict",
    "calibration_errors",
    "calibration_history",
    "choice_of_axes",
    "error_ratios",
    "error_ratios_at_rest",
    "errors_at_rest",
    "filter_consistency",
    "normalised_errors",
    "scheme_run",
    "table_observability",
    "typical_trial",
    "unit_of",
    "up_in_body_axes",
    "verdict",
]
