"""Squared errors of many runs, and what their mean can show."""

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.picture import BLACK, SERIES, Picture

from ..experiments import MOST_RUNS


def caption(table: DataTable) -> str:
    """Say what the mean over all runs is, and between which bounds it should lie."""
    low, high = table.bounds
    return (
        f"{table.runs} runs of a filter of {table.states} states. Left: squared normalised error "
        "of each run, by size, and the chi-square distribution of a consistent filter. Right: "
        f"the mean over the runs so far, and its 95 % bounds. Over all runs it is {table.mean:.2f}"
        f" and should lie between {low:.2f} and {high:.2f}. Defaults: errors 1.1 times as large as "
        "stated. Hardly a single run is conspicuous; the mean of some tens of runs is."
    )


class ManyRunsPicture(Picture):
    """Each run on the left, the mean over them on the right."""

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "ab", (9.6, 3.8), (0.07, 0.18, 0.985, 0.9), spaces=(0.16, 0.2), page_height=3.0,
            column_height=4.6,
        )  # fmt: skip
        each, mean = panels["a"], panels["b"]
        each.set(title="each run", xlabel="squared error over expected", ylabel="part of the runs")
        each.set(xlim=(0, 4), ylim=(0, 1))
        self.curve(each, "squared_error", "part_of_runs", **SERIES[0], label="these runs")
        self.curve(
            each, "of_a_consistent_filter", "part_expected", color=BLACK, linestyle="--",
            label="consistent filter",
        )  # fmt: skip
        each.legend(loc="lower right")
        mean.set(title="mean over the runs so far", xlabel="runs", ylabel="over expected")
        mean.set(xscale="log", xlim=(1, MOST_RUNS), ylim=(0.2, 2.4))
        mean.set_xticks([1, 10, 100], ["1", "10", "100"])
        self.curve(mean, "run", "mean_so_far", **SERIES[0], marker="o", markersize=2, label="mean")
        for end, label in (("low", None), ("high", "95 % bounds, consistent filter")):
            self.curve(
                mean, "runs_of_bounds", f"bound_{end}", color=BLACK, linestyle="--", label=label
            )
        mean.legend(loc="upper right")


draw = ManyRunsPicture.draw
