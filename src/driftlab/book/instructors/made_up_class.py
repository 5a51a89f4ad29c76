"""A class of thirty that does not exist, as Moodle would give it, half of it awkward.

The names are made up; what the notebooks say is what `check` says of right and wrong answers.
"""

from __future__ import annotations

import ast
import io
import json
import random
import zipfile
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np

from driftlab.book.exercises import judged
from driftlab.book.machinery.exercise.exercise import Said
from driftlab.book.machinery.exercise.progress import Progress

RIGHT = {
    "1.1": "[180, 0, 0]",
    "1.2": "2.67",
    "1.3": '"bce"',
    "1.4": "[0.0037533, -0.0000140, 0.0025795, 0.9999896]",
    "1.5": "...",
    "3.1": "[1, 1, -1, 0, 0, 0.5]",
    "3.2": "129.6",
    "3.3": '"ad"',
    "3.4": "[15.2998, -15.2472, 0.0119]",
    "3.5": "lambda M: 2 * np.pi * np.linalg.eigvalsh((M + M.T) / 2)[-1]",
    "3.6": '"adf"',
}
"""What a student types who is right; the last of chapter 01 nobody got to."""
WRONG = {
    "1.1": ["[180, 360, 720]", "[90, 180, 360]", "[180, 360, 0]"],
    "1.2": ["0.3", "-2.67", "0.0465"],
    "1.3": ['"abce"', '"be"'],
    "1.4": ["[0.9999896, 0.0037533, -0.0000140, 0.0025795]"],
    "1.5": ["..."],
    "3.1": ["[1, 1, -1, 0, 0, 1]", "[1, -1, -1, 0, 0, 0.5]", "[1, 1, 1, 0, 1, 0.7071]"],
    "3.2": ["86.4", "86.4", "2.16", "..."],
    "3.3": ['"acd"', '"abd"', '"d"'],
    "3.4": ["[15.273, -15.273, 0]", "[15.2318, -15.3149, 0.0797]", '"drift"'],
    "3.5": ["lambda M: 2 * np.pi * np.linalg.eigvalsh(M)[-1]", "0.003", "..."],
    "3.6": ['"abdf"', '"ad"'],
}
"""What one types who is not; what stands first, or twice, many do."""
FUNCTIONS: dict[str, Callable[[Any], Any]] = {
    RIGHT["3.5"]: lambda M: 2 * np.pi * np.linalg.eigvalsh((M + M.T) / 2)[-1],
    WRONG["3.5"][0]: lambda M: 2 * np.pi * np.linalg.eigvalsh(M)[-1],
}
WORDS = {
    "1.3": ["What happens later stands on the right.", "I turned my book and looked."],
    "3.3": ["The axis enters twice.", "Six numbers, and six axes are enough.", "Σ is symmetric."],
    "3.6": ["Only the path counts.", "What is taken back leaves nothing."],
}
PLAIN = (
    "Ada Lovelace", "Jean-Luc Moreau", "Ngozi Adéyẹmí", "王小明", "Ольга Соколова", "محمد العلي",
    "Πηνελόπη Δέλτα", "山田 花子", "김민준", "Nguyễn Thị Hương", "דנה לוי", "प्रिया शर्मा",
    "Zoë van 't Hoff", "Łukasz Ó Dálaigh",
)  # fmt: skip
"""Who did all as one should."""


def write_made_up_class(folder: str | Path, *, seed: int = 30) -> Path:
    """Write what thirty students handed in, and the list of their names beside it.

    The folder gets ``class``, which is returned, and ``roster.csv``.
    """
    place = Path(folder) / "class"
    place.mkdir(parents=True)
    rng = random.Random(seed)
    names = []
    for number, name in enumerate(PLAIN):
        chapters = ("01", "03") if number % 3 == 0 else ("03",)
        _hand_in(
            place, 1200 + number, name, {f"{c}.ipynb": _saved(_chapter(c, rng)) for c in chapters}
        )
        names.append(name)
    for number, (name, files) in enumerate(_awkward(rng).items()):
        _hand_in(place, 1300 + number, name, files)
        names.append(name)
    hers = [_title("<script>alert(1)</script> & <b>Eve</b>"), *_chapter("03", rng, plain=True)]
    (place / "drift-lab-answers-script-alert-1-script-b-eve-b.ipynb").write_bytes(_saved(hers))
    names = [name for name in names if name != "Not On The List"] + ["Nobody Knows"]
    lines = [f"{name},{20260001 + number}" for number, name in enumerate(names)]
    roster = "\n".join(["name,id number", *lines, ""])
    (Path(folder) / "roster.csv").write_text(roster, encoding="utf-8-sig")
    return place


def _awkward(rng: random.Random) -> dict[str, dict[str, bytes]]:
    """Students by name, with their files; no file is an empty folder."""
    name = "03_systematic_drift.ipynb"
    cells = [_chapter("03", rng) for _ in range(12)]
    before, after = _chapter("03", rng, skill=0.1), _chapter("03", rng, skill=0.9)
    after.insert(0, {"cell_type": "markdown", "metadata": {}, "source": "Once more."})
    stuck = [*cells[1][:2], _failed("3.3"), *cells[1][3:]]
    twice = [_cell("3.1", WRONG["3.1"][0], Progress()), *_chapter("03", rng, skill=1.0)]
    tag = "<img src=x onerror=alert(1)> =1+1"
    his = [*cells[8], _cell("3.6", RIGHT["3.6"], Progress(), because=tag)]
    export = [_title("Wanda Webb"), *_chapter("03", rng, plain=True)]
    return {
        "Una Unrun": {name: _saved([_unrun(cell) for cell in cells[0]])},
        "Ernst Error": {name: _saved(stuck)},
        "Bo Mark": {name: b"\xef\xbb\xbf" + _saved(cells[2])},
        "Wide Letters": {name: _saved(cells[3]).decode().encode("utf-16")},
        "Zip Zimmer": {
            f"{name}.zip": _zipped({name: _saved(cells[4]), f"__MACOSX/._{name}": b"x"})
        },
        "Rae Submitted": {name: _saved(before), name.replace(".", " (1).", 1): _saved(after)},
        "Empty Folder": {},
        "Wanda Webb": {"drift-lab-answers-wanda-webb.ipynb": _saved(export)},
        "Doc Word": {name: b"PK\5\6 this was a text of an office program"},
        "Paper Only": {"answers.pdf": b"%PDF-1.7"},
        "=2+5 Formula": {name: _saved(cells[5])},
        "Old Format": {name: _in_format_3(cells[6])},
        "Tom Twice": {name: _saved(twice)},
        "Tag Typer": {name: _saved(his)},
        "Not On The List": {name: _saved(cells[7]), "broken.zip": b"PK\3\4 cut short"},
    }


def _chapter(
    chapter: str, rng: random.Random, *, skill: float | None = None, plain: bool = False
) -> list[dict[str, Any]]:
    """The answer cells of a chapter; a skilled student is right more often."""
    skill = rng.uniform(0.3, 0.95) if skill is None else skill
    progress = Progress()
    cells = []
    for number in (each for each in RIGHT if each.split(".")[0].zfill(2) == chapter):
        source = RIGHT[number] if rng.random() < skill else rng.choice(WRONG[number])
        because = rng.choice(WORDS[number]) if number in WORDS else ""
        cells.append(_cell(number, source, progress, because=because, plain=plain))
    return cells


def _cell(
    number: str, source: str, progress: Progress, *, because: str = "", plain: bool = False
) -> dict[str, Any]:
    """A cell as Jupyter saves it, or as the web pages export it: as text alone."""
    card = judged(number, _value(source), progress, Said(because))
    shown = {"text/plain": repr(card), "text/html": card._repr_html_()} | card._repr_mimebundle_()
    output = {"output_type": "display_data", "metadata": {}, "data": shown}
    if plain:
        output = {"output_type": "stream", "name": "stdout", "text": f"{card!r}\n"}
    return _code(f'answer = {source}\ncheck("{number}", answer)', output)


def _code(source: str, output: dict[str, Any]) -> dict[str, Any]:
    return {
        "cell_type": "code",
        "metadata": {},
        "execution_count": 1,
        "source": source,
        "outputs": [output],
    }


def _value(source: str) -> Any:
    """What the source of an answer is; it is one of ours, above."""
    return FUNCTIONS[source] if source in FUNCTIONS else ast.literal_eval(source)


def _failed(number: str) -> dict[str, Any]:
    error = {
        "output_type": "error",
        "ename": "NameError",
        "evalue": "name 'ad' is not defined",
        "traceback": [],
    }
    return _code(f'answer = ad\ncheck("{number}", answer)', error)


def _unrun(cell: dict[str, Any]) -> dict[str, Any]:
    return {**cell, "outputs": [], "execution_count": None}


def _title(name: str) -> dict[str, Any]:
    return {"cell_type": "markdown", "metadata": {}, "source": f"# Answers of {name}\n\nExported."}


def _saved(cells: list[dict[str, Any]]) -> bytes:
    book = {"nbformat": 4, "nbformat_minor": 4, "metadata": {}, "cells": cells}
    return json.dumps(book, ensure_ascii=False, indent=1).encode()


def _in_format_3(cells: Iterable[dict[str, Any]]) -> bytes:
    """The same as IPython saved it before there was Jupyter."""
    old = [
        {
            "cell_type": "code",
            "input": cell["source"].splitlines(keepends=True),
            "outputs": [{"output_type": "pyout", "text": cell["outputs"][0]["data"]["text/plain"]}],
        }
        for cell in cells
    ]
    return json.dumps({"nbformat": 3, "metadata": {}, "worksheets": [{"cells": old}]}).encode()


def _zipped(files: dict[str, bytes]) -> bytes:
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as opened:
        for name, content in files.items():
            opened.writestr(name, content)
    return archive.getvalue()


def _hand_in(place: Path, number: int, name: str, files: dict[str, bytes]) -> None:
    folder = place / f"{name}_{number}_assignsubmission_file_"
    folder.mkdir()
    for file, content in files.items():
        (folder / file).write_bytes(content)
