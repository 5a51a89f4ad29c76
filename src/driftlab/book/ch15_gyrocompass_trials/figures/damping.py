"""A voyage with four horizons: undamped, and damped with a log or not."""

from driftlab.book.ch14_gyrocompass_under_way.figures.horizons import draw_horizons, reach
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table


def damping_reach(table: DataTable) -> tuple[float, float]:
    """Reach of all horizons but the damped one without a log."""
    undamped, _, *by_log = table.runs.values()
    return reach([undamped, *by_log], (0.4, 0.5))


@from_table
def draw(drawing: Drawing) -> None:
    """Draw all horizons; the damped one without a log may leave the panels."""
    draw_horizons(drawing, *damping_reach(drawing.table))
