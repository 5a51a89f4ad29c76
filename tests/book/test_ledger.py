"""The equation ledger is complete, and every place, function and test that it names exists."""

import ast
import re
from functools import cache
from importlib import import_module

import nbformat
import pytest

from driftlab.book import ledger
from driftlab.book.errata import errata, papers_page
from driftlab.book.ledger import KINDS, PAPERS, PUBLISHERS, SEVERITIES, STATUSES, WORKS
from support import ROOT

ENTRIES = ledger.ledger_entries()

# Every number that the papers give to an equation, a table or a figure.
NUMBERED = {
    "larin": [
        *(f"(1.{i})" for i in range(1, 6)),
        *(f"(2.{i})" for i in range(1, 7)),
        *(f"(3.{i})" for i in range(1, 6)),
    ],
    "perelyaev-chelnokov": [f"(1.{i})" for i in range(1, 12)],
    "wu": [
        *(f"({i})" for i in range(1, 53)),
        "Table 1",
        "Table 2",
        *(f"Fig. {i}" for i in range(1, 6)),
    ],
    "plotnikov": ["Fig. 1", "Fig. 2"],
}
# The seven numbers in Larin's text have no number, nor have Plotnikov's formulas; the book has
# names for them.
NAMED = {
    "larin": [
        *(f"sigma{i}* of the experiment" for i in range(1, 5)),
        *(f"sigma{i}** of the experiment" for i in range(1, 4)),
    ],
    "plotnikov": [
        "heading",
        "alignment heading",
        "alignment pitch",
        "alignment roll",
        "operating heading",
    ],
}


@cache
def notebook(name):
    return nbformat.read(ROOT / f"notebooks/{name}.ipynb", as_version=4)


@cache
def functions_in(path):
    """Names of the tests in a file, those of classes as Class::name."""
    tree = ast.parse((ROOT / path).read_text(encoding="utf-8"))
    return {node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)}


def test_every_number_of_every_paper_is_there_once():
    for paper in WORKS:
        labels = [entry.label for entry in ENTRIES if entry.paper == paper]
        assert labels, paper
        assert len(set(labels)) == len(labels), paper
        expected = NUMBERED.get(paper, []) + NAMED.get(paper, [])
        assert [label for label in expected if label not in labels] == [], paper


def test_entries_are_complete():
    for entry in ENTRIES:
        of = f"{entry.paper} {entry.label}"
        assert entry.paper in WORKS, of
        assert entry.kind in KINDS, of
        assert entry.status in STATUSES, of
        assert entry.says.endswith("."), of
        corrections = (entry.severity, entry.line, entry.copy, entry.right, entry.proof)
        corrected = entry.status == "corrected"
        assert not (corrected and entry.paper in PUBLISHERS), of  # ERRATA.md is of the four papers
        parts = all(corrections) if corrected else not any((*corrections, entry.in_favour))
        assert parts, of
        assert not corrected or entry.severity in SEVERITIES, of
        assert "`" not in entry.line, of
        for text in (entry.says, entry.remark, *corrections[2:], entry.in_favour):
            assert text.count("$") % 2 == 0, text


def test_entries_have_their_places_in_the_book():
    for entry in ENTRIES:
        headings = [
            heading
            for cell in notebook(entry.notebook).cells
            if cell.cell_type == "markdown"
            for heading in re.findall(r"^#+ (.*)$", cell.source, flags=re.MULTILINE)
        ]
        assert entry.section in headings, f"{entry.paper} {entry.label}"


def test_functions_and_tests_of_the_entries_exist():
    """Whatever holds in the book is computed and tested."""
    for entry in ENTRIES:
        if entry.kind != "claim" and entry.status != "not recoverable":
            assert entry.functions, f"{entry.paper} {entry.label}"
            assert entry.tests, f"{entry.paper} {entry.label}"
        for name in entry.functions:
            module, _, attribute = name.rpartition(".")
            assert hasattr(import_module(module), attribute), name
        for name in entry.tests:
            path, _, test = name.partition("::")
            if path.endswith(".ipynb"):
                name = path.removeprefix("notebooks/").removesuffix(".ipynb")
                (cell,) = (cell for cell in notebook(name).cells if cell.id == test)
                assert re.search(r"\bassert\b|\bidentity\(", cell.source), name
            else:
                assert test in functions_in(path), name


def test_errata_file_is_what_the_ledger_says():
    assert (ROOT / "ERRATA.md").read_text(encoding="utf-8") == errata()
    assert (ROOT / "docs/papers.md").read_text(encoding="utf-8") == papers_page()


def test_errata_hold_every_correction_and_nothing_else():
    corrected = [entry for entry in ENTRIES if entry.status == "corrected"]
    text = errata()
    headings = re.findall(r"^### (.*)$", text, flags=re.MULTILINE)
    slips = re.findall(r"^- \*\*.*, (.*)\.\*\* `", text, flags=re.MULTILINE)
    for found, severities in ((headings, list(SEVERITIES)[:-1]), (slips, ["typographical"])):
        assert found == [entry.label for entry in corrected if entry.severity in severities]
    for entry in corrected:
        assert f"`{entry.line}`" in text


def test_errata_say_first_what_was_read():
    head, *_ = errata().split("### ")
    for paper in PAPERS.values():
        assert f"- **{paper.authors}.** {paper.copy}" in head


def test_tables_have_a_row_for_each_entry():
    for paper in WORKS:
        rows = ledger.paper_table(paper).rows[1:]
        assert len(rows) == sum(entry.paper == paper for entry in ENTRIES)
    totals = [int(row[-1]) for row in ledger.summary_table().rows[1:]]
    assert sum(totals) == len(ENTRIES)


def test_table_is_markdown_with_as_many_cells_in_every_row():
    lines = ledger.Table([("a", "b"), ("$|x| + 1$", "c")])._repr_markdown_().splitlines()
    assert ledger.Table([("2 |x| $|y|$ |",)])._repr_markdown_().splitlines()[0] == (
        r"| 2 \|x\| $\vert y\vert $ \| |"
    )
    assert ledger.Table([(r"$\|x\|$",)])._repr_markdown_().splitlines()[0] == r"| $\Vert x\Vert $ |"
    assert lines == ["| a | b |", "| --- | --- |", r"| $\vert x\vert  + 1$ | c |"]


def test_unknown_paper_is_refused():
    with pytest.raises(ValueError, match=r"^paper: expected one of larin, .*, got 'Wu'\.$"):
        ledger.paper_table("Wu")


def test_no_verdict_is_passed_on_a_print_that_nobody_has_seen():
    files = [ROOT / "README.md", ROOT / "ERRATA.md", ROOT / "figures" / "README.md"]
    files += [*(ROOT / "docs").glob("*.md")]
    files += [*(ROOT / "notebooks").rglob("*.ipynb"), *(ROOT / "src").rglob("*.toml")]
    for path in files:
        text = path.read_text(encoding="utf-8")
        found = re.findall(r"\b(?:in print|as printed|misprint\w*)\b", text, flags=re.IGNORECASE)
        # Chapter 00 says that nobody has seen one of the papers in print.
        says_so = path == ROOT / "notebooks/00_start_here.ipynb"
        assert found == (["in print"] if says_so else []), path
