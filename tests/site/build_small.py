"""Builds a small site in a folder, as site/build.py does: a notebook, first page and gallery.

``python build_small.py FOLDER`` with the Python of the site. What they link to is not there.
"""

import sys
from pathlib import Path

import nbformat

sys.path.insert(0, str(Path(__file__).parents[2] / "site"))

import build
from executed import KEPT
from reading import extension, make

NAME = "03_systematic_drift.ipynb"
folder = Path(sys.argv[1])
all_pages, sphinx = make.pages, make.sphinx
build.BUILD = folder / "build"
build.executed = lambda wanted: {NAME: nbformat.read(KEPT / NAME, as_version=4)}
build.BUILD.mkdir()
build.make_pdf = lambda _notebooks, _build, pdf: pdf.write_bytes(b"")
FEW = ("index.md", "gallery/index.md")  # from the second comes the picture of the first
make.pages = lambda *given: {name: all_pages(*given)[name] for name in FEW}
extension.add_aliases = lambda *_: None  # of the reference, which is left out
make.sphinx = lambda options: sphinx([each for each in options if each != "-W"])
build.make_site(folder / "made", None)
