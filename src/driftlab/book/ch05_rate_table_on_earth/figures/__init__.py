"""The published figures of chapter 05, with their captions."""

from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from . import earth_under_table, real_table

FIGURES = (
    FigureDefinition(
        "05-earth-under-table",
        experiments.earth_under_table,
        earth_under_table.draw,
        lambda data: (
            "The Earth under a rate table. On the left a perfect triad, turned once "
            "counter-clockwise: its seeming sigma over the latitude, by the formula (lines) and by "
            "simulated turns (marks). On the right one turn of a misaligned triad at latitude "
            f"{data.shown('place'):.3g}°, at the first of the rates. It ends at "
            f"{data.shown('there'):.1f} or {data.shown('back'):.1f} arc seconds, depending on the "
            f"direction; the mean of both ends at the true {data.shown('sigma'):.3g}."
        ),
    ),
    FigureDefinition(
        "05-real-table",
        experiments.real_table,
        real_table.draw,
        lambda data: (
            "Turns on the Earth, with all errors of a real table. Lines: the budget to first "
            f"order; marks: simulations of {data.runs} calibrations with 95 % intervals. With "
            "the default sizes, in one direction the Earth covers everything else; both directions "
            "leave the scale factor, and a common offset solved for leaves the gyro bias. Both "
            "remedies leave "
            f"{data.shown('effect')[-1, -1]:.1f} arc seconds at "
            f"{data.shown('table_rate'):.3g} deg/s. Source by source, a row is a source; "
            f"a mark that is not there is below {real_table.LOWEST:g} arc seconds."
        ),
    ),
)
