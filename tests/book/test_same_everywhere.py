"""Figures and printed tables are the same wherever they are made: byte for byte on one processor.

Of what others have around them, Python reads the locale (decimal commas, capital letters, what a
file's letters are), the time zone, a seed for the order of sets, and how many threads may share a
product of matrices. `python3 lab.py figures --compare` asks for all figures.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

# One of each chapter that computes, of those that take half a second at most.
CHOSEN = (
    "01-error-motion",
    "02-roots",
    "03-drift-map",
    "04-larin-digits",
    "05-cayley-map",
    "06-coning-area",
    "07-plane-split",
    "09-alignment-terms",
    "10-operating-formula",
)
AROUND = {
    "Turkish": ("tr_TR", "UTF-8", {"TZ": "Asia/Kathmandu", "PYTHONHASHSEED": "7"}),
    "Russian": ("ru_RU", "KOI8-R", {"OPENBLAS_NUM_THREADS": "2", "PYTHONUTF8": "0"}),
    "Chinese": ("zh_CN", "GBK", {"TZ": "Pacific/Chatham", "PYTHONUTF8": "0"}),
}
WRITE = """
import locale, sys
from pathlib import Path
locale.setlocale(locale.LC_ALL, "")
from driftlab.book.__main__ import write_gallery
from driftlab.book.figures import figure_definitions
every = figure_definitions()
write_gallery(Path(sys.argv[1]), {name: every[name] for name in sys.argv[2:]})
"""


def made(folder: Path, around: dict[str, str]) -> dict[str, bytes]:
    """Write the figures in a process of its own; return its files, and what it printed."""
    kept = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("LC_", "LANG", "TZ", "PYTHON", "OPENBLAS"))
    }
    run = subprocess.run(
        [sys.executable, "-X", "warn_default_encoding", "-c", WRITE, str(folder), *CHOSEN],
        env=kept | {"OPENBLAS_NUM_THREADS": "1"} | around,
        capture_output=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr.decode(errors="replace")
    # An encoding that nobody chose is the reader's; the package chooses its own.
    said = run.stderr.decode(errors="replace")
    assert not re.search(r"driftlab\S*: EncodingWarning", said), said
    printed = run.stdout.decode("ascii").replace(str(folder), "")
    return {"printed": printed.encode()} | {
        path.name: path.read_bytes() for path in folder.iterdir()
    }


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """What is made with nothing around."""
    around = {"LC_ALL": "C", "TZ": "UTC0", "PYTHONHASHSEED": "0"}
    return made(tmp_path_factory.mktemp("plain") / "figures", around)


@pytest.mark.parametrize("place", AROUND)
def test_figures_and_printed_tables_are_the_same(
    place: str, plain: dict[str, bytes], tmp_path: Path
) -> None:
    name, letters, around = AROUND[place]
    if (localedef := shutil.which("localedef")) is None:
        pytest.skip("This computer makes no locales.")
    locales = tmp_path / "locales"
    locales.mkdir()
    command = [localedef, "-i", name, "-f", letters, str(locales / f"{name}.{letters}")]
    if subprocess.run(command, capture_output=True, check=False).returncode > 1:
        pytest.skip(f"This computer does not know the locale {name}.")
    here = {"LOCPATH": str(locales), "LC_ALL": f"{name}.{letters}"}
    found = made(tmp_path / "figures", around | here)
    assert sorted(found) == sorted(plain)
    assert [each for each, words in found.items() if words != plain[each]] == []
