"""What the site is made of: every public name has an entry, and links have places to lead to."""

import inspect
import re
import zlib
from html.parser import HTMLParser
from importlib import import_module
from urllib.parse import unquote

import nbformat
import pytest
from numpydoc.docscrape import ClassDoc, FunctionDoc

from driftlab.__main__ import SUBJECTS
from driftlab.book.chapters import CHAPTERS
from driftlab.book.ledger import WORKS, ledger_entries
from driftlab.book.references import all_references
from executed import FOLDER, notebooks
from reading.api_pages import api_pages, module_page, module_title, plain_bars
from reading.doors import BOOK, DOORS, aliases, documented, first_door, home, modules, names, thing
from reading.field_words import also, words_of_functions, words_of_tasks
from reading.links import with_links
from reading.notebook_pages import notebook_pages
from reading.overview import chapters_page, text_of
from reading.papers import (
    _line,
    as_rst,
    entry_label,
    equation_label,
    in_the_papers,
    ledger_pages,
    place_label,
    short,
)
from reading.parts import chapters, parts
from requests_of import requests_of
from support import ROOT


@pytest.fixture(scope="module")
def api():
    """Pages of the reference; the whole package is imported for them, so not before it is asked."""
    return api_pages()


@pytest.fixture(scope="module")
def ledger():
    """Pages of the ledger."""
    return ledger_pages()


@pytest.fixture(scope="module")
def book():
    """Pages of the notebooks, without outputs, as text: cells of code stand between fences."""
    clean = {name: nbformat.read(FOLDER / name, as_version=4) for name in notebooks()}
    texts = notebook_pages(clean, chapters(ROOT)).texts
    return {name: as_text(nbformat.reads(text, as_version=4)) for name, text in texts.items()}


def as_text(notebook):
    cells = (
        cell.source if cell.cell_type == "markdown" else f"```python\n{cell.source}\n```"
        for cell in notebook.cells
    )
    return "\n".join(cells)


def offered():
    """Names at all doors, of what is no module."""
    for door in DOORS:
        for key in import_module(door).__all__:
            if not inspect.ismodule(thing(f"{door}.{key}")):
                yield f"{door}.{key}"


def test_every_name_at_a_door_leads_to_an_entry():
    entries, others = set(documented().values()), aliases()
    assert [name for name in offered() if others.get(name, name) not in entries] == []


def test_every_entry_stands_on_one_page_once(api):
    text = "\n".join(api.values())
    found = re.findall(r"^\.\. auto(?:function|class):: (\S+)$", text, re.M)
    constants = re.findall(r"^\.\. py:data:: (\S+)\n   :module: (\S+)$", text, re.M)
    found += [f"{module}.{key}" for key, module in constants]
    assert sorted(found) == sorted(name.documented for name in names())


def test_a_name_is_documented_where_readers_import_it():
    assert documented()["driftlab.drift.systematic_drift.drift_per_turn"] == (
        "driftlab.drift.drift_per_turn"
    )
    assert aliases()["driftlab.drift_per_turn"] == "driftlab.drift.drift_per_turn"
    assert aliases()["driftlab.Scheme"] == "driftlab.motion.Scheme"
    assert "driftlab.earth.EARTH_RATE" in documented().values()  # its home is a core


def test_the_index_leads_with_the_first_door_and_ends_with_the_book(api):
    page = api["reference/index"]
    listed = re.findall(r"^- :py:obj:`\w+ <driftlab\.([\w.]+)>`: \S", page, re.M)
    assert {"attitude.integrate", "gyrocompass.align", "calibration.calibrate"} <= set(listed)
    assert len(listed) == len(set(listed)) == len(first_door()) > 30
    assert page.index("gyrocompass.align>") < page.index("   motion") < page.index("   book")
    assert page.rstrip().endswith("   book")


def test_pages_are_titled_by_their_subject_and_say_their_module(api):
    floors = ["", *(subject for subject in SUBJECTS if subject != "book")]
    titles = [module_title(module) for floor in floors for module in modules(floor)]
    assert len(set(titles)) == len(titles)
    page = api["reference/modules/calibration.filter"]
    assert page.startswith("Calibrating a whole unit on a turntable with a Kalman filter\n====")
    assert "\n``driftlab.calibration.filter``\n" in page


def test_functions_of_the_first_door_say_what_else_to_see():
    ends = {shown.rpartition(".")[2] for shown in documented().values()}
    for name in first_door():
        if name.kind == "function" and not name.home.startswith("driftlab.core."):
            seen = FunctionDoc(inspect.unwrap(thing(name.home)))["See Also"]
            others = {other.rpartition(".")[2] for group, _ in seen for other, _ in group}
            assert others, name.home
            # A method of a recording has its entry with the class.
            assert others - {"increments"} <= ends - {name.home.rpartition(".")[2]}, name.home


def test_papers_that_docstrings_cite_are_those_of_the_book():
    known = {re.sub(r"\s+", " ", str(entry)) for entry in all_references()}
    cited = 0
    for name in names():
        if name.kind != "data" and not name.home.startswith(BOOK):
            found = inspect.unwrap(thing(name.home))
            doc = ClassDoc(found) if name.kind == "class" else FunctionDoc(found)
            text = " ".join(line.strip() for line in doc["References"])
            for item in filter(None, re.split(r"(?:^|\s)- ", text)):
                assert any(item.startswith(entry) for entry in known), (name.home, item)
                cited += 1
    assert cited > 20


def test_words_of_the_field_stand_on_the_page_of_their_function():
    words = words_of_functions()
    assert "gyrocompassing" in words["driftlab.gyrocompass.alignment.align"]
    assert "ZUPT" in words["driftlab.recordings.rest_detection.rests"]
    # A helper of another subject does not get them.
    assert "driftlab.axes.convert_vectors" in documented()
    assert "gyrocompassing" not in words["driftlab.axes.convert_vectors"]
    assert "heading" in also("driftlab.gyrocompass.alignment.align")[1]
    assert also("driftlab.vectors.unit") == []
    assert words.keys() <= documented().keys()
    assert len(words_of_tasks()) > 30


def test_every_documented_name_means_its_thing():
    for name in names():
        assert home(name.documented) == name.home
        # A constant handed on from a core is the same thing, too.
        assert thing(name.documented) is thing(name.home)


def test_pages_and_their_contents_lead_to_each_other(api):
    listed = {
        f"{page.rpartition('/')[0]}/{target}"
        for page, text in api.items()
        for target in re.findall(r"^   (?:\w+ <)?([\w./]+)>?$", text, re.M)
    }
    assert api.keys() - {"reference/index"} <= listed
    for subject in ("", *(subject for subject in SUBJECTS if subject != "book")):
        assert modules(subject)
        assert all(module_page(module) in api for module in modules(subject))


def test_a_constant_shows_its_value_and_its_words(api):
    page = api["reference/modules/earth"]
    assert ".. py:data:: EARTH_RATE\n   :module: driftlab.earth\n   :value: " in page
    schemes = api["reference/modules/motion.scheme"]
    (text,) = re.findall(r"NINETEEN_POSITIONS\n(?:   :.*\n)*\n((?:   .+\n)+)", schemes)
    assert len(text.split()) > 3


@pytest.mark.parametrize("command", ["calibrate", "allan", "align", "integrate", "example"])
def test_commands_are_shown_with_what_their_help_says(command, api):
    assert f"usage: python -m driftlab {command}" in api["reference/commands"]


# ------------------------------------------------------------------ the ledger


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


def test_chapters_their_sections_and_equations_are_places(book):
    found = [
        target for name, text in book.items() if name[:2].isdigit() for target in targets(text)
    ]
    assert len(set(found)) == len(found)
    assert {f"chapter-{number}" for number in CHAPTERS} <= set(found)
    assert set(map(place_label, ledger_entries())) <= set(found)
    equations = {equation_label(entry) for entry in ledger_entries()} - {""}
    assert {place for place in found if place.startswith("eq-")} == equations
    assert len(equations) > 70


def test_a_number_alone_is_a_link_where_a_chapter_treats_one_paper(book):
    assert "such as [(1.4)](#eq-larin-1-4) here" in book["03_systematic_drift.ipynb"]
    assert "[(44)](#eq-wu-44). The half-diff" in book["07_installation_errors.ipynb"]
    assert "Sciences 41(4), 1993" in book["05_cayley_and_riccati.ipynb"]
    assert "#eq-" not in book["12_ledger_and_glossary.ipynb"]
    places = {target for text in book.values() for target in targets(text)}
    for text in book.values():
        assert set(re.findall(r"\]\(#(eq-[\w-]+)\)", text)) <= places


def test_an_equation_stands_at_its_number_its_proof_or_its_heading(book):
    numbered = book["04_calibration_by_turns.ipynb"]
    assert re.search(r"^\(eq-larin-3-3\)=\n\$\$n\^T", numbered, re.M)
    drift = book["03_systematic_drift.ipynb"]
    assert re.search(r"^\(eq-larin-2-5\)=\n```python\nmu = sp.symbols", drift, re.M)
    assert re.search(r"^\(eq-larin-2-4\)=\n\(chapter-03-.*\)=\n### The bend and its", drift, re.M)


def test_every_chapter_stands_in_the_overview_with_its_minutes(book):
    rows = chapters(ROOT)
    assert [row.number for row in rows] == list(CHAPTERS)
    text = chapters_page(ROOT)
    for row in rows:
        title = rf"## \[{row.number} {re.escape(row.name)}\]\({row.page}\.ipynb\)"
        assert re.search(rf"{title}\n\n.+\n\n{row.minutes} minutes", text)
    assert [chapter for part in parts(ROOT).values() for chapter in part] == list(rows)
    assert list(parts(ROOT))[1] == "Part I: Larin"


def test_a_chapter_leads_to_what_else_is_built():
    name = "03_systematic_drift.ipynb"
    clean = {name: nbformat.read(FOLDER / name, as_version=4)}
    text = notebook_pages(clean, chapters(ROOT), ("live", "colab", "pdf")).texts[name]
    for address in (f"live/lab/index.html?path={name}", f"colab/{name}", "drift-lab.pdf"):
        assert f'<a href=\\"{address}\\">' in text
    assert "<a href=" not in notebook_pages(clean, chapters(ROOT), ()).texts[name]


def test_links_between_ledger_reference_and_chapters_lead_somewhere(ledger, book):
    places = {target for text in book.values() for target in targets(text)}
    linked = set(re.findall(r"\]\(#(chapter-[\w-]+)\)", chapters_page(ROOT)))
    assert len(linked) > 50
    assert linked <= places
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


# ------------------------------------------------------------------ texts


def test_bars_stay_bars_but_where_they_are_code_or_formulas():
    formulas = [".. math:: |w|", "   |v|", "", ".. math::", "", "   |s| &= 1", "", "   |t|", ""]
    lines = ["|w| is `a|b` here", "", ">>> a | b", "|x|", "", *formulas, "|u|"]
    assert plain_bars(lines) == [
        r"\|w\| is `a|b` here",
        *["", ">>> a | b", "|x|", "", *formulas, r"\|u\|"],
    ]


@pytest.mark.parametrize(
    ("link", "led"),
    [
        ("03_systematic_drift.ipynb", "03_systematic_drift.ipynb"),
        ("../03_systematic_drift.ipynb#Derive", "../03_systematic_drift.ipynb#derive"),
        ("#Where-axes,-signs%20and-names-differ", "#where-axes-signs-and-names-differ"),
        ("../ERRATA.md", "/errata.md"),
        ("../README.md", "/index.md"),
        ("../figures/README.md", "/gallery/index.md"),
        ("../figures/03-drift-map.svg", "/gallery/03-drift-map.svg"),
        ("https://example.org/a.ipynb", "https://example.org/a.ipynb"),
        ("picture.svg", "picture.svg"),
    ],
)
def test_links_of_the_notebooks_lead_to_places_of_the_site(link, led):
    assert with_links(f"See [it]({link}).") == f"See [it]({led})."


def test_names_in_the_notebooks_lead_to_the_reference():
    assert with_links("`driftlab.align`, `driftlab.x`, ``driftlab.align``, `align`") == (
        "{py:obj}`driftlab.align`, `driftlab.x`, ``driftlab.align``, `align`"
    )


def test_a_part_of_a_notebook_has_its_words_and_not_its_code():
    text = text_of(ROOT, "12_ledger_and_glossary.ipynb", "## Glossary", "## What the book cites")
    assert text.startswith("## Glossary\n")
    assert "| аксел" in text
    assert "references_table" not in text
    assert "What the book cites" not in text


def test_what_a_page_would_fetch_from_elsewhere_is_found(tmp_path):
    (tmp_path / "quiet.html").write_text(
        '<a href="https://example.org">a link</a><script src="own.js"></script>'
        '<link rel="stylesheet" href="own.css"><img src="data:image/png;base64,">',
        "utf-8",
    )
    assert requests_of(tmp_path) == []
    (tmp_path / "loud.html").write_text(
        '<img src="//a.example/x.png"><link rel="preload" href="https://b.example/f.woff2">',
        "utf-8",
    )
    (tmp_path / "loud.css").write_text("@import url('https://c.example/f.css');", "utf-8")
    assert requests_of(tmp_path) == [
        "loud.html: //a.example/x.png",
        "loud.html: https://b.example/f.woff2",
        "loud.css: https://c.example/f.css",
    ]


# ------------------------------------------------------------------ the site as built


def inventory(site):
    """Names, kinds and addresses in objects.inv, to which other projects link."""
    head, _, packed = (site / "objects.inv").read_bytes().partition(b"zlib.\n")
    assert head.startswith(b"# Sphinx inventory version 2")
    lines = zlib.decompress(packed).decode("utf-8").splitlines()
    rows = [re.fullmatch(r"(.+?) (\S+:\S+) (-?\d+) (\S*) (.*)", line).groups() for line in lines]
    return {name: address for name, domain, _, address, _ in rows if domain.startswith("py:")}


def test_the_inventory_has_every_name_at_every_door(site):
    built = inventory(site)
    assert set(offered()) - built.keys() == set()
    assert set(documented()) - built.keys() == set()
    for address in set(built.values()):
        assert (site / address.partition("#")[0]).exists()


def test_a_page_has_formulas_outputs_sources_and_the_papers(site):
    page = (site / "reference/modules/drift.systematic_drift.html").read_text("utf-8")
    entry = page[page.index('id="driftlab.drift.drift_coefficient"') :]
    entry = entry[: entry.index("</dd></dl>")]
    for part in ("array([0.02, 0.", "In the papers", "ledger/larin.html#ledger-larin-", "[source]"):
        assert part in re.sub(r"<[^a][^>]*>", "", entry), part
    assert "03_systematic_drift.html#chapter-03-only-the-symmetric-part" in entry
    assert 'class="math' in entry


def test_pages_ask_nothing_of_other_places_and_tables_are_tables(site):
    assert requests_of(site) == []
    for path in site.rglob("*.html"):
        if "_modules" not in path.parts:
            assert "| --- |" not in path.read_text("utf-8"), path


class Links(HTMLParser):
    """Places of a page, and the addresses that it links to or shows."""

    def __init__(self, path):
        super().__init__()
        self.places, self.links = set(), set()
        self.feed(path.read_text("utf-8"))

    def handle_starttag(self, tag, attrs):
        for key, value in attrs:
            if key == "id":
                self.places.add(value)
            elif key in ("href", "src") and not re.match(r"[a-z]+:", value):
                self.links.add(unquote(value))


def test_every_link_on_the_site_leads_somewhere(site):
    pages = {path.resolve(): Links(path) for path in site.rglob("*.html")}
    dead = []
    for path, page in pages.items():
        for link in page.links:
            file, _, place = link.partition("#")
            target = (path.parent / file.partition("?")[0]).resolve() if file else path
            there = target.exists() and (not place or place in pages[target].places)
            if notebook := re.search(r"live/lab/index\.html\?path=(.+)$", link):
                there = there and (site / "live/files" / notebook[1]).exists()
            dead += [] if there else [f"{path.relative_to(site)}: {link}"]
    assert dead == []
