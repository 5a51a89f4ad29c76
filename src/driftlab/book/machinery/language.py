"""In which language the book answers: English, or another from a catalogue of `gettext`.

The catalogues stand in the folder ``languages``, one folder a language. Whatever is judged, kept in
a notebook or counted for a class is English in all of them; words are translated where they are
said.
"""

from __future__ import annotations

import gettext
import os
import re
import struct
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Any, NamedTuple

DOMAIN = "driftlab"
"""What the catalogues are called."""

MODELS = "model_answers"
"""The catalogue of the book's own answers in words, which a student's copy has not."""

ENGLISH = "en"

VARIABLE = "DRIFTLAB_LANGUAGE"
"""The variable of the environment that says the language before somebody chooses one."""

FOLDER = Path(__file__).parents[1] / "languages"
"""Where they are: ``ru/LC_MESSAGES/driftlab.po`` and what is compiled of it, ``driftlab.mo``."""


class Spoken(NamedTuple):
    """A language and its catalogue."""

    code: str
    words: gettext.NullTranslations


class Filled(str):
    """A text in whose places values stand: it is said already, and no catalogue has it."""

    __slots__ = ()


_chosen: list[Spoken] = []
"""What the reader has chosen; empty before the first word."""

_here: ContextVar[Spoken | None] = ContextVar("driftlab_language", default=None)
"""What is spoken instead in a ``with`` block, and nowhere beside it: threads have their own."""


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
        return _spoken().code
    _chosen[:] = [_opened(code)]
    return code


@contextmanager
def speaking(code: str) -> Iterator[None]:
    """Speak another language in a ``with`` block, whatever is chosen meanwhile or elsewhere."""
    before = _here.set(_opened(code))
    try:
        yield
    finally:
        _here.reset(before)


def tr(text: str, *places: Any, **values: Any) -> str:
    """Return a text in the language that is spoken, with values in the places named for them.

    A text that the catalogue lacks stays English, and so does one that cannot take the values.
    """
    if not text or isinstance(text, Filled):
        return text
    return _filled(_spoken().words.gettext(text), text, *places, **values)


def tr_number(one: str, several: str, count: int, **values: Any) -> str:
    """Return the same of a text that counts, in the form that `count` has in the language."""
    english = one if count == 1 else several
    return _filled(_spoken().words.ngettext(one, several, count), english, count=count, **values)


def _filled(translated: str, english: str, *places: Any, **values: Any) -> str:
    if not (places or values):
        return translated
    try:
        return Filled(translated.format(*places, **values))
    except (KeyError, IndexError, ValueError, AttributeError):  # a translator's slip
        return Filled(english.format(*places, **values))


def _spoken() -> Spoken:
    here = _here.get()
    if here is not None:
        return here
    if not _chosen:
        _chosen[:] = [_of_environment()]
    return _chosen[0]


def _of_environment() -> Spoken:
    """The language that the environment says, as "ru" or "ru_RU.UTF-8"; else English."""
    said = os.environ.get(VARIABLE, "")
    code = re.split(r"[_.@-]", said.strip())[0].lower() or ENGLISH
    try:
        return _opened(code)
    except ValueError as error:
        reason = str(error).removeprefix("code: ")
        warnings.warn(f"{VARIABLE}={said}: {reason} The book speaks English.", stacklevel=2)
        return _opened(ENGLISH)


def _opened(code: str) -> Spoken:
    """A language with its catalogue."""
    there = languages()
    if code not in there:
        raise ValueError(f"code: expected one of {', '.join(there)}, got {code!r}.")
    if code == ENGLISH:
        return Spoken(code, gettext.NullTranslations())
    try:
        words = gettext.translation(DOMAIN, FOLDER, [code])
        words.add_fallback(gettext.translation(MODELS, FOLDER, [code], fallback=True))
        return Spoken(code, words)
    except (OSError, ValueError, struct.error) as error:
        raise ValueError(
            f"The catalogues in {FOLDER / code} cannot be read; "
            f"make them anew: python -m driftlab.book translation {code}."
        ) from error
