"""How loops are compiled; only what `driftlab.core.compiled` loads needs Numba."""

from numba import njit

# Without `fastmath` nothing is reordered; divisions by zero give infinity, as in NumPy; other
# threads go on meanwhile; and what was compiled once is kept on the disk.
compiled = njit(cache=True, error_model="numpy", nogil=True)
inlined = njit(cache=True, error_model="numpy", nogil=True, inline="always")
