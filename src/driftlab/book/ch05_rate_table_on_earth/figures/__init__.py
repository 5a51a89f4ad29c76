"""The published figures of chapter 05, with their captions."""

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from ..experiments import WAYS
from . import earth_under_table, real_table


def _budget_caption(data: DataTable) -> str:
    effects = data.shown("effect")
    largest = zip(WAYS, effects[:, :-1].argmax(axis=1), strict=True)
    return (
        "Turns on the Earth, with all errors of a real table. Lines: the budget to first order; "
        f"marks: simulations of {data.runs} calibrations with 95 % intervals. Largest sources: "
        f"{'; '.join(f'{data.source[row]} ({way})' for way, row in largest)}. With both "
        f"remedies {effects[-1, -1]:.1f} arc seconds remain at {data.shown('table_rate'):.3g} "
        "deg/s. On the right a row is a source; "
        f"a mark that is not there is below {real_table.LOWEST:g} arc seconds."
    )


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
        _budget_caption,
    ),
)
