"""What must agree about a version: release.toml and what is written from it, changes, papers."""

import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml

import driftlab
from driftlab.book.references import all_references
from support import ROOT

RELEASE = tomllib.loads((ROOT / "release/release.toml").read_text("utf-8"))
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
WRITTEN = ("CITATION.cff", "CITATION.bib", "release/recipe.yaml", "pyproject.toml")
ADDRESS = "https://example.org/drift-lab"
SHA256 = "0123456789abcdef" * 4
FILLED = {
    'doi = ""': 'doi = "10.5281/zenodo.1"',
    'Homepage = ""': f'Homepage = "{ADDRESS}"',
    'Issues = ""': f'Issues = "{ADDRESS}/issues"',
    '[sdist]  # what conda builds from, once it lies on an index\nurl = ""': (
        f'[sdist]\nurl = "{ADDRESS}.tar.gz"'
    ),
    'sha256 = ""': f'sha256 = "{SHA256}"',
}
ENTRY = re.compile(r"^@(\w+)\{([\w-]+),\n(.*?)^\}", re.DOTALL | re.MULTILINE)


def text(name: str) -> str:
    return (ROOT / name).read_text("utf-8")


def entries(bibliography: str) -> dict[str, dict[str, str]]:
    """Fields of the entries of a BibTeX file, by key."""
    found = {}
    for _, key, fields in ENTRY.findall(bibliography):
        lines = [line.strip().rstrip(",").partition("=") for line in fields.splitlines()]
        found[key] = {name.strip(): value.strip()[1:-1] for name, _, value in lines}
    return found


@pytest.fixture
def copied(tmp_path: Path) -> Path:
    """The part of the project that a release is written in."""
    shutil.copytree(
        ROOT / "bootstrap", tmp_path / "bootstrap", ignore=shutil.ignore_patterns("__pycache__")
    )
    read = ("lab.py", "release/release.toml", "release/write.py", "src/driftlab/__init__.py")
    for name in (*read, *WRITTEN):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / name, tmp_path / name)
    return tmp_path


def release(folder: Path, changes: dict[str, str]) -> subprocess.CompletedProcess[str]:
    """Run "lab.py release" after changes in release.toml."""
    file = folder / "release/release.toml"
    words = file.read_text("utf-8")
    for old, new in changes.items():
        assert words.count(old) == 1
        words = words.replace(old, new)
    file.write_text(words, "utf-8")
    return subprocess.run(
        [sys.executable, folder / "lab.py", "release"], capture_output=True, encoding="utf-8"
    )


def test_all_is_written_from_release_toml(copied: Path) -> None:
    """After a change in release.toml, the version or the dependencies: python3 lab.py release."""
    assert release(copied, {}).returncode == 0
    for name in WRITTEN:
        assert (copied / name).read_text("utf-8") == text(name), "run 'python3 lab.py release'"


def test_what_a_release_fills_in_arrives_everywhere(copied: Path) -> None:
    done = release(copied, FILLED)
    assert (done.returncode, done.stderr) == (0, "")
    cited = yaml.safe_load((copied / "CITATION.cff").read_text("utf-8"))
    assert (cited["doi"], cited["url"]) == ("10.5281/zenodo.1", ADDRESS)
    assert "repository-code" not in cited  # it is not known
    bibliography = entries((copied / "CITATION.bib").read_text("utf-8"))
    assert bibliography["driftlab"]["url"] == ADDRESS
    recipe = yaml.safe_load((copied / "release/recipe.yaml").read_text("utf-8"))
    assert recipe["source"] == {"url": f"{ADDRESS}.tar.gz", "sha256": SHA256}
    assert recipe["about"]["homepage"] == ADDRESS
    urls = {"Homepage": ADDRESS, "Issues": f"{ADDRESS}/issues"}
    written = tomllib.loads((copied / "pyproject.toml").read_text("utf-8"))
    assert written["project"].pop("urls") == urls
    before = tomllib.loads(text("pyproject.toml"))
    del before["project"]["urls"]
    assert written == before


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"date = 2026": "date = 2026 #"}, "date must be like 2026-11-23, it is 2026"),
        ({'Issues = ""': 'Issues = "example.org"'}, "Issues must be an address with https://"),
        ({'doi = ""': 'doi = "https://doi.org/10.1"'}, "doi must be like 10.5281/zenodo.1"),
        ({'sha256 = ""': f'sha256 = "{SHA256}"'}, "both its url and its SHA-256, or neither"),
        ({'doi = ""': 'doi = "'}, "release.toml cannot be read: "),
    ],
)
def test_a_slip_in_release_toml_is_refused_in_a_sentence(
    copied: Path, changes: dict[str, str], sentence: str
) -> None:
    done = release(copied, changes)
    assert done.returncode == 1
    assert done.stderr.startswith("release.toml")
    assert sentence in done.stderr
    assert done.stderr.count("\n") == 1
    assert (copied / "CITATION.cff").read_text("utf-8") == text("CITATION.cff")


def test_the_newest_changes_are_those_of_this_version() -> None:
    newest = re.search(r"^## (\S+) \((\S+)\)$", text("CHANGELOG.md"), re.MULTILINE)
    assert newest.groups() == (driftlab.__version__, str(RELEASE["date"]))
    assert re.fullmatch(r"\d+\.\d+\.\d+", driftlab.__version__)


def test_one_name_for_the_authors() -> None:
    authors = RELEASE["authors"]
    assert PROJECT["authors"] == [{"name": authors}]
    assert authors.lower() in text("LICENSE").lower()
    assert authors.lower() in text("LICENSES/BSD-3-Clause.txt").lower()
    assert authors in text("REUSE.toml")
    assert f"  - name: {authors}" in text("release/paper/paper.md")


def test_citation_names_version_day_and_the_four_papers() -> None:
    cited = yaml.safe_load(text("CITATION.cff"))
    assert cited["version"] == driftlab.__version__
    assert cited["date-released"] == RELEASE["date"]
    assert [paper["title"] for paper in cited["references"]] == [
        paper["title"] for paper in RELEASE["paper"]
    ]
    bibliography = entries(text("CITATION.bib"))
    assert list(bibliography) == ["driftlab", *(paper["key"] for paper in RELEASE["paper"])]
    assert bibliography["driftlab"]["version"] == driftlab.__version__
    assert bibliography["driftlab"]["year"] == str(RELEASE["date"].year)


def test_conda_asks_for_what_pip_asks_for() -> None:
    recipe = yaml.safe_load(text("release/recipe.yaml"))
    assert recipe["context"]["version"] == driftlab.__version__
    python, *run = recipe["requirements"]["run"]
    assert python == f"python {PROJECT['requires-python']}"
    assert run == PROJECT["dependencies"]
    assert recipe["about"]["license"] == PROJECT["license"]
    assert all((ROOT / name).is_file() for name in recipe["about"]["license_file"])


def test_every_part_has_a_licence_in_full() -> None:
    parts = tomllib.loads(text("REUSE.toml"))["annotations"]
    used = {
        licence
        for part in parts
        for licence in re.findall(r"[A-Z][\w.-]+\d[\w.-]*", part["SPDX-License-Identifier"])
    }
    assert used == {path.stem for path in (ROOT / "LICENSES").iterdir()}
    # A font that only the site's PDF is set with is in no wheel.
    assert set(PROJECT["license"].split(" AND ")) == used - {"OFL-1.1"}
    assert all(f"LICENSES/{name}.txt" in text("LICENSE") for name in used)
    for pattern in (path for part in parts for path in part["path"]):
        assert next(ROOT.glob(pattern), None) is not None, pattern


def test_the_paper_cites_what_was_checked_and_all_that_it_lists() -> None:
    body = text("release/paper/paper.md").split("---\n", 2)[2]
    listed = entries(text("release/paper/paper.bib"))
    assert set(re.findall(r"@([\w-]+)", body)) == set(listed)
    papers = entries(text("CITATION.bib"))
    checked = {entry.key: entry for entry in all_references()}
    for key, entry in listed.items():
        if key in papers:
            assert entry == papers[key]
            continue
        known = checked[key]
        assert (entry["title"], entry["year"]) == (known.title, str(known.year))
        assert entry.get("doi", "") == known.doi
        home = entry.get("journal") or entry.get("publisher") or entry["booktitle"]
        assert home in known.where


def test_the_paper_states_no_number_that_could_grow_old() -> None:
    body = text("release/paper/paper.md").split("---\n", 2)[2]
    assert re.findall(r"\d+", re.sub(r"\[@.*?\]", "", body)) == ["17"]  # a chapter's name


def test_the_page_of_the_index_leads_nowhere_into_this_folder() -> None:
    page = text(PROJECT["readme"])
    targets = re.findall(r"\]\(([^)]*)\)|(?:src|href)=\"([^\"]*)\"", page)
    assert all("".join(target).startswith("https://") for target in targets)
