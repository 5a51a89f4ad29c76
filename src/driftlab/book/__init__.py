"""The book: one folder a chapter, and the machinery that all chapters are made with.

A chapter's folder is called like its notebook and holds, where there are some, its experiments
(named for what they compute), figures, slider panels, exercises and ledger of equations.
"""

from driftlab._lazy import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
