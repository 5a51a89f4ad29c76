"""Experiments of chapter 13: alignments with sensor errors, and with noise."""

from .averaging import (
    GYROS as GYROS,
    MOVING_AVERAGE as MOVING_AVERAGE,
    RIVAL_WINDOW as RIVAL_WINDOW,
    SLOW as SLOW,
    WHITE as WHITE,
    gyro_noise as gyro_noise,
    heading_spread_by_window as heading_spread_by_window,
    rival_noise as rival_noise,
)
from .budget import (
    ACCELEROMETER_BIAS as ACCELEROMETER_BIAS,
    GYRO_BIAS as GYRO_BIAS,
    HEADING as HEADING,
    PITCH as PITCH,
    ROLL as ROLL,
    TERMS as TERMS,
    alignment_budget as alignment_budget,
)
from .fine_alignment import fine_alignment_trial as fine_alignment_trial
from .level_box import MAGNIFIED as MAGNIFIED, level_box as level_box
from .terms import GRIDS as GRIDS, LABELS as LABELS, alignment_terms as alignment_terms
from .two_positions import UNITS as UNITS, two_positions as two_positions
from .vertical import (
    BOXES as BOXES,
    ERRORS_SHOWN as ERRORS_SHOWN,
    errors_over_the_vertical as errors_over_the_vertical,
    over_the_top as over_the_top,
)
