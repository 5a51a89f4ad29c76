"""Makes the book as a PDF: notebooks with their outputs, by pandoc and Typst.

Nothing of it depends on the machine: fonts are those that Typst brings and one beside this file,
the date is that of the version. What Typst reads is left in the folder for it, to be looked at.
"""

from __future__ import annotations

import re
import shutil
import tomllib
from pathlib import Path
from typing import Any

import pikepdf
import typst
from nbformat import NotebookNode

import driftlab
from pdf.cells import markdown_of, tight
from pdf.contents import ERRATA, PARTS, chosen, figure_prefix, label
from pdf.document import Book, Document
from pdf.glyphs import pages_with_boxes
from pdf.pictures import plain_svg
from unfinished import Unfinished

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
FONTS = HERE / "fonts"
COVER = "figures/03-turning-block.svg"
FIRST = "00 Start here"
"""The heading of chapter 00, which has the title of the book as its own."""


def make_pdf(notebooks: dict[str, NotebookNode], build: Path, target: Path) -> None:
    """Make the PDF.

    Parameters
    ----------
    notebooks : dict of str to NotebookNode
        The book with its outputs, as `executed.executed` returns it.
    build : Path
        Folder for what is needed on the way.
    target : Path
        The file.

    Raises
    ------
    Unfinished
        If a formula cannot be read, a link leads nowhere, a sign is in no font, or Typst refuses
        or warns.
    """
    folder = build / "pdf"
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "pictures").mkdir(parents=True)
    shutil.copy(HERE / "template.typ", folder)
    cover = plain_svg((ROOT / COVER).read_text("utf-8"))
    (folder / "pictures/cover.svg").write_text(cover, "utf-8")
    source = folder / "book.typ"
    source.write_text(_typst(notebooks, folder / "pictures"), "utf-8")
    target.parent.mkdir(parents=True, exist_ok=True)
    _compile(source, target)


def _compile(source: Path, target: Path) -> None:
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
        if boxes := pages_with_boxes(written):
            raise Unfinished(f"The fonts lack a sign on page {boxes}; see {FONTS / 'README.md'}.")
        # Tags, by which a screen reader finds its way, are many small things.
        together = pikepdf.ObjectStreamMode.generate
        written.save(target, object_stream_mode=together, deterministic_id=True)


def _typst(notebooks: dict[str, NotebookNode], pictures: Path) -> str:
    """All of the book as Typst."""
    names = [name for part in PARTS for name in chosen(part, [*notebooks, ERRATA])]
    documents = [Document(name, _markdown(name, notebooks, pictures)) for name in names]
    book = Book(documents)
    blocks = ['#import "template.typ": *', f"#show: book.with({_front()})"]
    for part in PARTS:
        for number, name in enumerate(chosen(part, names)):
            begin = [part.title, part.source] if number == 0 else []
            blocks.append(
                f"#begin-document({', '.join(map(_string, [figure_prefix(name), *begin]))})"
            )
            blocks.append(book.typst(name))
    return "\n\n".join(blocks) + "\n"


def _markdown(name: str, notebooks: dict[str, NotebookNode], pictures: Path) -> str:
    if name == ERRATA:
        # Names of tests are for who has the files at hand, where they stand too.
        return re.sub(r"; checked by [^\n]*", ".", tight((ROOT / ERRATA).read_text("utf-8")))
    text = markdown_of(notebooks[name], label(name), pictures)
    return re.sub(r"^# .*", f"# {FIRST}", text, count=1) if name.startswith("00_") else text


def _front() -> str:
    """What the title page says, as arguments of the template."""
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
    }
    arguments = [f"{key}: {_string(value)}" for key, value in said.items()]
    arguments.append(f"date: datetime(year: {date.year}, month: {date.month}, day: {date.day})")
    return ", ".join(arguments)


def _string(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'
