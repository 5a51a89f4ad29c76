"""The published figures of chapter 05, with their captions."""

from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from . import real_table

FIGURES = (
    FigureDefinition(
        "05-real-table",
        experiments.real_table,
        real_table.draw,
        lambda data: (
            "Turns on the Earth, with all errors of a real table. Lines: the budget to first "
            f"order; marks: simulations of {data.runs} calibrations with 95 % intervals. As "
            "published, in one sense the Earth covers everything else; both senses leave the scale "
            "factor, and a common offset solved for leaves the gyro bias. Both together leave "
            f"{data.shown('effect')[-1, -1]:.1f} arc seconds at "
            f"{data.shown('table_rate'):.3g} deg/s. Source by source, a row is a source; "
            f"a mark that is not there is below {real_table.LOWEST:g} arc seconds."
        ),
    ),
)
