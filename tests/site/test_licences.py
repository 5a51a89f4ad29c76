"""The site names the licence of everything that it hands out."""

import html
import json
import re
import zipfile
from email.parser import HeaderParser

import pytest

from licences import KNOWN, LOCK, write_licences
from unfinished import Unfinished

pytestmark = pytest.mark.xdist_group("site")
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


def test_every_package_of_the_live_book_is_there_and_texts_are_in_full(site):
    page = (site / "licences.html").read_text("utf-8")
    rows = [
        [html.unescape(re.sub("<[^>]*>", "", cell)) for cell in re.findall(r"<td>(.*?)</td>", row)]
        for row in re.findall(r"<tr>(.*?)</tr>", page, re.S)
    ]
    lock = json.loads((site / LOCK).read_text("utf-8"))["packages"]
    assert lock.keys() == KNOWN["packages"].keys()
    for name, entry in lock.items():
        assert [name, entry["version"], KNOWN["packages"][name]] in rows
    assert {row[0] for row in rows if row} >= {"Pyodide", "MathJax", "Furo", "Libertinus Serif"}
    for name in KNOWN["pages"]:
        assert len((site / f"licences/{name}.txt").read_text("utf-8")) > 500, name
    assert "Apache License" in (site / "licences/MathJax.txt").read_text("utf-8")
    assert 'href="licences.html"' in (site / "index.html").read_text("utf-8")


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


def test_a_package_whose_licence_nobody_knows_ends_the_build(tmp_path, monkeypatch):
    lock = {"info": {"python": "3.12"}, "packages": {"new": {"version": "1"}}}
    (tmp_path / LOCK).parent.mkdir(parents=True)
    (tmp_path / LOCK).write_text(json.dumps(lock), "utf-8")
    monkeypatch.setattr("licences._pages", lambda made: [])  # of packages that only a build has
    with pytest.raises(Unfinished, match=r"^licences\.toml names no licence of new\.$"):
        write_licences(tmp_path)
