"""Makes the book, or a part of it, as a PDF: notebooks with their outputs, by pandoc and Typst.

Nothing of it depends on the machine: fonts are those that Typst brings and one beside this file,
the date is that of the version. What Typst reads is left in the folder for it, to be looked at.
"""

from __future__ import annotations

import re
import shutil
import tomllib
from pathlib import Path
from typing import Any, NamedTuple

import pikepdf
import typst
from nbformat import NotebookNode

import driftlab
from pdf.cells import markdown_of, tight
from pdf.contents import ERRATA, PARTS, chosen, figure_prefix, goes_on, label, part_of
from pdf.document import Book, Document
from pdf.pictures import plain_svg
from unfinished import Unfinished

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
FONTS = HERE / "fonts"
COVER = "figures/03-turning-block.svg"
TEMPLATE = '#import "template.typ": *'
FIRST = "00 Start here"
"""The heading of chapter 00, which has the title of the book as its own."""


class Look(NamedTuple):
    """How a document is to be printed."""

    paper: str = "a4"  # its name in Typst, "a4" or "us-letter"
    with_code: bool = True  # whether what the cells gave has their code above it
    # a "notebook", "exercises" to be written on, an "examination" or its "scheme"
    kind: str = "notebook"


AS_A_BOOK = Look()
WITHOUT_PART = {"examination": "Examination", "scheme": "Not for the class"}
"""What stands above a document that belongs to no part of the book."""


def make_pdf(
    notebooks: dict[str, NotebookNode], build: Path, target: Path, look: Look = AS_A_BOOK
) -> None:
    """Make the PDF of the whole book.

    Unfinished is raised if a formula cannot be read, a link leads nowhere, or Typst warns.
    """
    folder = _emptied(build / "pdf")
    cover = plain_svg((ROOT / COVER).read_text("utf-8"))
    (folder / "pictures/cover.svg").write_text(cover, "utf-8")
    _compile(folder, _book(notebooks, folder / "pictures", look), target)


def make_handout(
    name: str, notebook: NotebookNode, build: Path, target: Path, look: Look = AS_A_BOOK
) -> None:
    """Make the PDF of one document; its links to others are words."""
    folder = _emptied(build / "print" / label(name))
    part = part_of(name)
    title = WITHOUT_PART.get(look.kind, part.title)
    said = {"kind": look.kind, "part": title, "source": part.source, "number": figure_prefix(name)}
    document = Document(name, _markdown(name, notebook, folder / "pictures", look))
    blocks = [
        TEMPLATE,
        f"#show: handout.with({_front(look, **said)})",
        Book([document]).typst(name),
    ]
    _compile(folder, blocks, target)


def _emptied(folder: Path) -> Path:
    """A folder for what Typst reads."""
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "pictures").mkdir(parents=True)
    shutil.copy(HERE / "template.typ", folder)
    return folder


def _compile(folder: Path, blocks: list[str], target: Path) -> None:
    source = folder / "book.typ"
    source.write_text("\n\n".join(blocks) + "\n", "utf-8")
    target.parent.mkdir(parents=True, exist_ok=True)
    compiler = typst.Compiler(
        str(source), root=str(source.parent), font_paths=[str(FONTS)], ignore_system_fonts=True
    )
    try:
        _, warnings = compiler.compile_with_warnings(output=str(target), format="pdf")
    except typst.TypstError as trouble:
        raise Unfinished(f"Typst says: {trouble.diagnostic}") from trouble
    if warnings:
        raise Unfinished("\n".join(["Typst warns:", *(each.message for each in warnings)]))
    with pikepdf.open(target, allow_overwriting_input=True) as written:
        # Tags, by which a screen reader finds its way, are many small things.
        together = pikepdf.ObjectStreamMode.generate
        written.save(target, object_stream_mode=together, deterministic_id=True)


def _book(notebooks: dict[str, NotebookNode], pictures: Path, look: Look) -> list[str]:
    """All of the book as Typst."""
    names = [name for part in PARTS for name in chosen(part, [*notebooks, ERRATA])]
    documents = [
        Document(name, _markdown(name, notebooks.get(name), pictures, look)) for name in names
    ]
    book = Book(documents)
    blocks = [TEMPLATE, f"#show: book.with({_front(look)})"]
    for part in PARTS:
        for number, name in enumerate(chosen(part, names)):
            begin = [figure_prefix(name), *([part.title, part.source] if number == 0 else [])]
            arguments = [*map(_string, begin), f"goes-on: {str(goes_on(name)).lower()}"]
            blocks += [f"#begin-document({', '.join(arguments)})", book.typst(name)]
    return blocks


def _markdown(name: str, notebook: NotebookNode | None, pictures: Path, look: Look) -> str:
    if notebook is None:
        # Names of tests are for who has the files at hand, where they stand too.
        return re.sub(r"; checked by [^\n]*", ".", tight((ROOT / ERRATA).read_text("utf-8")))
    text = markdown_of(notebook, label(name), pictures, with_code=look.with_code)
    return re.sub(r"^# .*", f"# {FIRST}", text, count=1) if name.startswith("00_") else text


def _front(look: Look, **more: str) -> str:
    """What the title says, and how it all looks, as arguments of the template."""
    release: dict[str, Any] = tomllib.loads((ROOT / "release/release.toml").read_text("utf-8"))
    citation = (ROOT / "CITATION.cff").read_text("utf-8")
    (title,) = re.findall(r'^title: "(.*)"$', citation, re.M)
    date = release["date"]
    addresses = [address for address in release["urls"].values() if address][:1]
    said = {
        "title": title,
        "version": driftlab.__version__,
        "authors": release["authors"],
        "address": "".join(addresses),
        "paper": look.paper,
        **more,
    }
    arguments = [f"{key}: {_string(value)}" for key, value in said.items()]
    arguments.append(f"date: datetime(year: {date.year}, month: {date.month}, day: {date.day})")
    return ", ".join(arguments)


def _string(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'
