"""Makes the whole book live: JupyterLite with Pyodide and the book's own packages."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from pathlib import Path

from unfinished import Unfinished

from .brought import OFFICIAL, bring
from .lite import make_lite
from .packages import make_packages
from .versions import ROOT, VERSIONS

BUILD = ROOT / "build/site"
NODE = 18
"""The oldest Node that runs Pyodide."""
PROBE = "cycler"
"""A small package of the distribution, by which a page sees whether it can be reached."""


def reason_not(build: Path = BUILD) -> str:
    """Bring what the live book needs; return a sentence if it cannot be made here, else nothing."""
    node = shutil.which("node")
    if node is None:
        return "The site is not made: that needs Node.js, which is not installed."
    said = subprocess.run([node, "--version"], capture_output=True, encoding="utf-8").stdout
    number = re.match(r"v(\d+)", said)
    if number is None or int(number[1]) < NODE:
        return f"The site is not made: that needs Node.js {NODE}; this is {said.strip()}."
    try:
        bring(build / "live")
    except Unfinished as trouble:
        return f"The site is not made: {trouble}"
    return ""


def make_live(build: Path, made: Path, distribution: Path | None) -> None:
    """Write ``live`` into the folder of the site.

    With the files of Pyodide's `distribution` the site needs no network; without them readers fetch
    them from where Pyodide publishes them.
    """
    kept, live = build / "live", made / "live"
    brought = bring(kept)
    packages = kept / "packages"
    make_packages(brought, kept, packages, distribution)
    lock = json.loads((packages / OFFICIAL).read_text("utf-8"))
    probe = lock["packages"][PROBE]["file_name"]
    megabytes = sum(path.stat().st_size for path in packages.iterdir()) / 1e6
    about = {
        "megabytes": f"{megabytes + (0 if distribution else VERSIONS['pyodide']['megabytes']):.0f}",
        "probe": "" if distribution else probe,
    }
    extensions = [brought.wheels[name] for name in VERSIONS["kernel"]["extensions"]]
    shutil.rmtree(live, ignore_errors=True)
    make_lite(kept, live, extensions, about)
    shutil.move(packages, live / "static/pyodide")
