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

from driftlab.book.__main__ import write_gallery
from driftlab.book.figures import figure_definitions

# One of each chapter that computes, of those that take half a second at most.
CHOSEN = (
    "01-error-motion",
    "02-roots",
    "03-drift-map",
    "04-larin-digits",
    "06-cayley-map",
    "07-coning-area",
    "10-plane-split",
    "13-alignment-terms",
    "14-operating-formula",
)
AROUND = {
    "TZ": "Asia/Kathmandu",
    "PYTHONHASHSEED": "7",
    "PYTHONUTF8": "0",
    "OPENBLAS_NUM_THREADS": "2",
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


def turkish(folder: Path) -> dict[str, str]:
    """Where there are decimal commas, an alphabet of its own, and its letters in one byte each."""
    if (localedef := shutil.which("localedef")) is None:
        pytest.skip("This computer makes no locales.")
    name = "tr_TR.ISO-8859-9"
    command = [localedef, "-i", "tr_TR", "-f", "ISO-8859-9", str(folder / name)]
    if subprocess.run(command, capture_output=True, check=False).returncode > 1:
        pytest.skip("This computer does not know the Turkish locale.")
    return {"LOCPATH": str(folder), "LC_ALL": name}


@pytest.mark.slow
def test_figures_and_printed_tables_are_the_same(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """In a process of its own with all that around, and in this one."""
    here, there = tmp_path / "here", tmp_path / "there"
    kept = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("LC_", "LANG", "TZ", "PYTHON", "OPENBLAS"))
    }
    run = subprocess.run(
        [sys.executable, "-X", "warn_default_encoding", "-c", WRITE, str(there), *CHOSEN],
        env=kept | AROUND | turkish(tmp_path),
        capture_output=True,
        check=False,
    )
    said = run.stderr.decode(errors="replace")
    assert run.returncode == 0, said
    # An encoding that nobody chose is the reader's; the package chooses its own.
    assert not re.search(r"driftlab\S*: EncodingWarning", said), said
    every = figure_definitions()
    write_gallery(here, {name: every[name] for name in CHOSEN})
    printed = capsys.readouterr().out.replace(str(here), "")
    assert run.stdout.decode("ascii").replace(str(there), "") == printed
    found, plain = ({each.name: each.read_bytes() for each in f.iterdir()} for f in (there, here))
    assert sorted(found) == sorted(plain)
    assert [each for each, words in found.items() if words != plain[each]] == []
