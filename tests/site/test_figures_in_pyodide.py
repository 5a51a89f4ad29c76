"""The numbers behind the figures, as a browser's Python computes them, are the published ones."""

import json
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from driftlab.book.figures import figure_definitions
from driftlab.book.machinery.figure.csv_table import read_table
from support import ROOT

pytestmark = [pytest.mark.kernel, pytest.mark.xdist_group("site-pyodide")]
CLOSE = 1e-9
"""Of the largest number of a column, in most figures."""
LOOSER = {
    # Small differences of large numbers, where the last digits of sin, exp and sums are seen.
    "07-equivalent-start": 1e-7,
    "08-calibration-errors": 1e-8,
    "08-in-place": 1e-8,
    "09-two-positions": 1e-8,
    "10-ballistic-error": 1e-6,
    "10-operating-formula": 1e-7,
    "11-capstone": 1e-7,
}
ROUNDING = 1e-12
"""What is smaller is rounding itself, in whatever units; a logarithmic axis may leave it out."""


@pytest.fixture(scope="module")
def computed(site, tmp_path_factory) -> dict:
    """Tables of all figures that need neither a recording nor minutes, by name."""
    folder, node = os.environ.get("DRIFTLAB_PYODIDE"), shutil.which("node")
    if not folder or not node:
        pytest.skip("needs Node, and DRIFTLAB_PYODIDE with Pyodide's distribution")
    here = tmp_path_factory.mktemp("pyodide")
    for place in (Path(folder), site / "live/static/pyodide"):
        for path in place.iterdir():
            (here / path.name).unlink(missing_ok=True)
            (here / path.name).symlink_to(path)
    lock = json.loads((here / "pyodide-lock.json").read_text("utf-8"))
    for each in lock["packages"].values():
        each["file_name"] = each["file_name"].rpartition("/")[2]
    (here / "pyodide-lock.json").unlink()
    (here / "pyodide-lock.json").write_text(json.dumps(lock), "utf-8")
    script = Path(__file__).with_name("figures_in_pyodide.mjs")
    done = subprocess.run([node, script, here], capture_output=True, encoding="utf-8")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_no_figure_is_left_out(computed):
    assert len(computed) > 40
    assert LOOSER.keys() <= computed.keys()


@pytest.mark.parametrize(
    "name",
    [name for name, each in figure_definitions().items() if each.columns and not each.is_kept],
)
def test_a_browser_computes_the_published_numbers(name, computed):
    published = read_table(ROOT / f"figures/{name}.csv")[1]
    assert list(computed[name]) == list(published)
    for column, words in published.items():
        try:
            there, here = (
                np.array([float(word or 0) for word in each])
                for each in (words, computed[name][column])
            )
        except ValueError:
            assert computed[name][column] == words
            continue
        least = max(ROUNDING, LOOSER.get(name, CLOSE) * np.max(np.abs(there), initial=0.0))
        np.testing.assert_allclose(here, there, 0, least, err_msg=column)
