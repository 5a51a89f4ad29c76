"""The runtime with the lock and the wheels that a browser takes from the site."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

from unfinished import Unfinished

from .brought import OFFICIAL, RUNTIME, Brought, digest_of
from .lock import entry_of, needed
from .own_wheels import compiled, driftlab_wheel, figures_wheel, fontlist_wheel, from_within
from .versions import VERSIONS


def make_packages(brought: Brought, build: Path, made: Path, distribution: Path | None) -> None:
    """Write the runtime, the lock and the wheels.

    With Pyodide's `distribution` the site holds all files; without it a browser fetches them from
    where Pyodide publishes them.
    """
    runtime = brought.runtime
    official = json.loads((runtime / OFFICIAL).read_text("utf-8"))
    packages = needed(official, VERSIONS["wheels"]["distribution"])
    python = official["info"]["python"].rpartition(".")[0]
    own = _own(build / "own", brought, packages["matplotlib"]["version"], python)

    shutil.rmtree(made, ignore_errors=True)
    made.mkdir(parents=True)
    for name in RUNTIME:
        shutil.copy(runtime / name, made)
    if distribution is None:
        address = VERSIONS["pyodide"]["distribution"]
        for entry in packages.values():
            entry["file_name"] = address + entry["file_name"]
    else:
        _bring_here(packages, distribution, runtime, build, made)
    for wheel in compiled(own, runtime, build):
        shutil.copy(wheel, made)
        name = wheel.name.partition("-")[0]
        depends = VERSIONS["wheels"]["driftlab"]["depends"] if name == "driftlab" else None
        entry = entry_of(wheel, depends)
        if entry["name"] in packages:
            raise Unfinished(f"{entry['name']} would be in the lock twice.")
        packages[entry["name"]] = entry
    lock = {"info": official["info"], "packages": dict(sorted(packages.items()))}
    (made / OFFICIAL).write_text(json.dumps(lock, indent=1), "utf-8")


def _own(folder: Path, brought: Brought, matplotlib: str, python: str) -> list[Path]:
    """Return the wheels that the site adds to the distribution, as they were before compiling."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    wheels = [
        driftlab_wheel(folder),
        figures_wheel(folder, python),
        fontlist_wheel(folder, matplotlib),
    ]
    wheels += [brought.wheels[name] for name in VERSIONS["wheels"]["book"]]
    kernel = brought.wheels["jupyterlite-pyodide-kernel"]
    wheels += [from_within(kernel, name, folder) for name in VERSIONS["wheels"]["kernel"]]
    names = VERSIONS["wheels"]["older"]["names"]
    return wheels + [from_within(brought.older, name, folder) for name in names]


def _bring_here(
    packages: dict[str, Any], distribution: Path, runtime: Path, build: Path, made: Path
) -> None:
    """Copy the files of the distribution, each checked and its Python compiled."""
    wheels = {}
    for name, entry in packages.items():
        path = distribution / entry["file_name"]
        if not path.is_file():
            raise Unfinished(f"{path.name} is missing in {distribution}.")
        if digest_of(path) != entry["sha256"]:
            raise Unfinished(f"{path} is not the file that Pyodide published.")
        if path.suffix == ".whl":
            wheels[path] = name
        else:
            shutil.copy(path, made)
    for wheel, name in zip(compiled(list(wheels), runtime, build), wheels.values(), strict=True):
        shutil.copy(wheel, made)
        packages[name]["sha256"] = digest_of(wheel)
