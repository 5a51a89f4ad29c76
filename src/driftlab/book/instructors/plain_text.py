"""Text that strangers wrote, made fit for a terminal, a table and a name to look up."""

from __future__ import annotations

import unicodedata

JOINERS = "\u200c\u200d"
"""Invisible, and a part of how Persian and the languages of India are spelt."""


def clean(text: object, longest: int = 500) -> str:
    """Return text in one line, without what a terminal or a file cannot take; "" for no text."""
    if not isinstance(text, str):
        return ""
    # Somewhat more than what is kept, since cleaning a whole novel would take its time.
    line = " ".join(text[: 4 * longest].split())
    kept = "".join(sign for sign in line if sign in JOINERS or unicodedata.category(sign)[0] != "C")
    kept = unicodedata.normalize("NFC", " ".join(kept.split()))
    return kept if len(kept) <= longest else kept[: longest - 1].rstrip() + "…"


def width(text: str) -> int:
    """How many columns of a terminal text takes: a Chinese sign two, a mark on a letter none."""
    return sum(map(_columns, text))


def padded(text: str, columns: int) -> str:
    """Return text that takes just so many columns of a terminal, cut short if it is longer."""
    if width(text) > columns:
        while width(text) > columns - 3:
            text = text[:-1]
        text += "..."
    return text + " " * (columns - width(text))


def _columns(sign: str) -> int:
    if unicodedata.category(sign) in ("Mn", "Me", "Cf"):
        return 0
    return 2 if unicodedata.east_asian_width(sign) in "WF" else 1


def squeezed(name: str) -> str:
    """Return what all spellings of a name have in common: letters and digits, without accents.

    The vowels of Indian scripts are marks on letters, but no accents.
    """
    apart = unicodedata.normalize("NFKD", name.casefold())
    return "".join(
        sign
        for sign in apart
        if sign.isalnum() or (unicodedata.category(sign)[0] == "M" and not _is_accent(sign))
    )


PLACEHOLDERS = (
    "name", "yourname", "myname", "fullname", "student", "studentname", "firstnamelastname",
    "nameofstudent", "todo", "xxx",
)  # fmt: skip
"""Squeezed, what stands where a name was to be written."""


def is_no_name(text: str) -> bool:
    """Whether text has neither letters nor digits, or only says that a name belongs here."""
    return squeezed(text) in ("", *PLACEHOLDERS)


def _is_accent(sign: str) -> bool:
    return unicodedata.combining(sign) not in (0, 7, 9)  # 7 and 9: nukta and virama


def spellings(name: str) -> set[str]:
    """Return the squeezed name, whichever of its words comes first: "Lovelace, Ada" is Ada's."""
    words = name.split()
    turned = {squeezed(" ".join(words[i:] + words[:i])) for i in range(len(words))}
    return turned - {""}
