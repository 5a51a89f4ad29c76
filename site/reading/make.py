"""Makes the reading version: pages are written to build/site/source, Sphinx makes HTML of them.

A warning is an error, and so is anything that a page would fetch from elsewhere.
"""

from __future__ import annotations

import json
import re
import shutil
from importlib.resources import files
from pathlib import Path

from nbformat import NotebookNode
from sphinx.cmd.build import main as sphinx

from reading.api_pages import api_pages
from reading.chapter_pages import chapters_page, text_of, with_links
from reading.papers import ledger_pages
from requests_of import requests_of

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
TASKS = "i_want_to.ipynb"
GALLERY = "All figures of the book. The numbers behind a figure are in the CSV beside its caption."
MATHJAX = ("tex-chtml.js", "input/tex/extensions", "output/chtml/fonts")
"""What the pages need of MathJax, of the 40 MB that it has."""


class Unfinished(Exception):
    """The site cannot be made; the sentence says why."""


def make_reading(notebooks: dict[str, NotebookNode], build: Path, made: Path) -> None:
    """Make the pages.

    Parameters
    ----------
    notebooks : dict of str to NotebookNode
        The book with its outputs, as `executed.executed` returns it.
    build : Path
        Folder for what is needed on the way.
    made : Path
        Folder for the pages, which is not there yet.

    Raises
    ------
    Unfinished
        If Sphinx warns, or a page would fetch something from elsewhere.
    """
    source = build / "source"
    shutil.rmtree(source, ignore_errors=True)
    write_source(source)
    options = ["-W", "--keep-going", "-q", "-b", "html", "-d", str(build / "doctrees")]
    if sphinx([*options, str(source), str(made)]):
        raise Unfinished("Sphinx warned; its messages above tell of what.")
    if elsewhere := requests_of(made):
        raise Unfinished("\n  ".join(["Pages would fetch from elsewhere:", *elsewhere]))


def write_source(source: Path) -> None:
    """Write what Sphinx reads."""
    shutil.copytree(HERE / "_static", source / "_static")
    for part in MATHJAX:
        _copy(
            Path(str(files("mathjax"))) / "static/mathjax/es5" / part,
            source / f"_static/mathjax/{part}",
        )
    for name in ("conf.py", "search_order.js"):
        shutil.copy(HERE / name, source)
    for name, text in pages().items():
        path = source / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, "utf-8")
    for path in sorted((ROOT / "figures").glob("*.[cs][sv][vg]")):
        shutil.copy(path, source / "gallery")


def pages() -> dict[str, str]:
    """Return the text of every page by its file's name."""
    found = {f"{name}.rst": text for name, text in api_pages().items()}
    found |= {f"{name}.md": text for name, text in ledger_pages().items()}
    notation = text_of(
        ROOT, "12_ledger_and_glossary.ipynb", "## One notation", "## What the book cites"
    )
    found["chapters.md"] = chapters_page(ROOT)
    found["glossary.md"] = f"# Notation and glossary\n\n{notation}"
    found["conventions.md"] = text_of(ROOT, "conventions.ipynb")
    found["errata.md"] = (ROOT / "ERRATA.md").read_text("utf-8")
    found["gallery/index.md"] = _gallery()
    if (ROOT / "CHANGELOG.md").exists():
        found["changes.md"] = (ROOT / "CHANGELOG.md").read_text("utf-8")
    if (ROOT / "notebooks" / TASKS).exists():
        found[TASKS] = _tasks()
    front = ["reference/index", "ledger/index", "chapters", "glossary", "conventions"]
    front += ["gallery/index", "errata"]
    if TASKS in found:
        front.insert(0, Path(TASKS).stem)
    if "changes.md" in found:
        front.append("changes")
    contents = ["```{toctree}", ":hidden:", "", *front, "```", ""]
    found["index.md"] = (HERE / "index.md").read_text("utf-8") + "\n".join(contents)
    return found


def _gallery() -> str:
    """The list of figures, each with a link to its numbers and a name to link to."""
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


def _tasks() -> str:
    """The notebook of tasks with its links led to the site's pages; Sphinx runs it."""
    notebook = json.loads((ROOT / "notebooks" / TASKS).read_text("utf-8"))
    for cell in notebook["cells"]:
        if cell["cell_type"] == "markdown":
            cell["source"] = with_links("".join(cell["source"]))
    return json.dumps(notebook)


def _copy(source: Path, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    if source.is_dir():
        shutil.copytree(source, target)
    else:
        shutil.copy(source, target)
