"""How long a panel's picture takes after a slider has moved, without a browser."""

from collections.abc import Iterator
from time import perf_counter

import numpy as np

from driftlab.book.panels import EXPLORERS

from .measuring import Contender, Result, Row, Target, Timing

MOVES = 5
"""Places of each slider."""
_MOST = 0.05


def results() -> Iterator[Result]:
    for explorer_class in EXPLORERS:
        explorer = explorer_class()
        times = []
        for control in explorer.controls:
            listed = control.options or control.examples
            for place in listed or np.linspace(control.low, control.high, MOVES):
                value = {control.name: place if listed else type(control.start)(place)}
                begin = perf_counter()
                explorer.set(**value)
                times.append(perf_counter() - begin)
        row = Row(
            "redraw",
            explorer_class.__name__,
            Contender("driftlab", explorer_class),
            targets=[Target(_MOST)],
        )
        yield Result(row, Timing("driftlab", np.array(times)))
