"""Chapters in another language: a folder a language beside the English ones, cell by cell.

The cells keep their ids and their code. Each cell of text says in its metadata which English text
it is a translation of; one cell more, the second, chooses the language.
"""

from __future__ import annotations

import json
from collections.abc import Collection
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple

HOME = Path(__file__).parents[3] / "notebooks"
"""Where the English ones are."""

MARK = "translation_of"
"""Under which key of its metadata a translated cell keeps what it is a translation of."""

Notebook = dict[str, Any]


class Standing(NamedTuple):
    """How a translated notebook stands beside the English one.

    Attributes
    ----------
    open : tuple of str
        Cells that nobody has translated yet.
    behind : tuple of str
        Cells whose English text is another by now.
    unlike : tuple of str
        Cells that are there in one of the two only, or have other code.
    """

    open: tuple[str, ...]
    behind: tuple[str, ...]
    unlike: tuple[str, ...]

    def __str__(self) -> str:
        words = {"not translated": self.open, "behind": self.behind, "unlike": self.unlike}
        told = [f"{name}: {', '.join(cells)}" for name, cells in words.items() if cells]
        return "; ".join(told) or "up to date"


def standings(language: str, home: Path = HOME) -> dict[str, Standing]:
    """Return how each notebook of a language stands, by its name.

    Parameters
    ----------
    language : str
        Its code, and the name of the folder.
    home : Path, optional
        Where the English ones are.
    """
    return {
        f"{language}/{path.name}": _standing(language, _read(home / path.name), _read(path))
        for path in sorted((home / language).glob("*.ipynb"))
    }


def begin(language: str, name: str, home: Path = HOME) -> Path:
    """Copy an English notebook into the folder of a language, to be translated.

    Raises
    ------
    ValueError
        If there is no such notebook, or it is begun already.
    """
    found = [path for path in home.glob("*.ipynb") if path.name.startswith(name)]
    if not name or len(found) != 1:
        raise ValueError(f'begin: expected how one notebook begins, as "02", got {name!r}.')
    target = home / language / found[0].name
    if target.exists():
        raise ValueError(f"begin: expected a notebook that is not begun, {target} is there.")
    notebook = _read(found[0])
    choice = ["from driftlab.book import language\n", "\n", f'language("{language}");']
    chosen = {
        **{"cell_type": "code", "execution_count": None, "id": f"{language}-language"},
        **{"metadata": {"slideshow": {"slide_type": "skip"}}, "outputs": [], "source": choice},
    }
    notebook["cells"].insert(1, chosen)
    notebook["metadata"].setdefault("driftlab", {})["language"] = language
    target.parent.mkdir(exist_ok=True)
    _write(target, notebook)
    return target


def done(language: str, cells: Collection[str], home: Path = HOME) -> list[str]:
    """Note of some cells that they are translations of the English text as it is now.

    Parameters
    ----------
    language : str
    cells : collection of str
        Their ids.

    Returns
    -------
    list of str
        Those that were found.
    """
    noted = []
    for path in sorted((home / language).glob("*.ipynb")):
        notebook, english = _read(path), _texts(_read(home / path.name))
        for cell in notebook["cells"]:
            if cell["id"] in cells and cell["id"] in english and cell["cell_type"] == "markdown":
                cell["metadata"][MARK] = digest(english[cell["id"]])
                noted.append(cell["id"])
        _write(path, notebook)
    return noted


def digest(text: str) -> str:
    """Return what stands for an English text in the metadata of its translation."""
    return sha256(text.encode()).hexdigest()[:12]


def _standing(language: str, english: Notebook, own: Notebook) -> Standing:
    texts, mine = _texts(english), _texts(own)
    marks = {cell["id"]: cell["metadata"].get(MARK) for cell in own["cells"]}
    words = {cell["id"] for cell in english["cells"] if cell["cell_type"] == "markdown"}
    shared = [name for name in texts if name in mine]
    alone = sorted((texts.keys() ^ mine.keys()) - {f"{language}-language"})
    code = [name for name in shared if name not in words and texts[name] != mine[name]]
    return Standing(
        tuple(name for name in shared if name in words and not marks[name]),
        tuple(n for n in shared if n in words and marks[n] and marks[n] != digest(texts[n])),
        (*alone, *code),
    )


def _texts(notebook: Notebook) -> dict[str, str]:
    return {cell["id"]: "".join(cell["source"]) for cell in notebook["cells"]}


def _read(path: Path) -> Notebook:
    notebook: Notebook = json.loads(path.read_text("utf-8"))
    return notebook


def _write(path: Path, notebook: Notebook) -> None:
    text = json.dumps(notebook, indent=1, ensure_ascii=False, sort_keys=True)
    path.write_text(f"{text}\n", "utf-8", newline="\n")
