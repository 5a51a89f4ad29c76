"""The published figures, each computed once for all tests of a process.

What belongs to one figure is one group of tests, so that only one of several processes computes it,
and is left to the tests that are not quick: all of them together take minutes.
"""

from functools import cache
from typing import Any

import pytest

from driftlab.book import figures
from driftlab.book.machinery.figure.csv_table import read_table
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.publish import PublishedFigure
from support import ROOT

NAMES = tuple(figures.figure_definitions())

# Figures and panels that are of the same run.
SHARED = {
    "11-calibration-errors": "CalibrationRunExplorer",
    "12-in-place": "CalibrationRunExplorer",
    "16-capstone": "CapstoneExplorer",
}


@cache
def computed(name: str) -> PublishedFigure:
    """A published figure, as it is computed and drawn today."""
    return figures.figure(name)


@cache
def kept_table(name: str) -> DataTable:
    """The table of a figure as its CSV has it, whether the recording is here or not."""
    return DataTable.of_csv(*read_table(ROOT / "figures" / f"{name}.csv"))


def of_figure(name: str) -> Any:
    """Name of a figure as a test's parameter, which puts the test into the figure's group."""
    group = SHARED.get(name, f"figure-{name}")
    return pytest.param(name, id=name, marks=[pytest.mark.xdist_group(group), pytest.mark.slow])


def published(*names: str) -> pytest.MarkDecorator:
    """Run a test on each of these figures: its argument `figure` is the `PublishedFigure`."""
    cases = [of_figure(name) for name in names]
    return pytest.mark.parametrize("figure", cases, indirect=True)


def percent(interval: tuple[float, float]) -> str:
    """An interval of parts, as the ledger writes it."""
    low, high = interval
    return f"{100 * low:.0f} to {100 * high:.0f} %"
