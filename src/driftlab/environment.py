"""Is this notebook running where it should? Says what is wrong in words."""

import platform
import sys
from importlib import metadata

NEEDED = {
    "numpy": "2.0",
    "scipy": "1.14",
    "matplotlib": "3.9",
    "jupyterlab": "4.4",
    "ipywidgets": "8.1",
    "sympy": "1.13",
}
"""The packages the book runs on, with the oldest version each may have; as in pyproject.toml."""

ADVICE = (
    "Start the book with 'python3 lab.py', which sets everything up, or install what is "
    "missing with 'pip install -r environment.txt -e .' and restart the kernel."
)


def problems() -> list[str]:
    """Return one sentence for each thing that is wrong; an empty list if all is well."""
    found = []
    if sys.version_info < (3, 11):
        found.append(f"Python 3.11 or newer is needed; this is {platform.python_version()}.")
    for package, oldest in NEEDED.items():
        try:
            version = metadata.version(package)
        except metadata.PackageNotFoundError:
            found.append(f"{package} is not installed.")
            continue
        if _release(version) < _release(oldest):
            found.append(f"{package} {version} is too old; {oldest} or newer is needed.")
        if package == "ipywidgets" and version == "8.1.9":
            found.append("ipywidgets 8.1.9 draws nothing in VS Code; 8.1.8 does.")
    return found


def report() -> str:
    """Return the verdict as text: versions if all is well, otherwise what is wrong and what to do."""
    found = problems()
    if found:
        return "\n".join(
            ["This environment will not do:", *(f"- {line}" for line in found), ADVICE]
        )
    versions = ", ".join(f"{package} {metadata.version(package)}" for package in NEEDED)
    return f"All is well: Python {platform.python_version()}, {versions}."


def _release(version: str) -> tuple[int, ...]:
    """The first two numbers of a version, which is all that `NEEDED` compares."""
    return tuple(int(part) for part in version.split(".")[:2])
