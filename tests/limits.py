"""A limit for each test: what waits without an end fails, and the other tests go on.

Not pytest-timeout. It ends in one of two ways: Hypothesis takes its exception for a failure and
tries the same example again, with no clock; and where the process is ended, pytest-xdist hands
the same test to the next one, until no process is left. Its clock stops at a failure, too, before
anything is taken down.
"""

import faulthandler
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from _pytest.outcomes import OutcomeException

LIMIT = 300
"""Seconds for a test, and for what is set up before it and what is taken down after it."""

LIMIT_OF_LONG = 1200
"""The same for a test whose mark says that it takes long."""

LONG = ("browser", "kernel", "long", "setup", "slow")


class TooLong(OutcomeException):
    """No Exception, which a test may expect; pytest keeps it for all tests of a fixture."""


def limit_of(item: pytest.Item) -> int:
    """Return how long a test may take."""
    return LIMIT_OF_LONG if any(map(item.get_closest_marker, LONG)) else LIMIT


@contextmanager
def at_most(seconds: int, printed: int | None = None) -> Iterator[None]:
    """Raise `TooLong` in the ``with`` block when it takes longer.

    What a signal cannot reach, and on Windows everything, is ended a minute later with the whole
    process; where it stood is then printed.
    """

    def stop(*_: object) -> None:
        raise TooLong(f"over {seconds} seconds")

    by_signal = hasattr(signal, "SIGALRM")
    if by_signal:
        signal.signal(signal.SIGALRM, stop)
        signal.setitimer(signal.ITIMER_REAL, seconds, 10)  # once more for what ends in waiting
    faulthandler.dump_traceback_later(seconds + 60, exit=True, file=printed or sys.__stderr__)
    try:
        yield
    finally:
        faulthandler.cancel_dump_traceback_later()
        if by_signal:
            signal.setitimer(signal.ITIMER_REAL, 0)
