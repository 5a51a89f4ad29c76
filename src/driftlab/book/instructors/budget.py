"""How much of what strangers hand in is read: bounds that nobody's work comes near."""

from __future__ import annotations

from dataclasses import dataclass

MOST_FILES = 20_000
MOST_BYTES = 4 * 2**30
MOST_LISTED = 64 * 2**20
"""Of all that is read in a run, from the disk and from archives."""
MOST_FILES_OF_ONE = 5_000
MOST_BYTES_OF_ONE = 2**30
MOST_LISTED_OF_ONE = 4 * 2**20
"""Of an archive, so that one leaves something for the others."""
MOST_FILES_INSIDE = 2_000
MOST_BYTES_INSIDE = 256 * 2**20
MOST_LISTED_INSIDE = 2**20
"""Of an archive in an archive."""


@dataclass
class Budget:
    """How much may still be read; what is inside of another archive counts there as well."""

    files: int  # notebooks
    size: int  # their bytes
    # bytes of the lists with which archives end, where each entry takes 46 or more, whether it is
    # wanted or not
    listed: int
    what: str  # ends the sentence on what was not read
    outer: Budget | None = None

    def __post_init__(self) -> None:
        self.says = (
            f"It was not read, since no more than {self.size / 2**20:.0f} MB "
            f"in {self.files} files {self.what}."
        )

    def spend(self, size: int) -> str:
        """Take a file's size, or say why there is not enough."""
        if self.files < 1 or self.size < size:
            return self.says
        if self.outer and (trouble := self.outer.spend(size)):
            return trouble
        self.files, self.size = self.files - 1, self.size - size
        return ""

    def spend_list(self, size: int) -> bool:
        """Take the size of an archive's list, or return False if there is not enough."""
        if self.listed < size or (self.outer and not self.outer.spend_list(size)):
            return False
        self.listed -= size
        return True


def of_a_run() -> Budget:
    """What one report may read."""
    return Budget(MOST_FILES, MOST_BYTES, MOST_LISTED, "are read in one run")


def of_an_archive(outer: Budget) -> Budget:
    """What may be read of an archive on the disk."""
    what = "are unpacked of an archive"
    return Budget(MOST_FILES_OF_ONE, MOST_BYTES_OF_ONE, MOST_LISTED_OF_ONE, what, outer)


def of_an_inner_archive(outer: Budget) -> Budget:
    """What may be read of an archive in another."""
    what = "are unpacked of an archive in another"
    return Budget(MOST_FILES_INSIDE, MOST_BYTES_INSIDE, MOST_LISTED_INSIDE, what, outer)
