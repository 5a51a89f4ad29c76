"""The live book's own pyodide-lock.json: which packages a browser loads, from where, in what order.

It begins as the official lock of the runtime, of which it keeps what the book needs; the site's own
wheels come to it. Nothing is resolved in the browser.
"""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterable, Sequence
from email.parser import HeaderParser
from pathlib import Path
from typing import Any

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from .brought import digest_of

Lock = dict[str, Any]
BROWSER = {
    "extra": "",
    "implementation_name": "cpython",
    "os_name": "posix",
    "platform_machine": "wasm32",
    "platform_python_implementation": "CPython",
    "platform_system": "Emscripten",
    "sys_platform": "emscripten",
}
"""What markers in the metadata of wheels ask for."""


def needed(official: Lock, wanted: Iterable[str]) -> dict[str, Any]:
    """Return the entries of some packages of the distribution, and of all they depend on."""
    packages = {canonicalize_name(name): entry for name, entry in official["packages"].items()}
    found: dict[str, Any] = {}
    waiting = list(wanted)
    while waiting:
        name = canonicalize_name(waiting.pop())
        if name not in found:
            found[name] = packages[name]
            waiting += packages[name]["depends"]
    return dict(sorted(found.items()))


def entry_of(wheel: Path, depends: Sequence[str] | None = None) -> dict[str, Any]:
    """Return the entry of one of the site's own wheels.

    `depends` is loaded before it; if not given, what the wheel's metadata say.
    """
    name, version = wheel.name.split("-")[:2]
    if depends is None:
        depends = [need.name for need in requirements(wheel)]
    return {
        "name": canonicalize_name(name),
        "version": version,
        "file_name": wheel.name,
        "install_dir": "site",
        "sha256": digest_of(wheel),
        "package_type": "package",
        "imports": _modules(wheel),
        "depends": sorted(canonicalize_name(name) for name in depends),
        "unvendored_tests": False,
    }


def requirements(wheel: Path, python: str = "3.12.7") -> list[Requirement]:
    """Return what the metadata of a wheel ask for in a browser."""
    with zipfile.ZipFile(wheel) as files:
        (name,) = (n for n in files.namelist() if re.fullmatch(r"[^/]+\.dist-info/METADATA", n))
        metadata = HeaderParser().parsestr(files.read(name).decode("utf-8"))
    needs = map(Requirement, metadata.get_all("Requires-Dist") or [])
    where = {**BROWSER, "python_full_version": python, "python_version": python.rpartition(".")[0]}
    return [need for need in needs if need.marker is None or need.marker.evaluate(where)]


def _modules(wheel: Path) -> list[str]:
    with zipfile.ZipFile(wheel) as files:
        tops = {name.split("/")[0] for name in files.namelist() if name.endswith((".py", ".pyc"))}
    return sorted({top.partition(".")[0] for top in tops})
