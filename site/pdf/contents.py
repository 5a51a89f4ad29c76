"""What the book on paper holds, and in which order."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import PurePosixPath
from typing import NamedTuple

ERRATA = "ERRATA.md"

OF_EVERY_CHAPTER = (
    "A puzzle",
    "Guessed? Then compute it",
    "What you will be able to do",
    "Reproduce",
    "Read on",
)
"""Headings that the table of contents leaves out; the bookmarks have them."""


class Part(NamedTuple):
    """Some chapters under one heading."""

    title: str  # the heading
    source: str  # the paper that the chapters follow
    beginnings: tuple[str, ...]  # how the names of its documents begin, in their order


PARTS = (
    Part("Before you start", "", ("00_",)),
    Part(
        "Part I: A misaligned triad",
        "V. B. Larin, On the calibration of a spatial angular-rate meter, received 1987",
        ("01_", "02_", "03_", "04_", "05_"),
    ),
    Part(
        "Part II: Attitude from gyros",
        "S. E. Perelyaev, Yu. N. Chelnokov, New algorithms for determining the inertial "
        "orientation of an object, 2014",
        ("06_", "07_", "08_"),
    ),
    Part(
        "Part III: A whole inertial unit",
        "Wu Huali, Xiao Zhicai, Zhou Dawang, Wang Lingling, on decoupling installation-error "
        "matrices, 2018",
        ("09_", "10_", "11_", "12_"),
    ),
    Part(
        "Part IV: Finding North",
        "P. K. Plotnikov, A. V. Mikheev, S. G. Naumov, Errors of a strapdown gyrocompass for "
        "objects with unlimited rotation angles",
        ("13_", "14_", "15_", "16_", "17_"),
    ),
    Part("Aside", "", ("18_", "19_")),
    Part("The papers, read closely", "", ("papers/",)),
    Part(
        "Appendices",
        "",
        (
            "sensors",
            "conventions",
            "i_want_to",
            "lab_sheet",
            "many_runs",
            "bibliography",
            "for_instructors",
            "for_your_course",
            "solutions/",
            ERRATA,
        ),
    ),
)

OUTSIDE = Part("For instructors", "", ("instructors/",))
"""What the book does not hold, but can be printed alone."""


def chosen(part: Part, names: Iterable[str]) -> list[str]:
    """Return the names of a part's documents, in its order."""
    known = sorted(names)
    return [name for begin in part.beginnings for name in known if name.startswith(begin)]


def part_of(name: str) -> Part:
    """Return the part that a document stands in."""
    return next((part for part in PARTS if name.startswith(part.beginnings)), OUTSIDE)


def goes_on(name: str) -> bool:
    """Whether a document may begin in the middle of a page: the solutions after the first."""
    return name.startswith("solutions/") and not name.startswith("solutions/01_")


def label(name: str) -> str:
    """Return what a document is called inside the PDF, "solutions-03_systematic_drift"."""
    return PurePosixPath(name).with_suffix("").as_posix().replace("/", "-")


def figure_prefix(name: str) -> str:
    """Return what stands before the numbers of a document's figures: 3, S3 for solutions, A."""
    number = PurePosixPath(name).name[:2]
    if not number.isdigit():
        return {"conventions.ipynb": "C", "lab_sheet.ipynb": "L"}.get(name, "A")
    return f"{'S' if name.startswith('solutions/') else ''}{int(number)}"


def is_listed(name: str, level: int, heading: str) -> bool:
    """Whether the table of contents names a heading of a document."""
    is_an_exercise = heading[0].isdigit() and level > 1
    return level == 1 or not (
        name.startswith(("solutions/", ERRATA))
        or is_an_exercise
        or heading in OF_EVERY_CHAPTER
        or level > 3
    )
