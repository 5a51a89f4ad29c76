"""Many random runs: seeded, in batches, on any executor, kept on a disk, with the same result."""

from driftlab._lazy import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
