"""The book: one folder a chapter, and the machinery that all chapters are made with.

A chapter's folder is called like its notebook and holds, where there are some, its experiments
(named for what they compute), figures, slider panels, exercises and ledger of equations.
"""

from driftlab._extra import require_extra
from driftlab._lazy import attach

# What all of it needs. SymPy is asked for by what uses it, since panels and figures do without.
require_extra(__name__, "anywidget", "ipywidgets", "matplotlib")

__getattr__, __dir__, __all__ = attach(__name__, __file__)
