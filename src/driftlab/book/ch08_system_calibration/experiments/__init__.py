"""Experiments of chapter 08: what a turntable shows, calibrations, and what they are good for."""

from .at_rest import (
    ALL_STARTS,
    FRAMES,
    QUANTITIES,
    REST_DURATION,
    STARTS,
    InPlaceClaim,
    InPlaceErrors,
    Verdict,
    error_ratios_at_rest,
    errors_at_rest,
    verdict,
)
from .calibration import (
    PARAMETERS,
    CalibrationErrors,
    CalibrationRun,
    calibration_errors,
    calibration_history,
    typical_trial,
    unit_of,
)
from .consistency import (
    QUICK_TRIAL,
    RUNS,
    RUNS_BY_FRAME,
    FilterConsistency,
    filter_consistency,
)
from .schemes import (
    SchemeDirections,
    TableObservability,
    table_observability,
    up_in_body_axes,
)

__all__ = [
    "ALL_STARTS",
    "FRAMES",
    "PARAMETERS",
    "QUANTITIES",
    "QUICK_TRIAL",
    "REST_DURATION",
    "RUNS",
    "RUNS_BY_FRAME",
    "STARTS",
    "CalibrationErrors",
    "CalibrationRun",
    "FilterConsistency",
    "InPlaceClaim",
    "InPlaceErrors",
    "SchemeDirections",
    "TableObservability",
    "Verdict",
    "calibration_errors",
    "calibration_history",
    "error_ratios_at_rest",
    "errors_at_rest",
    "filter_consistency",
    "table_observability",
    "typical_trial",
    "unit_of",
    "up_in_body_axes",
    "verdict",
]
