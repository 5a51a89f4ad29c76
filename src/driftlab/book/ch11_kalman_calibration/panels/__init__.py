"""The slider panels of chapter 11."""

from .mission import MissionExplorer as MissionExplorer
from .on_the_table import (
    CalibrationRunExplorer as CalibrationRunExplorer,
    ObservabilityExplorer as ObservabilityExplorer,
)

PANELS = (ObservabilityExplorer, CalibrationRunExplorer, MissionExplorer)
