"""Whether the longest loops are compiled: an extra, for the same numbers sooner.

Attitude and navigation from increments go through them one after the other, and a filter steps
through matrices of thirty rows. NumPy needs long rows and large matrices to be quick. Compiled by
Numba, the same formulas in the same order take a fraction of the time; results differ by rounding
alone. The first call of each compiles it, for seconds; what was compiled is kept on the disk.

``pip install driftlab[compiled]`` brings Numba. It is not used before it is asked for: by
`use_compiled`, or by the environment variable ``DRIFTLAB_COMPILED=1`` of a program's start.
"""

from __future__ import annotations

from .checks import truth_value
from .core import loops

__all__ = ["is_compiled", "use_compiled"]


def use_compiled(on: bool = True) -> None:
    """Compile the longest loops from now on, or go back to NumPy.

    It holds for all threads, and for processes that are started later. What follows it: `integrate`
    with the algorithms of `CONING_ALGORITHMS` and one's own `Algorithm`, `navigate`, cumulative
    products of quaternions and the steps of `calibrate`'s filter, one or many at a time.

    Parameters
    ----------
    on : bool
        Whether to compile.

    Raises
    ------
    ModuleNotFoundError
        If `on`, and Numba is not installed.

    See Also
    --------
    is_compiled : Whether they are.
    driftlab.attitude.integrate : Attitude from increments.
    driftlab.strapdown.navigate : Velocity and position as well.
    driftlab.monte_carlo.run_batches : Monte Carlo runs on all processors.

    Notes
    -----
    A blocked product of NumPy's rounds otherwise than one that goes step by step, so attitudes
    differ by some 1e-16 times the square root of the number of steps. Reports of last digits should
    say which was used.

    Examples
    --------
    Back to NumPy, which needs nothing installed:

    >>> use_compiled(False)
    """
    truth_value(on, "on")
    if on and not loops.available():
        raise ModuleNotFoundError(
            "use_compiled needs numba, not installed here: pip install driftlab[compiled] "
            "brings it.",
            name="numba",
        )
    loops.switch(on)


def is_compiled() -> bool:
    """Whether the longest loops are compiled now.

    Returns
    -------
    bool
        True after `use_compiled`, or where ``DRIFTLAB_COMPILED=1`` was set when this was first
        asked or needed, and Numba is installed. Where it is set in vain, a warning says why.

    See Also
    --------
    use_compiled : The switch.

    Examples
    --------
    >>> use_compiled(False)
    >>> is_compiled()
    False
    """
    return loops.on
