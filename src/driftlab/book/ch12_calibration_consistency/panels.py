"""The slider panel of chapter 12."""

from typing import ClassVar

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Explorer, Values
from driftlab.book.machinery.panel.results import Results

from .experiments import squared_errors
from .figures.many_runs import ManyRunsPicture


class ConsistencyExplorer(Explorer):
    """How many runs it takes to see that a filter states its errors too small."""

    title = "Is it consistent? Squared errors of many runs"
    picture_class = ManyRunsPicture
    controls = (
        Control("states", "components", 27, 1, 30, 1, group="filter"),
        Control("factor", "true σ over stated", 1.0, 0.5, 2.0, 0.05, group="filter"),
        Control("runs", "runs", 60, 1, 200, 1, group="test"),
        Control("draw", "draw", 12, 1, 20, 1, group="test"),
    )
    presets: ClassVar = {
        "A consistent filter": {},
        "Errors a tenth larger than stated": {"factor": 1.1},
        "The same, innovations": {"factor": 1.1, "states": 3},
        "One run": {"factor": 1.1, "runs": 1},
        "Too cautious": {"factor": 0.7},
    }
    look_for: ClassVar = {
        "A consistent filter": "Try other draws. How often does the mean leave its bounds?",
        "Errors a tenth larger than stated": "From how many runs on does the mean show it?",
        "The same, innovations": "Three components instead of 27. How many runs does it take now?",
        "One run": "One run only. How much would its σ have to be wrong to be seen?",
        "Too cautious": "The stated σ is too large. Which bound does the mean cross?",
    }

    def compute(self, values: Values) -> DataTable:
        return squared_errors(values["states"], values["runs"], values["factor"], values["draw"])

    def numbers(self, table: DataTable) -> Results:
        low, high = table.bounds
        return Results(
            ("mean squared error over expected", f"{table.mean:.3f}"),
            [
                ("should lie between, 95 %", f"{low:.3f} and {high:.3f}"),
                ("so the test says", table.verdict),
                ("mean to expect", f"{table.expected[0]:.3f}"),
            ],
        )

    def call(self, values: Values) -> str:
        return (
            "from driftlab.book.ch12_calibration_consistency.experiments import squared_errors\n"
            f"found = squared_errors({values['states']}, {values['runs']}, {values['factor']}, "
            f"{values['draw']})\n"
            "print(found.mean, found.bounds, found.verdict)"
        )


PANELS = (ConsistencyExplorer,)
