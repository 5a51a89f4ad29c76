"""Experiments of chapter 09: alignments with sensor errors, and with noise."""

from .averaging import (
    MOVING_AVERAGE,
    RIVAL_WINDOW,
    SLOW,
    WHITE,
    AveragingWindow,
    gyro_noise,
    heading_spread_by_window,
    rival_noise,
)
from .budget import (
    ACCELEROMETER_BIAS,
    GYRO_BIAS,
    HEADING,
    PITCH,
    ROLL,
    TERMS,
    AlignmentBudget,
    alignment_budget,
)
from .level_box import FARTHEST, MAGNIFIED, LevelBox, level_box
from .terms import FIXED, GRIDS, AlignmentTerms, alignment_terms
from .two_positions import MINUTES, TURN_ERROR, UNITS, TwoPositions, two_positions
from .vertical import (
    BOXES,
    ERRORS_SHOWN,
    OverTheTop,
    OverTheVertical,
    errors_over_the_vertical,
    over_the_top,
    turn_over,
)

__all__ = [
    "ACCELEROMETER_BIAS",
    "BOXES",
    "ERRORS_SHOWN",
    "FARTHEST",
    "FIXED",
    "GRIDS",
    "GYRO_BIAS",
    "HEADING",
    "MAGNIFIED",
    "MINUTES",
    "MOVING_AVERAGE",
    "PITCH",
    "RIVAL_WINDOW",
    "ROLL",
    "SLOW",
    "TERMS",
    "TURN_ERROR",
    "UNITS",
    "WHITE",
    "AlignmentBudget",
    "AlignmentTerms",
    "AveragingWindow",
    "LevelBox",
    "OverTheTop",
    "OverTheVertical",
    "TwoPositions",
    "alignment_budget",
    "alignment_terms",
    "errors_over_the_vertical",
    "gyro_noise",
    "heading_spread_by_window",
    "level_box",
    "over_the_top",
    "rival_noise",
    "turn_over",
    "two_positions",
]
