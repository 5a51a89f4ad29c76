"""What somebody might type or hand in to have it run by another, or shown as a part of a page."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from html.parser import HTMLParser

MARK = "hostile_c0de"
CODE = f"__import__('os').system('touch {MARK}')"
MARKUP = f"<img src=x onerror={MARK}()><script>{MARK}()</script>"
TEXTS = (CODE, MARKUP, f"`'\"><script>{MARK}()</script>", f"!touch {MARK}", f"=cmd|'{MARK}'!A1")
"""As text, as markup within text, as markup that breaks out of an attribute, for IPython, for a
spreadsheet."""
RUNS = {
    *("os.system", "os.exec", "os.posix_spawn", "os.fork"),
    *("subprocess.Popen", "pickle.find_class"),
}
_seen: list[str] | None = None


class Hostile:
    """An object that calls itself something else."""

    def __repr__(self) -> str:
        return MARKUP

    __str__ = _repr_html_ = __repr__


class Elements(HTMLParser):
    """The elements of a page, and what could make them do something."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.names: set[str] = set()
        self.acts: list[tuple[str, str | None]] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        self.names.add(tag)
        for name, value in attributes:
            leads_away = name in ("href", "src", "action") and not (value or "").startswith("#")
            if name.startswith("on") or leads_away or MARK in (value or ""):
                self.acts.append((name, value))


@contextmanager
def all_that_runs() -> Iterator[list[str]]:
    """List what is compiled of hostile text, and programs that are started, in a ``with`` block."""
    global _seen
    _watch()
    _seen = seen = []
    try:
        yield seen
    finally:
        _seen = None


@cache
def _watch() -> None:
    sys.addaudithook(_note)  # for ever, so once


def _note(event: str, arguments: tuple) -> None:
    if _seen is None:
        return
    about = arguments[0] if arguments else None
    if event == "exec":
        about = [about.co_names, about.co_consts]
    if event in RUNS or (event in ("compile", "exec") and MARK in str(about)):
        _seen.append(f"{event} {about}")
