"""Pages of the ledger and of the chapters: what they say, and their places to link to."""

import re

import nbformat
import pytest

from driftlab.book.chapters import CHAPTERS
from driftlab.book.ledger import WORKS, ledger_entries
from executed import FOLDER, published
from reading.doors import documented, home
from reading.notebook_pages import notebook_pages
from reading.overview import chapters_page, text_of
from reading.papers import (
    _line,
    as_rst,
    entry_label,
    in_the_papers,
    ledger_pages,
    place_label,
    short,
)
from reading.parts import chapters, parts
from support import ROOT


@pytest.fixture(scope="module")
def ledger():
    """Pages of the ledger."""
    return ledger_pages()


@pytest.fixture(scope="module")
def book():
    """Pages of the notebooks, without outputs, as text: cells of code stand between fences."""
    clean = {name: nbformat.read(FOLDER / name, as_version=4) for name in published()}
    texts = notebook_pages(clean, chapters(ROOT)).texts
    return {name: as_text(nbformat.reads(text, as_version=4)) for name, text in texts.items()}


def as_text(notebook):
    cells = (
        cell.source if cell.cell_type == "markdown" else f"```python\n{cell.source}\n```"
        for cell in notebook.cells
    )
    return "\n".join(cells)


def test_every_function_of_the_ledger_has_an_entry():
    for entry in ledger_entries():
        for name in entry.functions:
            assert home(name) in documented(), name


def targets(text):
    return re.findall(r"^\(([\w-]+)\)=$", text, re.M)


def test_a_line_of_the_copy_is_set_and_keeps_its_letters():
    assert _line("") == ""
    assert _line("plain words") == "`plain words`"
    assert _line("size $x$") == "size $x$ (`size $x$`)"
    array = r"M &= \begin{array}{c} 1 \end{array}"
    set_, letters = rf"\begin{{aligned}} {array} \end{{aligned}}", f"`{array}`"
    assert [part.strip() for part in _line(array).split("\n") if part.strip()] == [
        *("$$", set_, "$$", letters)
    ]


def test_every_ledger_entry_is_a_place_of_its_own(ledger):
    found = [target for page in ledger.values() for target in targets(page)]
    assert sorted(found) == sorted(map(entry_label, ledger_entries()))
    assert len(set(found)) == len(found)


def test_chapters_and_their_sections_are_places(book):
    found = [
        target for name, text in book.items() if name[:2].isdigit() for target in targets(text)
    ]
    assert len(set(found)) == len(found)
    assert {f"chapter-{number}" for number in CHAPTERS} <= set(found)
    assert set(map(place_label, ledger_entries())) <= set(found)


def test_every_chapter_stands_in_the_overview_with_its_minutes(book):
    rows = chapters(ROOT)
    assert [row.number for row in rows] == list(CHAPTERS)
    text = chapters_page(ROOT)
    for row in rows:
        title = rf"## \[{row.number} {re.escape(row.name)}\]\({row.page}\.ipynb\)"
        assert re.search(rf"{title}\n\n.+\n\n{row.minutes} minutes", text)
    assert [chapter for part in parts(ROOT).values() for chapter in part] == list(rows)
    assert list(parts(ROOT))[1] == "Part I: A bent triad and its drift"


def test_a_chapter_leads_to_what_else_is_built():
    name = "03_systematic_drift.ipynb"
    clean = {name: nbformat.read(FOLDER / name, as_version=4)}
    text = notebook_pages(clean, chapters(ROOT)).texts[name]
    for address in (f"live/lab/index.html?path={name}", "drift-lab.pdf"):
        assert f'<a href=\\"{address}\\">' in text


def test_links_between_ledger_reference_and_chapters_lead_somewhere(ledger, book):
    places = {target for text in book.values() for target in targets(text)}
    for page, text in ledger.items():
        functions = re.findall(r"\{py:obj\}`[^<`]+ <([\w.]+)>`", text)
        assert set(functions) <= set(documented().values())
        assert set(re.findall(r"\]\(#([\w-]+)\)", text)) <= places
        assert functions or page == "ledger/index"


def test_a_function_says_what_became_of_its_equations():
    text = "\n".join(in_the_papers("driftlab.triad.triad_matrix"))
    assert ".. rubric:: In the papers" in text
    assert ":ref:`Larin, (2.4) <ledger-larin-2-4>`, *corrected*" in text
    assert "<chapter-03-for-readers-of-the-paper" in text
    assert in_the_papers("driftlab.vectors.unit") == []


def test_works_have_short_names():
    assert [short(paper) for paper in list(WORKS)[:4]] == [
        "Larin",
        "Perelyaev and Chelnokov",
        "Wu et al.",
        "Plotnikov et al.",
    ]


def test_formulas_and_code_of_the_ledger_become_those_of_docstrings():
    assert as_rst("by $n^T$ and `f`.") == r"by \ :math:`n^T`\  and ``f``."


def test_a_part_of_a_notebook_has_its_words_and_not_its_code():
    text = text_of(ROOT, "12_ledger_and_glossary.ipynb", "## Glossary", "## What the book cites")
    assert text.startswith("## Glossary\n")
    assert "| аксел" in text
    assert "references_table" not in text
    assert "What the book cites" not in text
