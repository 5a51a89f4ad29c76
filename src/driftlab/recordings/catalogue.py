"""Which published recordings the book uses: from whom, which licence, and exactly which files."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class PublishedSet:
    """A recording that somebody has published, and under which conditions.

    Attributes
    ----------
    name : str
        As `published` takes it.
    title, description : str
        What it is, in a few words and in a few sentences.
    authors : str
        Whom to name where it is shown.
    licence, licence_stated : str
        SPDX identifier, and where and how the publisher says it.
    repository, commit : str
        On GitHub, and the commit that the files are taken from.
    files : dict
        The sha256 of each file under its path in the repository.
    publication : str
        The paper or program that it was published with.
    """

    name: str
    title: str
    description: str
    authors: str
    licence: str
    licence_stated: str
    repository: str
    commit: str
    files: dict[str, str]
    publication: str

    @property
    def source(self) -> str:
        """Authors and repository, as a caption would name them."""
        return f"{self.authors}: github.com/{self.repository} at {self.commit[:12]}"


_FILE = Path(__file__).with_name("published.toml")
PUBLISHED = {
    one["name"]: PublishedSet(**publisher, **one)
    for publisher in tomllib.loads(_FILE.read_text(encoding="utf-8"))["publisher"]
    for one in publisher.pop("sets")
}
"""Every published recording that the book uses, under its name."""
