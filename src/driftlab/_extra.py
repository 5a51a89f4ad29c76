"""One sentence for who installed the library alone and asks for a part that needs more."""

from importlib.util import find_spec


def require_extra(part: str, *packages: str) -> None:
    """Raise `ModuleNotFoundError` if packages of the extra "book" that `part` needs are missing."""
    missing = [package for package in packages if find_spec(package) is None]
    if missing:
        raise ModuleNotFoundError(
            f"{part} needs {', '.join(missing)}, not installed here: "
            "pip install driftlab[book] brings all that the book needs.",
            name=missing[0],
        )
