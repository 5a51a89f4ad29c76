"""The notebooks as pages: figures, panels, exercises, places to link to, and what a page weighs."""

import gzip
import html
import json
import re
from itertools import pairwise
from urllib.parse import unquote

import nbformat
import pytest

from driftlab.book.panels import EXPLORERS, SCENES
from executed import FOLDER, published
from support import ROOT

WEIGHT = 60_000
"""Bytes of a page, packed as servers send it."""
HEAVY = {"06_picard_algorithms": 75_000, "08_system_calibration": 80_000}
"""The two longest chapters: their words, code and numbers alone are more than 40 kB."""
CHAPTERS = [name for name in published() if name[:2].isdigit()]
PANELS = {panel.__name__: panel for panel in (*EXPLORERS, *SCENES)}


def sources(name):
    """All lines of code of a notebook, and its words."""
    cells = nbformat.read(FOLDER / name, as_version=4).cells
    return [
        "\n".join(cell.source for cell in cells if cell.cell_type == kind)
        for kind in ("code", "markdown")
    ]


@pytest.fixture(scope="module")
def pages(site):
    """The page of each notebook."""
    return {name: (site / name).with_suffix(".html").read_text("utf-8") for name in published()}


def tags(text, name):
    return re.findall(rf"<{name}\b[^>]*>", text)


def attributes(tag):
    return {
        key: html.unescape(double or single)
        for key, double, single in re.findall(r"""([\w-]+)=(?:"([^"]*)"|'([^']*)')""", tag)
    }


def article(text):
    return text[text.index("<article") : text.index("</article>")]


def words(text):
    """What a reader sees of a page, without formulas and code."""
    text = re.sub(r"<(script|style|pre|code)\b.*?</\1>", " ", article(text), flags=re.S)
    text = re.sub(r'<(span|div) class="[^"]*\bmath\b[^"]*"[^>]*>.*?</\1>', " ", text, flags=re.S)
    return html.unescape(re.sub(r"<[^>]*>", " ", text))


def test_every_notebook_is_a_page_under_its_name(pages):
    assert len(CHAPTERS) == 14
    for name, text in pages.items():
        title = re.search(r"^# (.*)$", sources(name)[1], re.M)[1]
        shown = re.search(r"<h1>(.*?)<a", text)[1]
        assert html.unescape(re.sub(r"<[^>]*>", "", shown)).replace("’", "'") == title


def test_pictures_are_files_with_words_and_room(site, pages):
    for name, text in pages.items():
        assert "data:image" not in text, name
        for tag in tags(article(text), "img"):
            found = attributes(tag)
            if "/pictures/" in found["src"] or found["src"].startswith("_static/pictures/"):
                assert found["alt"], (name, tag)
                assert found["loading"] == "lazy"
                assert int(found["width"]) > 100, (name, tag)
                assert int(found["height"]) > 50, (name, tag)
                assert ((site / name).parent / found["src"]).is_file(), (name, tag)


def test_every_panel_and_scene_says_its_class_and_values(pages):
    seen = set()
    for name, text in pages.items():
        for tag in tags(text, "figure"):
            found = attributes(tag)
            if found.get("class") == "driftlab-still":
                panel = PANELS[found["data-panel"]]
                controls = {control.name for control in panel.controls}
                assert json.loads(found["data-values"]).keys() == controls, (name, tag)
                seen.add(found["data-panel"])
    assert seen == PANELS.keys()


def test_every_exercise_and_puzzle_has_its_room(pages):
    for name in CHAPTERS:
        code = sources(name)[0]
        for number in re.findall(r'^check\("([\d.]+)"', code, re.M):
            room = f'<div class="exercise" data-exercise="{number}"></div>'
            assert pages[name].count(room) == 1, number
            link = f'href="solutions/{name.replace(".ipynb", ".html")}#solution-'
            assert f'{link}{number.replace(".", "-")}"' in pages[name], number
        assert pages[name].count(f'<div class="guess" data-guess="{name[:2]}">') == code.count(
            f'guess("{name[:2]}")'
        )
    assert pages["11_one_triad.ipynb"].count('<div class="guesses">') == 1


def test_what_jupyterlab_folds_is_folded(pages):
    for name in CHAPTERS:
        cells = nbformat.read(FOLDER / name, as_version=4).cells
        folded = [cell for cell in cells if cell.metadata.get("jp-MarkdownHeadingCollapsed")]
        assert pages[name].count('<details class="folded">') == len(folded), name


def test_nothing_is_left_raw(pages):
    for name, text in pages.items():
        seen = words(text)
        assert re.findall(r"\\[a-zA-Z]+|\$[^$\n]+\$", seen) == [], name
        assert re.findall(r"\|\s*-{3}|^\|.*\|$", seen, re.M) == [], name
        assert "widget-view" not in text, name


def test_a_page_weighs_little_as_it_is_served(site):
    for path in sorted(site.rglob("*.html")):
        text = path.read_text("utf-8")
        if "<article" in text and "_modules" not in path.parts:
            most = HEAVY.get(path.stem, WEIGHT)
            assert len(gzip.compress(text.encode())) < most, path.relative_to(site)


def test_chapters_come_part_by_part_and_lead_on(pages):
    for here, there in pairwise(CHAPTERS):
        following = re.search(r'class="next-page" href="([^"]*)"', pages[here])[1]
        assert unquote(following) == there.replace(".ipynb", ".html")
    side = pages["03_systematic_drift.ipynb"]
    assert "Part I: A bent triad and its drift" in side
    readme = (ROOT / "README.md").read_text("utf-8")
    minutes = re.search(r"^\| 03 \|.*?\| (\d+) \|", readme, re.M)[1]
    assert f'<p class="ways">{minutes} minutes' in side
