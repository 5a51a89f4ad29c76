"""Calibration matrices of other programs, to and from `driftlab.imu.ImuErrors`.

Here ``measured = (I + K) true + bias``: the matrix makes errors, and the bias is the sensors'.
Most programs write the matrix that takes the errors out, its inverse. A bias is subtracted either
before their matrix, and is then ours, or behind it, and is then one of the body axes.

What a program knows beyond a matrix and a bias for each triad, such as gyros that feel acceleration
or accelerometers that sit apart, is refused if it is not zero, not dropped.
"""

from driftlab._lazy import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
