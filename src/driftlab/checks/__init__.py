"""Checks of arguments: shape, finiteness, kind, size, and the sentence that explains a refusal.

Each check returns its value or raises a `ValueError` of one sentence: the argument's `name`, what
was expected, what was given. Public functions check their arguments once, at the door; the
functions behind it check nothing.
"""

from ._arrays import (
    LARGEST_NUMBER as LARGEST_NUMBER,
    SMALLEST_DIVISOR as SMALLEST_DIVISOR,
    ComplexArray as ComplexArray,
    FloatArray as FloatArray,
    common_leading_axes as common_leading_axes,
    finite_array as finite_array,
    finite_arrays as finite_arrays,
    nonzero_vectors as nonzero_vectors,
    one_quaternion as one_quaternion,
    positive_array as positive_array,
    unit_quaternions as unit_quaternions,
    whole_pairs as whole_pairs,
)
from ._magnitudes import (
    LARGEST_ACCELEROMETER_BIAS as LARGEST_ACCELEROMETER_BIAS,
    LARGEST_GYRO_BIAS as LARGEST_GYRO_BIAS,
    LARGEST_SCALE as LARGEST_SCALE,
    USUAL_ACCELEROMETER_BIAS as USUAL_ACCELEROMETER_BIAS,
    USUAL_GYRO_BIAS as USUAL_GYRO_BIAS,
    USUAL_TABLE as USUAL_TABLE,
    UnusualWarning as UnusualWarning,
    increments_of_velocity as increments_of_velocity,
    linear_error_matrix as linear_error_matrix,
    one_pull as one_pull,
    plausible_error_matrix as plausible_error_matrix,
    pull_of_gravity as pull_of_gravity,
    speed_of_body as speed_of_body,
    table_rate as table_rate,
    turned_angle as turned_angle,
    usual_deviation as usual_deviation,
    within as within,
)
from ._values import (
    checked_function as checked_function,
    checked_generator as checked_generator,
    checked_instance as checked_instance,
    checked_path as checked_path,
    checked_text as checked_text,
    chosen_number as chosen_number,
    finite_number as finite_number,
    keep as keep,
    named_or_own as named_or_own,
    nonnegative_number as nonnegative_number,
    one_of as one_of,
    positive_number as positive_number,
    probability as probability,
    row_number as row_number,
    some_of as some_of,
    truth_value as truth_value,
    whole_number as whole_number,
)
from ._words import shown as shown
