"""Makes the reading version: pages are written to build/site/source, Sphinx makes HTML of them.

A warning is an error.
"""

from __future__ import annotations

import re
import shutil
from importlib.resources import files
from pathlib import Path

from nbformat import NotebookNode
from sphinx.cmd.build import main as sphinx

from addresses import COMPANIONS, DOCS, PAGES, file_of
from reading.api_pages import api_pages
from reading.landing import script_of_landing, still_of_landing
from reading.links import with_links
from reading.notebook_pages import NotebookPages, notebook_pages
from reading.outputs import Outputs
from reading.overview import chapters_page, text_of
from reading.papers import ledger_pages
from reading.parts import chapters, contents, parts
from unfinished import Unfinished

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
GALLERY = "All figures of the book. The numbers behind a figure are in the CSV beside its caption."
SOLUTIONS = "Worked solutions of the exercises, chapter by chapter. Try an exercise first."
WHOLE_LINK = re.compile(r"\[([^\]]*)\]\((?!https?:)([^)#\s]+)[^)\s]*\)")
"""A link in Markdown to something of the project: its words and its file."""
MATHJAX = ("tex-chtml.js", "input/tex/extensions", "output/chtml/fonts")
"""What the pages need of MathJax, of the 40 MB that it has."""


def make_reading(
    notebooks: dict[str, NotebookNode], build: Path, made: Path, pdf_size: int
) -> None:
    """Make the pages; the first one says the size of the PDF, in bytes."""
    source = build / "source"
    trees = build / "doctrees"  # made anew: kept ones would still know where labels were
    for folder in (source, trees):
        shutil.rmtree(folder, ignore_errors=True)
    write_source(source, notebook_pages(notebooks, chapters(ROOT)), pdf_size)
    options = ["-W", "--keep-going", "-q", "-b", "html", "-d", str(trees)]
    if sphinx([*options, str(source), str(made)]):
        raise Unfinished("Sphinx warned; its messages above tell of what.")


def write_source(source: Path, book: NotebookPages, pdf_size: int) -> None:
    """Write what Sphinx reads."""
    shutil.copytree(HERE / "_static", source / "_static")
    for part in MATHJAX:
        _copy(
            Path(str(files("mathjax"))) / "static/mathjax/es5" / part,
            source / f"_static/mathjax/{part}",
        )
    for name in ("conf.py", "search_order.js"):
        shutil.copy(HERE / name, source)
    for name, text in (book.texts | pages(book, pdf_size)).items():
        path = source / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, "utf-8")
    (source / "_static/landing.js").write_text(script_of_landing(), "utf-8")
    book.pictures.write(source)
    for path in sorted((ROOT / "figures").glob("*.[cs][sv][vg]")):
        shutil.copy(path, source / "gallery")


def pages(book: NotebookPages, pdf_size: int) -> dict[str, str]:
    """Return the text of every page that is no notebook, by its file's name."""
    found = {f"{name}.rst": text for name, text in api_pages().items()}
    found |= {f"{name}.md": text for name, text in ledger_pages().items()}
    notation = text_of(ROOT, "19_ledger_and_glossary.ipynb", "## One notation", "## Read on")
    found["chapters.md"] = chapters_page(ROOT)
    found["glossary.md"] = f"# Notation and glossary\n\n{notation}"
    found["errata.md"] = (ROOT / "ERRATA.md").read_text("utf-8")
    found["gallery/index.md"] = _gallery()
    found["changes.md"] = (ROOT / "CHANGELOG.md").read_text("utf-8")
    found |= {f"{name}.md": docs_page(name) for name in DOCS}
    solved = sorted(Path(name).stem for name in book.texts if name.startswith("solutions/"))
    found["solutions/index.md"] = f"# Solutions\n\n{SOLUTIONS}\n{contents(solved)}"
    front = (HERE / "index.md").read_text("utf-8")
    front = front.replace("{landing}", still_of_landing(Outputs(book.pictures, "index", "")))
    found["index.md"] = front.replace("{size}", f"{pdf_size / 1e6:.0f} MB") + _contents()
    return found


def docs_page(name: str) -> str:
    """Return a page of docs; a link to a file that the site has not is its words alone."""
    page = f"../{name}.md"

    def kept(link: re.Match[str]) -> str:
        file = file_of(link[2], page)
        there = file in PAGES or file.startswith(("notebooks/", "figures/"))
        return link[0] if there else link[1]

    return with_links(WHOLE_LINK.sub(kept, (ROOT / f"{name}.md").read_text("utf-8")), page)


def _contents() -> str:
    """The contents of the whole site, part by part."""
    lists = {
        name: [f"{chapter.number} {chapter.name} <{chapter.page}>" for chapter in part]
        for name, part in parts(ROOT).items()
    }
    first = next(iter(lists))
    lists[first].insert(0, "chapters")
    lists["Using it"] = DOCS
    lists["The papers, read closely"] = COMPANIONS
    lists["Appendices"] = ["sensors", "i_want_to", "lab_sheet", "many_runs", "solutions/index"]
    lists["Appendices"] += ["for_instructors", "for_your_course"]
    lists["To look things up"] = ["reference/index", "conventions", "glossary", "ledger/index"]
    lists["To look things up"] += ["gallery/index", "bibliography", "errata", "changes"]
    return "".join(
        contents(names, ":hidden:", f':caption: "{caption}"') for caption, names in lists.items()
    )


def _gallery() -> str:
    """The list of figures, each with a name to link to, and a link to its numbers."""
    text = (ROOT / "figures/README.md").read_text("utf-8")

    def named(match: re.Match[str]) -> str:
        numbers = (
            f" [Numbers]({match[2]}.csv)." if (ROOT / f"figures/{match[2]}.csv").exists() else ""
        )
        return f"(figure-{match[2]})=\n{match[0]}{numbers}"

    text = re.sub(r"\n\n.*\n\n", f"\n\n{GALLERY}\n\n", text, count=1)
    # The text for who cannot see the picture is its caption, which stands below it.
    text = re.sub(r"^!\[[^\n]*\]\((\S+)\.svg\)$", r"![\1](\1.svg)", text, flags=re.M)
    return re.sub(r"^(\*\*(\S+)\.\*\*.*)$", named, text, flags=re.M)


def _copy(source: Path, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    if source.is_dir():
        shutil.copytree(source, target)
    else:
        shutil.copy(source, target)
