"""What versions.toml says, and the pins of the packages that it names."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any, NamedTuple

ROOT = Path(__file__).resolve().parent.parent.parent
PINS = ROOT / "environment.txt", ROOT / "site/packages.txt"
VERSIONS: dict[str, Any] = tomllib.loads(
    Path(__file__).with_name("versions.toml").read_text("utf-8")
)


class Pin(NamedTuple):
    """A package at its version, and the digests of the files that it may come as."""

    name: str
    version: str
    sha256: tuple[str, ...]


def pin(name: str) -> Pin:
    """Return how a package is pinned in the lists of the project."""
    for path in PINS:
        found = re.search(
            rf"^{name}==([^\s;]+).*\n((?:[ \t].*\n?)*)", path.read_text("utf-8"), re.M
        )
        if found:
            return Pin(name, found[1], tuple(re.findall(r"sha256:([0-9a-f]{64})", found[2])))
    raise LookupError(f"{name} is pinned neither in {' nor in '.join(p.name for p in PINS)}.")


def older() -> Pin:
    """Return the one package that only the live book has, in an older version."""
    table = VERSIONS["wheels"]["older"]
    name, _, version = table["within"].partition("==")
    return Pin(name, version, (table["sha256"],))


def wheel_pins() -> list[Pin]:
    """Return every package that is brought as a wheel, but for the older one."""
    names = {*VERSIONS["wheels"]["book"], *VERSIONS["kernel"]["extensions"]}
    return [pin(name) for name in sorted(names)]
