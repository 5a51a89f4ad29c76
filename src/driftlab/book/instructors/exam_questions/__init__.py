"""The questions of the examination: each draws its numbers, and has them worked by the package."""

from .at_sea import at_rest, under_way
from .by_choice import calibration_step, cayley_vectors, coning_step, turned_by_hand
from .question import Answer, Part, Question, drawn_from, shown
from .turns import error_of_a_turn, roots, table_on_the_earth, worst_axis
from .whole_triad import three_parts

__all__ = ["BY_CHOICE", "COMPULSORY", "Answer", "Part", "Question", "drawn_from", "shown"]

COMPULSORY = (
    error_of_a_turn,
    roots,
    worst_axis,
    table_on_the_earth,
    three_parts,
    at_rest,
    under_way,
)
"""Chapters 01 to 04, 10, 13 and 14."""
BY_CHOICE = (cayley_vectors, coning_step, calibration_step, turned_by_hand)
"""Chapters 06, 07, 11 and 17."""
