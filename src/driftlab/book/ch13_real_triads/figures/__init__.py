"""The published figures of chapter 13, with their captions."""

from driftlab.book.machinery.publish import FigureDefinition

FIGURES: tuple[FigureDefinition, ...] = ()
