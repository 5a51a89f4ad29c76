"""The book: one folder a chapter, and the machinery that all chapters are made with.

A chapter's folder is called like its notebook and holds, where there are some, its experiments
(named for what they compute), figures, slider panels, exercises and ledger of equations.
"""

from typing import Any

from driftlab._extra import require_extra
from driftlab._lazy import attach

# What all of it needs. SymPy is asked for by what uses it, since panels and figures do without.
require_extra(__name__, "anywidget", "ipywidgets", "matplotlib")

_offered, __dir__, __all__ = attach(__name__, __file__)


def __getattr__(name: str) -> Any:
    try:
        return _offered(name)
    except ModuleNotFoundError as error:
        if error.name != f"{__name__}.instructors":
            raise
        raise ModuleNotFoundError(
            f"{name} is for who teaches, and this is a student's copy of the book.",
            name=error.name,
        ) from None
