"""What the saved notebooks of a class say of their exercises, for whoever marks them."""

from __future__ import annotations

import json
import re
from pathlib import Path


def saved_verdicts(path: str | Path) -> dict[str, bool | None]:
    """Return what `check` had said, exercise by exercise, when a notebook was saved.

    Parameters
    ----------
    path : path
        A notebook that was run and saved with its outputs.

    Returns
    -------
    dict
        By the exercise's number: True if right, False if not, None if not answered. Only the
        saved words are read; nothing is run, and nothing proves that nobody wrote them by hand.

    Raises
    ------
    ValueError
        If the file is not a notebook.
    """
    try:
        cells = json.loads(Path(path).read_text(encoding="utf-8"))["cells"]
        outputs = [output for cell in cells for output in cell.get("outputs", ())]
        texts = ["".join(output.get("text", "")) for output in outputs]
    except (KeyError, TypeError, AttributeError, UnicodeDecodeError, json.JSONDecodeError):
        raise ValueError(f"path: expected a notebook, got {str(path)!r}.") from None
    words = {"right": True, "not answered yet": None}
    return {
        number: words.get(said, False)
        for text in texts
        for number, said in re.findall(r"^Exercise ([\d.]+): ([^.]*)\.", text, re.MULTILINE)
    }
