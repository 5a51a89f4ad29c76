"""The modules that are broken: all that calculate, by their names without "driftlab."."""

from pathlib import Path

from quietly import PACKAGE

_FOLDERS = (
    "", "core", "attitude", "drift", "motion", "calibration", "gyrocompass", "monte_carlo",
    "checks", "recordings",
)  # fmt: skip
# Numba keeps compiled kernels and would take those of the unbroken source. The others know of
# publishers, files and names, or carry runs to other processes, which would not see a break.
_APART = {
    "core._jit", "core._kernels", "core._filter_kernels", "compilation", "conftest",
    "monte_carlo.workers", "monte_carlo._kept_batches", "recordings.catalogue",
    "recordings.publishers", "checks._names", "checks._words",
}  # fmt: skip


def numerical_parts() -> list[str]:
    """Names of all modules that calculate."""
    names = [name for folder in _FOLDERS for name in _modules(folder)]
    return [name for name in names if name not in _APART]


def path_of(name: str) -> Path:
    """The file of a module."""
    return PACKAGE.joinpath(*name.split(".")).with_suffix(".py")


def _modules(folder: str) -> list[str]:
    head = f"{folder}." if folder else ""
    files = sorted((PACKAGE / folder).glob("*.py"))
    own = (path.stem for path in files if path.stem not in ("_extra", "_lazy"))
    return [f"{head}{stem}" for stem in own if not stem.startswith("__")]
