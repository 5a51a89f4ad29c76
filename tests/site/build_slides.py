"""Makes the slides of some chapters in a folder, of the last with its code, too.

``python build_slides.py FOLDER NOTEBOOK ...`` with the Python of the site.
"""

import sys
from pathlib import Path

import nbformat

sys.path.insert(0, str(Path(__file__).parents[2] / "site"))

from executed import KEPT
from slides.make import slides

folder = Path(sys.argv[1])
for name in sys.argv[2:]:
    notebook = nbformat.read(KEPT / name, as_version=4)
    for code in (False, True)[: 1 + (name == sys.argv[-1])]:
        target = folder / f"{Path(name).stem}{'-code' if code else ''}.html"
        target.write_text(slides(notebook, Path(name).stem, code), "utf-8")
