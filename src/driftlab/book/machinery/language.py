"""In which language the book answers: English, or another from a catalogue of `gettext`.

The catalogues stand in the folder ``languages``, one folder a language. Whatever is judged, kept in
a notebook or counted for a class is English in all of them; words are translated where they are
said.
"""

from __future__ import annotations

import gettext
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

DOMAIN = "driftlab"
"""What the catalogues are called."""

ENGLISH = "en"

FOLDER = Path(__file__).parents[1] / "languages"
"""Where they are: ``ru/LC_MESSAGES/driftlab.po`` and what is compiled of it, ``driftlab.mo``."""

_spoken: dict[str, Any] = {}
"""The language under "code", its catalogue under "words"; empty before the first word."""


def languages() -> tuple[str, ...]:
    """Return the languages that there are, English first.

    Examples
    --------
    >>> languages()[0]
    'en'
    """
    found = sorted(path.parents[1].name for path in FOLDER.glob(f"*/LC_MESSAGES/{DOMAIN}.mo"))
    return (ENGLISH, *found)


def language(code: str | None = None) -> str:
    """Return in which language exercises, puzzles and panels speak; with a code, choose it.

    What is shown already stays as it is. Before anything is chosen, the variable
    ``DRIFTLAB_LANGUAGE`` of the environment says it, and without it English.

    Parameters
    ----------
    code : str, optional
        One of `languages`, as "ru".

    Raises
    ------
    ValueError
        If there is no such language.

    Examples
    --------
    >>> language("en")
    'en'
    """
    if code is None:
        if _spoken:
            return str(_spoken["code"])
        code = os.environ.get("DRIFTLAB_LANGUAGE") or ENGLISH
    there = languages()
    if code not in there:
        raise ValueError(f"code: expected one of {', '.join(there)}, got {code!r}.")
    words = gettext.translation(DOMAIN, FOLDER, [code], fallback=code == ENGLISH)
    _spoken.update(code=code, words=words)
    return code


@contextmanager
def speaking(code: str) -> Iterator[None]:
    """Speak another language in a ``with`` block."""
    before = language()
    language(code)
    try:
        yield
    finally:
        language(before)


def tr(text: str, **values: Any) -> str:
    """Return a text in the language that is spoken, with `values` in the places named for them.

    A text that the catalogue lacks stays English.
    """
    language()
    translated: str = _spoken["words"].gettext(text) if text else ""
    return translated.format(**values) if values else translated


def tr_number(one: str, several: str, count: int, **values: Any) -> str:
    """Return the same of a text that counts, in the form that `count` has in the language."""
    language()
    translated: str = _spoken["words"].ngettext(one, several, count)
    return translated.format(count=count, **values)
