"""Makes slides that stand alone: ``python3 lab.py slides 03`` runs this with the site's tools.

One file a chapter in _slides, with reveal.js, MathJax, pictures and the lecturer's notes in it.
"""

from __future__ import annotations

import argparse
import sys
from importlib.resources import files
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # run as a script, too

from nbconvert.exporters import SlidesExporter
from nbformat import NotebookNode

from executed import executed, notebooks
from licences import licence_texts
from slides.cells import on_slides
from slides.written import written_slides

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SLIDES = ROOT / "_slides"
NO_SLIDES = "19"
"""The chapter that is for looking up."""


def main(arguments: list[str]) -> int:
    """Make the slides of some chapters; the exit code."""
    parser = argparse.ArgumentParser(prog="lab.py slides", usage="python3 lab.py help slides")
    parser.add_argument("chapters", nargs="*")
    parser.add_argument("--code", action="store_true")
    options = parser.parse_args(arguments)
    there = chapters()
    unknown = [each for each in options.chapters if each not in there]
    if unknown:
        print(f"No slides for {', '.join(unknown)}; there are {', '.join(there)}.", file=sys.stderr)
        return 1
    SLIDES.mkdir(exist_ok=True)
    wanted = [there[each] for each in options.chapters or there]
    for name, notebook in executed(wanted).items():
        target = (SLIDES / name).with_suffix(".html")
        target.write_text(slides(notebook, Path(name).stem, options.code), "utf-8")
        print(f"Ready: {target.relative_to(ROOT)}")
    return 0


def chapters() -> dict[str, str]:
    """Return the names of the notebooks that have slides, by the number of the chapter."""
    numbered = {name[:2]: name for name in notebooks() if name[:2].isdigit()}
    return {number: name for number, name in numbered.items() if number != NO_SLIDES}


def slides(notebook: NotebookNode, name: str, code: bool = False) -> str:
    """Return the slides of a chapter as HTML that asks for nothing else."""
    exporter = SlidesExporter(  # type: ignore[no-untyped-call]
        template_name="lecture", extra_template_basedirs=[str(HERE)], exclude_anchor_links=True
    )
    chosen = None if code else written_slides(notebook, name[:2])
    exporter.environment.globals["lecture"] = _parts(name, code, written=chosen is not None)
    body, _ = exporter.from_notebook_node(chosen or on_slides(notebook))
    return str(body)


def _parts(name: str, code: bool, written: bool) -> dict[str, object]:
    """What the file holds beside the chapter."""
    reveal = Path(str(files("sphinx_revealjs"))) / "_static/revealjs"
    mathjax = Path(str(files("mathjax"))) / "static/mathjax/es5/tex-svg-full.js"
    scripts = [mathjax, reveal / "dist/reveal.js", reveal / "plugin/notes/notes.js"]
    return {
        "title": name.replace("_", " "),
        "code": code,
        "written": written,
        "reveal_css": (reveal / "dist/reveal.css").read_text("utf-8"),
        "css": (HERE / "slides.css").read_text("utf-8"),
        "scripts": [_inlined(path) for path in (*scripts, HERE / "pages.js")],
        "licences": "\n\n".join(map(licence_texts, ("django-static-mathjax", "sphinx-revealjs"))),
    }


def _inlined(path: Path) -> str:
    """A script as it may stand in a page: an end that it quotes does not end it."""
    return path.read_text("utf-8").replace("</script", "<\\/script").replace("<!--", "<\\!--")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
