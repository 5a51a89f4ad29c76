"""Every notebook is clean in the repository and built as the book's notebooks are."""

import re
from itertools import pairwise
from pathlib import Path

import nbformat
import pytest
from pages import (
    CHAPTERS,
    FOLDER,
    LEDGER,
    NOTEBOOKS,
    PAGES,
    SLIDE_TYPES,
    START,
    markdown,
    name_of,
    size_of,
    slide_types,
)

ROOT = FOLDER.parent
BEGIN, END = ["A puzzle", "What you will be able to do"], ["Exercises", "Read on"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=name_of)
def test_is_committed_clean(path: Path) -> None:
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    identifiers = [cell.id for cell in notebook.cells]
    assert len(set(identifiers)) == len(identifiers)
    for cell in notebook.cells:
        if cell.cell_type == "code":
            assert not cell.outputs
            assert cell.execution_count is None
            assert len(cell.source.splitlines()) <= 25, f"{cell.id} is long; move it to the package"


@pytest.mark.parametrize("path", [START, *CHAPTERS], ids=name_of)
def test_each_cell_says_what_it_is_on_the_slides(path: Path) -> None:
    """Read from the file, so that whoever adds a cell hears of it before a notebook is run."""
    notebook = nbformat.read(path, as_version=4)
    types = slide_types(notebook)
    assert types[notebook.cells[0].id] == "slide", f"{path.name}: the first cell opens the slides"
    for cell in notebook.cells:
        shown = types[cell.id]
        headings = re.findall(r"^(#+) ", cell.source, re.MULTILINE)
        if cell.cell_type == "markdown" and headings and shown not in ("skip", "notes"):
            assert cell.source.startswith("#"), (
                f"{cell.id}: a heading opens a slide, so it must begin its cell; divide the cell"
            )
            wanted = "slide" if len(headings[0]) <= 2 else "subslide"
            assert shown == wanted, (
                f"{cell.id}: a heading of level {len(headings[0])} has the Slide Type "
                f"{SLIDE_TYPES[wanted]}, got {SLIDE_TYPES[shown]}"
            )
        if "Explorer(" in cell.source or "\nanswer = ..." in f"\n{cell.source}":
            assert shown == "skip", (
                f"{cell.id}: neither sliders nor answers live on a slide; set its Slide Type, "
                f"{SLIDE_TYPES[shown]}, to Skip"
            )


@pytest.mark.parametrize(
    ("metadata", "says"),
    [
        ({}, "no slide type in: mine"),
        ({"slideshow": {"slide_type": "Skip"}}, "no slide type in: mine"),
    ],
)
def test_a_cell_without_a_slide_type_is_told_where_to_set_it(metadata: dict, says: str) -> None:
    notebook = nbformat.v4.new_notebook(
        cells=[nbformat.v4.new_markdown_cell("### 3.7", id="mine", metadata=metadata)]
    )
    with pytest.raises(AssertionError, match=f"{says}.*Slide Type.*Sub-Slide"):
        slide_types(notebook)


@pytest.mark.parametrize("path", PAGES, ids=name_of)
def test_headings_go_down_one_level_at_a_time(path: Path) -> None:
    text = re.sub(r"^```.*?^```", "", markdown(path), flags=re.MULTILINE | re.DOTALL)
    levels = [len(hashes) for hashes in re.findall(r"^(#+) ", text, flags=re.MULTILINE)]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))


@pytest.mark.parametrize("path", PAGES, ids=name_of)
def test_links_lead_somewhere(path: Path) -> None:
    for target in re.findall(r"\]\((?!https?:)([^)#]+)\)", markdown(path)):
        # JupyterLab opens no folder from a link.
        assert (path.parent / target).is_file(), target


@pytest.mark.parametrize("path", PAGES, ids=name_of)
def test_no_text_counts_on_colours(path: Path) -> None:
    words = r"\b(red|blue|green|orange|purple|violet|yellow|gr[ae]y|pink|cyan|magenta)\b"
    assert not re.findall(words, markdown(path), flags=re.IGNORECASE)


@pytest.mark.parametrize("path", [*PAGES, *ROOT.glob("*.md"), *ROOT.glob("*/*.md")])
def test_no_bare_bar_in_a_formula_of_a_table(path: Path) -> None:
    """There it ends the cell, everywhere but in JupyterLab."""
    rows = re.findall(r"^ *\|.*$", markdown(path), flags=re.MULTILINE)
    formulas = [formula for row in rows for formula in re.findall(r"\$[^$]+\$", row)]
    assert [formula for formula in formulas if "|" in formula] == []


def test_formulas_write_fonts_as_every_reader_of_them_knows() -> None:
    r"""Also those that code composes: ``\rm`` is old, and pandoc does not read it."""
    sources = [path for kind in ("py", "toml") for path in ROOT.glob(f"src/**/*.{kind}")]
    for path in [*sources, *PAGES, *ROOT.glob("*.md"), *ROOT.glob("docs/*.md")]:
        text = path.read_text(encoding="utf-8")
        assert re.findall(r"\\(?:rm|sf|bf|it|cal)\b.{9}", text) == [], path


@pytest.mark.parametrize("path", CHAPTERS, ids=name_of)
def test_chapter_has_its_bones(path: Path) -> None:
    headings = re.findall(r"^## (.*)$", markdown(path), flags=re.MULTILINE)
    first = nbformat.read(path, as_version=4).cells[0].source
    assert re.search(r"\A# \d\d [^\n]+\n\n\*[^*\n]+\.\*$", first, re.MULTILINE)  # title, subject
    assert headings[:2] == BEGIN
    assert headings[-2:] == END
    assert not [heading for heading in headings if re.search(r"\(\d", heading)]  # no equations


@pytest.mark.parametrize("path", [START, *CHAPTERS], ids=name_of)
def test_chapter_ends_in_what_to_read_and_the_way_on(path: Path) -> None:
    read_on, neighbours = nbformat.read(path, as_version=4).cells[-2:]
    number = path.name[:2]
    assert read_on.id == f"{number}-read-on-1"
    assert "(bibliography.ipynb)" in read_on.source
    assert neighbours.id == f"{number}-end-1"
    assert "\n" not in neighbours.source


@pytest.mark.parametrize("path", CHAPTERS, ids=name_of)
def test_chapter_carries_one_idea_in_at_most_ninety_minutes(path: Path) -> None:
    size, text = size_of(path), markdown(path)
    assert size.asserts == 0, "what only checks the book is in hidden cells"
    assert size.words <= 4000
    assert size.lines <= 450
    promise = text.split("## What you will be able to do")[1].split("\n## ")[0]
    assert 3 <= promise.count("\n- ") <= 5
    assert f"About {size.minutes} minutes" in promise
    assert size.minutes <= 90


def test_minutes_are_the_same_wherever_they_stand() -> None:
    readme = (FOLDER.parent / "README.md").read_text(encoding="utf-8")
    page = markdown(FOLDER / "for_instructors.ipynb")
    for path in CHAPTERS:
        number = path.name[:2]
        (stated,) = re.findall(r"About (\d+) minutes", markdown(path))
        assert re.search(rf"^\| {number} \|.*\| {stated} \|", readme, re.MULTILINE), number
        assert re.search(rf"^\| {number} [^|]*\| {stated} \|", page, re.MULTILINE), number


def test_glossary_has_three_languages_and_names_chapters() -> None:
    text = markdown(LEDGER).split("## Glossary")[1]
    rows = [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in text.splitlines()
        if line.startswith("| ")
    ]
    header, terms = rows[0], rows[1:]
    assert header == ["English", "Russian", "Chinese", "what it means here", "chapter"]
    assert [term[0].lower() for term in terms] == sorted(term[0].lower() for term in terms)
    for english, russian, chinese, meaning, chapter in terms:
        assert re.search(r"[a-z]", english)
        assert re.search(r"[а-яё]", russian), english
        assert re.search(r"[\u4e00-\u9fff]", chinese), english
        assert meaning.endswith("."), english
        assert len(list(FOLDER.glob(f"{chapter}_*.ipynb"))) == 1, english
