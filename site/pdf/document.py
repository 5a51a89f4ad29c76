"""From the Markdown of all documents to one text of Typst, by pandoc's tree in between.

The tree is pandoc's JSON: a block or a piece of a line is {"t": kind, "c": content}.
"""

from __future__ import annotations

import json
import posixpath
import re
import subprocess
from collections.abc import Callable
from typing import Any
from urllib.parse import unquote

import pypandoc

from pdf.contents import is_listed, label
from pdf.formulas import readable
from pdf.tables import fitted
from unfinished import Unfinished

READER = "commonmark+pipe_tables+raw_attribute+smart+tex_math_dollars"
"""What JupyterLab reads, and Typst between fences."""
HTML = "html"


class Document:
    """A document of the book, as pandoc's tree."""

    def __init__(self, name: str, text: str) -> None:
        self.name = name  # "solutions/03_systematic_drift.ipynb"
        self.label = label(name)
        self.tree = json.loads(pandoc(text, READER, "json"))
        self.anchors: dict[str, str] = {}
        _walk(self.tree["blocks"], self._name_heading)

    @property
    def title(self) -> str:
        """The first heading, without markup."""
        (first, *_) = (block for block in self.tree["blocks"] if block["t"] == "Header")
        return _words(first["c"][2])

    def _name_heading(self, node: dict[str, Any]) -> None:
        """Give a heading its place in the book, and remember it by Jupyter's name for it."""
        if node["t"] != "Header":
            return None
        level, attributes, inlines = node["c"]
        words = _words(inlines)
        slug = re.sub(r"[^\w]+", "-", words.lower()).strip("-") or "section"
        own = self.label if level == 1 else f"{self.label}.{slug}"
        while own in self.anchors.values():
            own += "-"
        self.anchors[words.replace(" ", "-")] = own
        self.anchors.setdefault("", own)
        classes = [] if is_listed(self.name, level, words) else ["unlisted"]
        node["c"] = [level + 1, [own, classes, attributes[2]], inlines]
        return None


class Book:
    """All documents, which know each other."""

    def __init__(self, documents: list[Document]) -> None:
        self.documents = {document.name: document for document in documents}
        self._current = documents[0]

    def typst(self, name: str) -> str:
        """Return a document as Typst."""
        self._current = self.documents[name]
        tree = self._current.tree
        _walk(tree["blocks"], self._print)
        return pandoc(json.dumps(tree), "json", "typst")

    def _print(self, node: dict[str, Any]) -> list[Any] | None:
        """What stands on paper for a node; None if the node itself."""
        kind, content = node["t"], node.get("c", [])
        if kind == "Str" and re.search(r"[$\\]", content):
            raise Unfinished(
                f"{self._current.name} has a formula that would be printed raw: {content}"
            )
        if kind == "Math":
            node["c"] = [content[0], readable(content[1])]
        elif kind in ("RawInline", "RawBlock") and content[0] == HTML:
            return [{"t": "LineBreak"}] if content[1].startswith("<br") else []
        elif kind == "Link":
            return self._link(content)
        elif kind == "Image":
            raise Unfinished(f"{self._current.name} has a picture from {content[2][0]}.")
        elif kind == "Table":
            rows = _cells(content)
            for row in rows:
                row[:] = [self._cell(cell) for cell in row]
            _walk(content, self._print)
            size = fitted(content)
            return [_raw(f"#table-text({size}pt, {len(rows)})["), node, _raw("]")]
        return None

    def _link(self, content: list[Any]) -> list[Any] | None:
        _, inlines, (target, _) = content
        if re.match(r"https?:", target):
            return None
        path, _, fragment = target.partition("#")
        place = posixpath.normpath(posixpath.join(posixpath.dirname(self._current.name), path))
        name = self._current.name if not path else place.removeprefix("../")
        if name not in self.documents:
            return list(inlines)
        anchors = self.documents[name].anchors
        if (anchor := unquote(fragment)) not in anchors:
            raise Unfinished(f"{self._current.name} links to {target}, which the book has not.")
        content[2] = [f"#{anchors[anchor]}", ""]
        return None

    @staticmethod
    def _cell(cell: list[Any]) -> list[Any]:
        """A table's cell without what is folded in it."""
        for block in cell[4]:
            if block["t"] in ("Plain", "Para"):
                block["c"] = _unfolded(block["c"])
        return cell


def pandoc(text: str, source: str, target: str) -> str:
    """Return a text in another form.

    Unfinished is raised if pandoc warns: then a formula would be printed raw.
    """
    command = [pypandoc.get_pandoc_path(), "-f", source, "-t", target, "--wrap=none"]
    run = subprocess.run(command, input=text, capture_output=True, text=True, encoding="utf-8")
    if run.returncode or run.stderr.strip():
        raise Unfinished(f"pandoc says: {run.stderr.strip()}")
    return run.stdout


def _walk(node: Any, change: Callable[[dict[str, Any]], list[Any] | None]) -> None:
    """Visit every node of a tree, the outer one first; what it is changed to is not visited."""
    if isinstance(node, dict):
        _walk(node.get("c"), change)
    elif isinstance(node, list):
        changed: list[Any] = []
        for each in node:
            new = change(each) if isinstance(each, dict) and "t" in each else None
            if new is None:
                _walk(each, change)
            changed += [each] if new is None else new
        node[:] = changed


def _unfolded(inlines: list[Any]) -> list[Any]:
    """What a fold says; what is in it one can look up on the page."""
    tags = [node["c"][1] if node["t"] == "RawInline" else "" for node in inlines]
    if "<details>" not in tags:
        return inlines
    begin, end = tags.index("<summary>"), tags.index("</summary>")
    return inlines[: tags.index("<details>")] + inlines[begin + 1 : end]


def _cells(table: list[Any]) -> list[list[Any]]:
    rows = [*table[3][1], *(row for body in table[4] for row in body[3])]
    return [row[1] for row in rows]


def _raw(text: str) -> dict[str, Any]:
    return {"t": "RawBlock", "c": ["typst", text]}


def _words(inlines: Any) -> str:
    """The words of a heading; Jupyter's name for it has its formulas as TeX."""
    if isinstance(inlines, list):
        return "".join(_words(each) for each in inlines)
    kind, content = inlines["t"], inlines.get("c")
    if kind in ("Space", "SoftBreak", "LineBreak"):
        return " "
    if kind == "Str":
        return str(content)
    if kind in ("Code", "Math"):
        return str(content[1])
    if kind == "Quoted":
        return f'"{_words(content[1])}"'
    return _words(content[-1] if kind in ("Span",) else content) if content else ""
