"""Experiments of chapter 18: areas on the sphere, functional iteration, finite word length."""

from .closed_cones import closed_cone as closed_cone, swept_in_a_sample as swept_in_a_sample
from .functional_iteration import (
    WIDE_BRACKET as WIDE_BRACKET,
    WIDE_BRACKET_RATE as WIDE_BRACKET_RATE,
    WINDOWS as WINDOWS,
    precession as precession,
    precession_error as precession_error,
    precession_error_of_peer as precession_error_of_peer,
    turned_by_fit as turned_by_fit,
    window_errors as window_errors,
    window_noise_growth as window_noise_growth,
)
from .rod import rod_round_the_sphere as rod_round_the_sphere
from .start import STARTS as STARTS, first_steps as first_steps
from .word_length import (
    ARITHMETICS as ARITHMETICS,
    EARTH_RATE as EARTH_RATE,
    STEP_ANGLES as STEP_ANGLES,
    STORED_AS_ONE as STORED_AS_ONE,
    WORD_MOTIONS as WORD_MOTIONS,
    advice_gains as advice_gains,
    errors_by_step as errors_by_step,
    rows_of as rows_of,
    short_word_errors as short_word_errors,
)
