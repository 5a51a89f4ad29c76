"""The site names the licence of everything that it hands out."""

import json
import re
import tomllib
import zipfile
from email.parser import HeaderParser
from html.parser import HTMLParser

import pytest

from licences import KNOWN, LOCK, write_licences
from support import ROOT
from unfinished import Unfinished

WORDS = {
    "Apache-2.0": "Apache",
    "BSD-2-Clause": "BSD",
    "BSD-3-Clause": "BSD",
    "HPND": "HPND",
    "MIT": "MIT",
    "MPL-2.0": "Mozilla",
    "PSF-2.0": "PSF|Python Software Foundation",
}
"""How the metadata of wheels call a licence."""


class Rows(HTMLParser):
    """The cells of a page's tables, row by row."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.rows: list[list[str]] = []
        self.cell = False
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        if tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th"):
            self.rows[-1].append("")
        self.cell = self.cell or tag in ("td", "th")

    def handle_endtag(self, tag):
        self.cell = self.cell and tag not in ("td", "th")

    def handle_data(self, data):
        if self.cell:
            self.rows[-1][-1] += data


def test_every_package_of_the_live_book_is_there_with_its_version(site):
    rows = Rows((site / "licences.html").read_text("utf-8")).rows
    lock = json.loads((site / LOCK).read_text("utf-8"))["packages"]
    assert lock.keys() == KNOWN["packages"].keys()
    for name, entry in lock.items():
        assert [name, entry["version"], KNOWN["packages"][name]] in rows
    named = {row[0] for row in rows}
    assert named >= {"Pyodide", "MathJax", "Furo", "Libertinus Serif"}


def test_the_licences_are_those_that_packages_say_of_themselves(distribution):
    for path in distribution.glob("*.whl"):
        with zipfile.ZipFile(path) as files:
            (name,) = (n for n in files.namelist() if re.fullmatch(r"[^/]+dist-info/METADATA", n))
            about = HeaderParser().parsestr(files.read(name).decode("utf-8"))
        said = " ".join([*about.get_all("Classifier", []), about.get("License", "")])
        package = about["Name"].lower().replace("_", "-")
        licences = re.findall("|".join(map(re.escape, WORDS)), KNOWN["packages"][package])
        assert licences, package
        if "License ::" in said or about.get("License"):
            assert all(re.search(WORDS[each], said) for each in licences), package


def test_texts_are_there_in_full_and_the_first_page_leads_to_them(site):
    for name in KNOWN["pages"]:
        assert len((site / f"licences/{name}.txt").read_text("utf-8")) > 500, name
    assert "Apache License" in (site / "licences/MathJax.txt").read_text("utf-8")
    assert 'href="licences.html"' in (site / "index.html").read_text("utf-8")


def test_a_package_whose_licence_nobody_knows_ends_the_build(tmp_path, monkeypatch):
    lock = {"info": {"python": "3.12"}, "packages": {"new": {"version": "1"}}}
    (tmp_path / LOCK).parent.mkdir(parents=True)
    (tmp_path / LOCK).write_text(json.dumps(lock), "utf-8")
    monkeypatch.setattr("licences._pages", lambda made: [])  # of packages that only a build has
    with pytest.raises(Unfinished, match=r"^licences\.toml names no licence of new\.$"):
        write_licences(tmp_path)


def test_the_list_is_in_order():
    lists = tomllib.loads((ROOT / "site/licences.toml").read_text("utf-8"))
    assert list(lists["packages"]) == sorted(lists["packages"])
