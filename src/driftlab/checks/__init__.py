"""Checks of arguments: shape, finiteness, kind, size, and the sentence that explains a refusal.

Every function here takes the argument's name, which begins the sentence of the `ValueError`: which
argument, what was expected, what came. Public functions check their arguments once, at the door;
what stands behind it checks nothing.
"""

from ._arrays import (
    LARGEST_NUMBER as LARGEST_NUMBER,
    SMALLEST_DIVISOR as SMALLEST_DIVISOR,
    ComplexArray as ComplexArray,
    FloatArray as FloatArray,
    common_leading_axes as common_leading_axes,
    finite_array as finite_array,
    finite_arrays as finite_arrays,
    positive_array as positive_array,
    whole_pairs as whole_pairs,
)
from ._deviations import usual_deviation as usual_deviation
from ._directions import (
    nonzero_vectors as nonzero_vectors,
    one_quaternion as one_quaternion,
    unit_quaternions as unit_quaternions,
)
from ._error_matrices import (
    LARGEST_SCALE as LARGEST_SCALE,
    error_matrix as error_matrix,
    linear_error_matrix as linear_error_matrix,
)
from ._magnitudes import (
    LARGEST_ACCELEROMETER_BIAS as LARGEST_ACCELEROMETER_BIAS,
    LARGEST_GYRO_BIAS as LARGEST_GYRO_BIAS,
    USUAL_ACCELEROMETER_BIAS as USUAL_ACCELEROMETER_BIAS,
    USUAL_GYRO_BIAS as USUAL_GYRO_BIAS,
    USUAL_TABLE as USUAL_TABLE,
    UnusualWarning as UnusualWarning,
    increments_of_velocity as increments_of_velocity,
    one_pull as one_pull,
    pull_of_gravity as pull_of_gravity,
    speed_of_body as speed_of_body,
    table_rate as table_rate,
    turned_angle as turned_angle,
    within as within,
)
from ._names import named_or_own as named_or_own, one_of as one_of, some_of as some_of
from ._numbers import (
    chosen_number as chosen_number,
    finite_number as finite_number,
    nonnegative_number as nonnegative_number,
    positive_number as positive_number,
    probability as probability,
    row_number as row_number,
    truth_value as truth_value,
    whole_number as whole_number,
)
from ._objects import (
    checked_function as checked_function,
    checked_generator as checked_generator,
    checked_instance as checked_instance,
    checked_path as checked_path,
    checked_text as checked_text,
    keep as keep,
)
from ._words import shown as shown
