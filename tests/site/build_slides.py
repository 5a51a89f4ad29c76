"""Makes the slides of some chapters in a folder, with and without code.

``python build_slides.py FOLDER NOTEBOOK ...`` with the Python of the site.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "site"))

from executed import executed
from slides.make import slides

folder = Path(sys.argv[1])
for name, notebook in executed(sys.argv[2:]).items():
    for code in (False, True):
        target = folder / f"{Path(name).stem}{'-code' if code else ''}.html"
        target.write_text(slides(notebook, Path(name).stem, code), "utf-8")
