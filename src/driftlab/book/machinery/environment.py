"""Is this notebook running where it should? Says what is wrong in words."""

import platform
import sys
from importlib import metadata

from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet

ADVICE = (
    "Start the book with 'python3 lab.py', which sets everything up, or install what is missing "
    "with 'pip install -e .[book]' in the book's folder; then restart the kernel."
)
IN_A_BROWSER = (
    "Here the site brings all packages, so reload the page; if that does not help, the site itself "
    "lacks them."
)


def problems(package: str = "driftlab") -> list[str]:
    """Return one sentence for each thing that is wrong; an empty list if all is well.

    What is needed is what the installed `package` says of itself and of its extra "book", hence
    what pyproject.toml says.
    """
    try:
        about = metadata.metadata(package)
    except metadata.PackageNotFoundError:
        return [f"The package {package} is not installed."]
    found = []
    python = SpecifierSet(about["Requires-Python"] or "")
    if platform.python_version() not in python:
        found.append(f"Python {python} is needed; this is {platform.python_version()}.")
    for need in _needs(package):
        try:
            version = metadata.version(need.name)
        except metadata.PackageNotFoundError:
            found.append(f"{need.name} is not installed; {need.name}{need.specifier} is needed.")
            continue
        if not need.specifier.contains(version, prereleases=True):
            found.append(
                f"{need.name} {version} is installed; {need.name}{need.specifier} is needed."
            )
    return found


def report(package: str = "driftlab") -> str:
    """Return the verdict as text: versions if all is well, else what is wrong and what to do."""
    found = problems(package)
    if found:
        advice = IN_A_BROWSER if sys.platform == "emscripten" else ADVICE
        return "\n".join(
            ["This environment will not do.", *(f"- {line}" for line in found), advice]
        )
    versions = (f"{need.name} {metadata.version(need.name)}" for need in _needs(package))
    return f"All is well: Python {platform.python_version()}, {', '.join(versions)}."


def _needs(package: str) -> list[Requirement]:
    needs = map(Requirement, metadata.requires(package) or [])
    book = {"extra": "book", "sys_platform": sys.platform}
    return [need for need in needs if need.marker is None or need.marker.evaluate(book)]
