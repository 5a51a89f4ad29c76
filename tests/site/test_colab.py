"""Copies for Google Colab: the first cell installs what is told; links lead to the site."""

import json
import re
from pathlib import Path

import nbformat
import pytest

import colab
from driftlab import __version__
from executed import published
from support import ROOT

BOOK = ROOT / "notebooks"
ADDRESS = "https://book.example/lab"
REPOSITORY = "https://code.example/drift-lab"
RELEASE = """
[urls]
Repository = "{repository}"
Documentation = "{documentation}"
[sdist]
url = "{sdist}"
"""


def copies(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, **known: str) -> Path:
    """Copies as they are made of a release of which only some addresses are known."""
    blank = {"repository": "", "documentation": "", "sdist": ""}
    (tmp_path / "release").mkdir()
    (tmp_path / "release/release.toml").write_text(RELEASE.format(**{**blank, **known}), "utf-8")
    monkeypatch.setattr(colab, "ROOT", tmp_path)
    colab.make_colab(BOOK, tmp_path / "colab")
    return tmp_path / "colab"


def words(notebook: dict) -> str:
    cells = notebook["cells"]
    return "\n\n".join("".join(c["source"]) for c in cells if c["cell_type"] == "markdown")


def read(path: Path) -> dict:
    return json.loads(path.read_text("utf-8"))


def test_every_notebook_has_a_copy_that_is_valid(tmp_path, monkeypatch) -> None:
    made = copies(tmp_path, monkeypatch)
    names = {Path(name) for name in published()}
    assert {path.relative_to(made) for path in made.rglob("*.ipynb")} >= names - {
        name for name in names if ".ipynb_checkpoints" in name.parts
    }
    for path in made.rglob("*.ipynb"):
        nbformat.validate(nbformat.read(path, as_version=4))


@pytest.mark.parametrize(
    ("known", "asked"),
    [
        ({}, f"driftlab[book]=={__version__}"),
        ({"repository": REPOSITORY}, f"driftlab[book] @ git+{REPOSITORY}@v{__version__}"),
        (
            {"repository": REPOSITORY, "sdist": "https://i.example/driftlab.tar.gz"},
            "driftlab[book] @ https://i.example/driftlab.tar.gz",
        ),
    ],
)
def test_the_first_cell_installs_and_lets_widgets_show(tmp_path, monkeypatch, known, asked) -> None:
    made = copies(tmp_path, monkeypatch, **known)
    first = next(c for c in read(made / "03_systematic_drift.ipynb")["cells"] if "outputs" in c)
    assert f'%pip install -q "{asked}"\n' in first["source"]
    assert ("No address of the package is known" in first["source"]) == (not known)
    code = re.sub(r"^%pip.*$", "", first["source"], flags=re.MULTILINE)
    exec(compile(code, "first cell", "exec"), {})  # elsewhere than on Colab it does nothing more
    assert "enable_custom_widget_manager" in code


def test_links_lead_to_the_published_site(tmp_path, monkeypatch) -> None:
    made = copies(tmp_path, monkeypatch, documentation=ADDRESS)
    for path in made.rglob("*.ipynb"):
        targets = re.findall(r"\]\(([^)]*)\)", words(read(path)))
        assert all(re.match(r"https?://|data:image/svg", target) for target in targets), path
    solution = words(read(made / "solutions/03_systematic_drift.ipynb"))
    assert f"]({ADDRESS}/03_systematic_drift.html" in solution
    assert f"[a page of Drift Lab]({ADDRESS}/solutions/03_systematic_drift.html)" in solution
    chapter = words(read(made / "03_systematic_drift.ipynb"))
    assert f"]({ADDRESS}/solutions/03_systematic_drift.html)" in chapter


def test_without_a_site_the_words_stay_and_no_link_is_dead(tmp_path, monkeypatch) -> None:
    made = copies(tmp_path, monkeypatch)
    for path in made.rglob("*.ipynb"):
        text = words(read(path))
        assert re.findall(r"\]\((?!https?:|data:)[^)]*\)", text) == [], path
        assert colab.BESIDE in text
    before = words(read(BOOK / "03_systematic_drift.ipynb"))
    name = re.search(r"\[([^\]]+)\]\(solutions/", before)[1]
    assert name in words(read(made / "03_systematic_drift.ipynb"))


def test_of_the_notebook_itself_nothing_is_changed_but_links(tmp_path, monkeypatch) -> None:
    made = copies(tmp_path, monkeypatch)
    before, after = (read(folder / "06_picard_algorithms.ipynb") for folder in (BOOK, made))
    assert [cell["id"] for cell in after["cells"][2:]] == [cell["id"] for cell in before["cells"]]
    for ours, theirs in zip(before["cells"], after["cells"][2:], strict=True):
        if ours["cell_type"] == "code":
            assert ours == theirs
