"""What `check` leaves in a saved notebook for programs, beside the words that a reader sees.

Whoever collects the notebooks of a class reads these records and runs nothing.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .exercise import Said, Verdict
from .progress import as_text
from .reading import panel_values

MIME = "application/vnd.driftlab.exercise+json"
"""The type under which an output carries its record."""

LONGEST = 500
"""Signs of an answer that has no other form than text, and entries of one that is numbers."""


def record_of(
    number: str, answer: Any, verdict: Verdict, attempt: int, said: Said
) -> dict[str, Any]:
    """Return the record of one answer, which JSON can hold."""
    return {
        "exercise": number,
        "right": verdict.right,
        "word": verdict.word,
        "says": verdict.reason,
        "attempt": attempt,
        "answer": None if verdict.right is None else _plain(answer),
        "because": said.because,
        "student": said.student,
    }


def _plain(answer: Any) -> Any:
    """An answer as numbers in lists, where it is numbers, else in a few words."""
    values = panel_values(answer)
    if values is not None:
        return {str(name): _plain(value) for name, value in values.items()}
    if isinstance(answer, (str, bool)):
        return answer[:LONGEST] if isinstance(answer, str) else answer
    try:
        numbers = np.asarray(answer, dtype=float)
    except Exception:  # whatever a student's own object raises
        return as_text(answer)[:LONGEST]
    if numbers.size > LONGEST or not np.isfinite(numbers).all():  # JSON has no NaN
        return as_text(answer)[:LONGEST]
    return numbers.tolist()
