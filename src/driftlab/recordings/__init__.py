"""Recordings of real inertial units: a typed record, readers, rests, and published sets.

Text in columns is read by `read_csv`, the forms of IMU-TK and PSINS by readers of their own. ULog,
rosbag and what vendors write have tools that turn them into CSV (ulog2csv, rostopic echo -p, a
vendor's program): use these first. Each reader refuses what physics speaks against: see `guards`.
"""

from driftlab._lazy import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
