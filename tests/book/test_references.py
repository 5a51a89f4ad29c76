"""Every reference stands once in the data, and in the chapters letter for letter."""

import re

from pages import FOLDER, markdown, name_of

from driftlab.book.references import all_references, references_table
from support import ROOT

ENTRIES = all_references()
OTHERS = {"M_g", "M_a"}  # of Groves's software
SOURCE = ROOT / "src" / "driftlab"
TEXTS = {name_of(path): markdown(path) for path in sorted(FOLDER.rglob("*.ipynb"))}


def test_entries_are_in_order_and_each_is_there_once():
    keys = [entry.key for entry in ENTRIES]
    assert keys == sorted(set(keys))
    citations = [str(entry) for entry in ENTRIES]
    assert len(set(citations)) == len(citations)


def test_entries_are_well_formed():
    for entry in ENTRIES:
        assert bool(entry.title) != bool(entry.about), entry.key
        assert entry.where or entry.doi, entry.key  # where to find it
        assert entry.year == 0 or 1850 < entry.year < 2030, entry.key
        if entry.year:
            assert entry.key.endswith(str(entry.year)) or not re.search(r"\d{4}$", entry.key)
        assert re.fullmatch(r"(10\.\d{4,9}/\S+)?", entry.doi), entry.key
        assert not re.search(r"\s\s|\.$|\|", str(entry)), entry.key


def test_each_entry_is_quoted():
    text = "\n".join(TEXTS.values())
    assert [entry.key for entry in ENTRIES if str(entry) not in text] == []


def test_every_line_to_read_on_is_an_entry_and_says_why():
    _, *sections = re.split(r"^## \d\d .*\n", TEXTS["bibliography.ipynb"], flags=re.M)
    lines = [line for section in sections for line in section.splitlines() if line[:2] == "- "]
    assert len(lines) > 40
    for line in lines:
        found = [entry for entry in ENTRIES if line.startswith(f"- {entry}: ")]
        assert len(found) == 1, line
        assert re.fullmatch(r"\S.*[^.]\.", line.removeprefix(f"- {found[0]}: ")), line


def test_table_has_every_entry_with_its_identifier():
    _, *rows = references_table().rows
    assert [row[0] for row in rows] == [str(entry) for entry in ENTRIES]
    for entry, (_, link) in zip(ENTRIES, rows, strict=True):
        assert link == (f"[{entry.doi}](https://doi.org/{entry.doi})" if entry.doi else "")


def test_names_beside_a_textbook_are_names_of_the_package():
    """In the sections on textbooks, and in the columns of chapter 19 that speak of the code."""
    sources = "\n".join(path.read_text(encoding="utf-8") for path in SOURCE.rglob("*.py"))
    desk = TEXTS["19_ledger_and_glossary.ipynb"].split("## With your textbook on the desk")[1]
    desk = desk.split("\n## ")[0]
    signs, words = desk.split("### The field's words")
    cells = [
        *(column for row in table_rows(signs) for column in (row[1], row[-1])),
        *(row[2] for row in table_rows(words)),
        *(
            text.split("## Read on")[1].split("\n## ")[0]
            for text in TEXTS.values()
            if "## Read on" in text
        ),
    ]
    names = set(re.findall(r"`-?(?:driftlab\.)?([A-Za-z]\w+)", "\n".join(cells))) - OTHERS
    assert len(names) > 25
    unknown = {name for name in names if not re.search(rf"\b{name}\b", sources)}
    assert {n for n in unknown if not (SOURCE / f"{n}.py").exists()} == set()


def table_rows(text):
    """Rows of the tables in Markdown, without their headers."""
    lines = [line.strip("|").split("|") for line in text.splitlines() if line.startswith("| ")]
    return [[cell.strip() for cell in line] for line in lines[1:]]
