"""What the saved notebooks of a class say of their exercises, for whoever marks them."""

from __future__ import annotations

import json
import re
from collections import Counter
from pathlib import Path
from typing import NamedTuple


class Summary(NamedTuple):
    """How a class stands.

    Attributes
    ----------
    notebooks : int
        How many were read.
    unreadable : list of Path
        Files that are no notebooks, whatever their names say.
    counts : dict of str to Counter
        By the exercise's number, in order: how many have it "right", "wrong" and "open".
    """

    notebooks: int
    unreadable: list[Path]
    counts: dict[str, Counter[str]]


def class_summary(folder: str | Path) -> Summary:
    """Count what the saved notebooks in a folder, and in the folders in it, say.

    Parameters
    ----------
    folder : path
        Copies that Jupyter keeps in ``.ipynb_checkpoints`` are left out.

    Raises
    ------
    ValueError
        If there is no such folder.
    """
    if not Path(folder).is_dir():
        raise ValueError(f"folder: expected a folder, got {str(folder)!r}.")
    words = {True: "right", False: "wrong", None: "open"}
    unreadable, counts = [], dict[str, Counter[str]]()
    paths = [
        path
        for path in sorted(Path(folder).rglob("*.ipynb"))
        if ".ipynb_checkpoints" not in path.parts
    ]
    for path in paths:
        try:
            verdicts = saved_verdicts(path)
        except ValueError:
            unreadable.append(path)
            continue
        for number, right in verdicts.items():
            counts.setdefault(number, Counter())[words[right]] += 1
    by_number = sorted(counts, key=lambda number: [int(part) for part in number.split(".")])
    return Summary(
        len(paths) - len(unreadable), unreadable, {number: counts[number] for number in by_number}
    )


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
        texts = [
            "".join(output.get("text", "") or output.get("data", {}).get("text/plain", ""))
            for output in outputs
        ]
    except (KeyError, TypeError, AttributeError, UnicodeDecodeError, json.JSONDecodeError):
        raise ValueError(f"path: expected a notebook, got {str(path)!r}.") from None
    words = {"right": True, "not answered yet": None}
    return {
        number: words.get(said, False)
        for text in texts
        for number, said in re.findall(r"^Exercise (\d+\.\d+): ([^.]*)\.", text, re.MULTILINE)
    }
