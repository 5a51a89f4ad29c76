"""Colours of code: comments, words of the language, strings and numbers have one.

Names, operators and brackets look like the text around them. With a tag around each, as Pygments
has them, they would be an eighth of what a chapter's page weighs.
"""

from __future__ import annotations

from typing import Any

from pygments.formatters import HtmlFormatter
from pygments.token import Name, Operator, Punctuation, String, Text
from sphinx.application import Sphinx
from sphinx.highlighting import PygmentsBridge

PLAIN = frozenset(
    {
        *(Name, Name.Namespace, Operator, Punctuation, Text, Text.Whitespace),
        String.Interpol,  # in an f-string what is computed, and its brackets
    }
)


class FewTags(HtmlFormatter[str]):  # type: ignore[misc]
    """Code as HTML, with tags around what has a colour of its own only."""

    def _get_css_class(self, ttype: Any) -> str:
        return "" if ttype in PLAIN else str(super()._get_css_class(ttype))


def use_few_tags(app: Sphinx) -> None:
    """Let Sphinx write code so; before it makes anything of its own."""
    PygmentsBridge.html_formatter = FewTags
