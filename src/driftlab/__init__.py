"""Drift Lab: how a slightly bent gyro triad becomes a wrong attitude, and what to do about it.

Where to begin:

* The notebook ``notebooks/i_want_to.ipynb`` has tasks of every day, from the drift of a triad to
  the heading from a log, each in ten lines that run alone.
* ``python -m driftlab find covariance`` shows which tasks and which modules speak of a word;
  ``python -m driftlab`` shows all, the commands for one's own log first.
* ``import driftlab as dl`` loads nothing before it is asked for: ``dl.align``, or
  ``dl.calibration.covariance_analysis``. ``help(dl.align)`` says shapes, units and the equation.

Conventions, fixed here once for the whole package:

* A quaternion is Hamilton's, **scalar last** ``[x, y, z, w]``, and maps body components to
  reference components. It is the order of Larin (1987) and of `scipy.spatial.transform.Rotation`.
  Wherever a quaternion is taken, a `Rotation`, one or a stack of any axes, is taken as well; what
  comes back is an array, and ``Rotation.from_quat(result)`` makes a `Rotation` of it.
* SI units and radians, always. Degrees per hour, arc seconds and ppm live on sliders, axis labels
  and in tables only.
* Arrays broadcast over their leading axes; the last axis (or the last two) is the object itself.
  Whatever NumPy makes an array of goes in: lists, float32, read-only arrays, a DataFrame with its
  columns as they stand, arrays of other libraries (those of a GPU must be fetched first). Arrays of
  NumPy in float64 come out.
* ``rate`` is the true angular rate in body axes, ``measured_rate`` what the gyros say.
  An *error matrix* ``M`` holds all errors of a gyro triad but its bias: ``measured_rate = (I + M)
  rate``. A unit has two, ``gyro_error_matrix`` and ``accelerometer_error_matrix``; *misalignment*
  is the skew part of such a matrix, the triad turned as a whole.
* A bias says its axes where there is a choice: ``gyro_bias_body``, ``gyro_bias_nue`` (North, Up,
  East).
* Local axes are East, North, Up. In Part IV they are North, Up, East, as in its paper, with body
  axes forward, up, right and headings from North to West; see `frames`. `axes` converts from and
  to other axes, `conventions` other signs and orders.
* Bad input raises `ValueError` with one sentence: which argument, what was expected, what came. A
  size that is possible but seldom meant, as degrees for radians, is a `checks.UnusualWarning`.
* What draws noise takes an `rng`: a Generator of NumPy, or a seed, of which
  `numpy.random.default_rng` makes one. The same seed gives the same noise with each call.
* Where there is a table of objects with names, as `ERROR_MODELS` or `SCHEMES`, an argument is one
  of the names or an object of one's own.
* What is annotated ``FloatArray`` is an array that the package has made: it is not checked again.

Ground floor: `checks`, `vectors`, `quaternion`, `earth`, `axes`, `conventions`, `frames`, `triad`,
`body_frames`, `imu`, `increments`, `strapdown`, `allan`, `noise_terms`,
`monte_carlo`.
On it stand the subjects: `motion`, `drift`, `attitude`, `recordings`,
`calibration`, `gyrocompass`. All of these need NumPy and SciPy only, and so does `commands`, but
for its bar and its plots. `symbolic` (SymPy) and `book` (Matplotlib, ipywidgets) come with
``pip install driftlab[book]``.
"""

from driftlab._lazy import attach

__version__ = "0.2.0"

__getattr__, __dir__, __all__ = attach(__name__, __file__)
