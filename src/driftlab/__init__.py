"""Drift Lab: how a slightly bent gyro triad becomes a wrong attitude, and what to do about it.

Conventions, fixed here once for the whole package:

* A quaternion is Hamilton's, **scalar last** ``[x, y, z, w]``, and maps body components to
  reference components. It is the order of Larin (1987) and of `scipy.spatial.transform.Rotation`.
* SI units and radians, always. Degrees per hour, arc seconds and ppm live on sliders, axis labels
  and in tables only.
* Arrays broadcast over their leading axes; the last axis (or the last two) is the object itself.
* ``rate`` is the true angular rate in body axes, ``measured_rate`` what the gyros say.
  In Parts I and II the *misalignment* ``M`` holds all errors of the gyro triad: ``measured_rate =
  (E + M) rate``. From Part III on such matrices are ``gyro_error`` and ``accelerometer_error``,
  and misalignment is their skew part only, as in most of the field.
* Local axes are East, North, Up. In Part IV they are North, Up, East, as in its paper, with body
  axes forward, up, right and headings from North to West; see `horizon_axes`.
* Bad input raises `ValueError` with one sentence: which argument, what was expected, what came.

Modules, in the order in which they build on each other: `quaternion`, `kinematics`, `drift`,
`step_formulas`, `turn_calibration`, `larin_table`, `cayley`, `algorithm_table`,
`attitude_algorithms`, `word_length`, `motions`, `installation`, `earth`, `strapdown`, `turntable`,
`sensors`, `error_model`, `error_growth`, `system_calibration`, `observability`,
`calibration_trial`, `navigation_in_place`, `monte_carlo`, `horizon_axes`, `voyage`,
`compass_under_way`, `gyrocompass`, `gyrocompass_operation`, `compass_voyage`, `gyro_noise`,
`compass_trials` (NumPy and SciPy only), `symbolic` (SymPy), `figures` (Matplotlib), `explorers`
(ipywidgets). Importing the package itself loads none of them.
"""

__version__ = "0.1.0"
