"""The slider panels of chapter 11."""

from .on_the_table import (
    CalibrationRunExplorer as CalibrationRunExplorer,
    ObservabilityExplorer as ObservabilityExplorer,
)

PANELS = (ObservabilityExplorer, CalibrationRunExplorer)
