"""Slides stand alone, fit every projector, show each proof, and have a lecturer's notes."""

import re
import subprocess
from contextlib import nullcontext
from pathlib import Path

import nbformat
import pytest
from chromium import no_browser
from served import served
from visitor import visit

from executed import KEPT
from slides.cells import NOTES, on_slides
from slides.make import chapters, main
from support import ROOT

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("site-slides")]
CHAPTERS = chapters()
DEFINITIONS = {"08-one-step-of-the-filter-ten-lines"}
"""Cells that print nothing: their code is what they show, asked for or not."""
BARE = re.compile(r"[\d{\[(.-]|array|True|False|None|<")
"""What Python calls a value, without words and units."""
SIZES = (1024, 768), (1280, 720), (1920, 1080)
"""Of the window, in points: two projectors, and a screen that is plugged in during the lecture."""
LEAST = 18
"""The smallest type, of a slide that is 1200 wide."""
ALL_SLIDES = """() => Reveal.getSlides().map((slide) => {
  const { h, v } = Reveal.getIndices(slide);
  Reveal.slide(h, v, 99);
  const seen = [...slide.querySelectorAll(".sheet *")].filter(
    (each) => !each.closest("mjx-container :not(svg)") && each.getClientRects().length);
  const boxes = seen.map((each) => each.getBoundingClientRect());
  const type = seen.filter((each) => each.matches("mjx-container")
    || [...each.childNodes].some((node) => node.nodeType === 3 && node.data.trim()));
  return {
    place: `${h}.${v}`,
    left: Math.min(...boxes.map((box) => box.left)),
    right: Math.max(...boxes.map((box) => box.right)),
    top: Math.min(...boxes.map((box) => box.top)),
    bottom: Math.max(...boxes.map((box) => box.bottom)),
    least: Math.min(...type.map((each) => parseFloat(getComputedStyle(each).fontSize))),
    cut: seen.filter((each) => each.scrollWidth > each.clientWidth + 1
      && getComputedStyle(each).overflowX !== "visible").length,
    raw: /\\\\[a-z]{2,}|\\$/.test([...slide.querySelectorAll("p, li, td, .formula")]
      .map((each) => each.innerText).join(" ")),
  };
})"""


@pytest.fixture(scope="module")
def folder(site_python, tmp_path_factory) -> Path:
    """All slides, with and without code."""
    folder = tmp_path_factory.mktemp("slides")
    script = Path(__file__).with_name("build_slides.py")
    subprocess.run([site_python, script, folder, *CHAPTERS.values()], check=True)
    return folder


@pytest.fixture
def page(started_browser):
    with visit(started_browser) as page:
        yield page


def opened(page, path: Path) -> None:
    page.goto(path.as_uri())
    page.wait_for_selector("html[data-ready]", timeout=20000)


@pytest.mark.browser
@pytest.mark.skipif(bool(no_browser()), reason=no_browser())
@pytest.mark.parametrize("code", ["", "-code"])
@pytest.mark.parametrize("number", CHAPTERS)
def test_every_slide_fits_and_can_be_read(folder, page, number, code):
    opened(page, folder / f"{Path(CHAPTERS[number]).stem}{code}.html")
    for width, height in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        page.evaluate("Reveal.layout()")
        slides = page.evaluate(ALL_SLIDES)
        assert len(slides) > 10
        for slide in slides:
            place = (width, slide["place"])
            assert slide["left"] >= 0, place
            assert slide["right"] <= width, place
            assert slide["top"] >= 0, place
            assert slide["bottom"] <= height, place
            assert slide["least"] >= LEAST, place
            assert not slide["cut"], place
            assert not slide["raw"], place
    assert page.complaints == []


@pytest.mark.browser
@pytest.mark.skipif(bool(no_browser()), reason=no_browser())
def test_the_answer_of_a_puzzle_waits_for_a_key_and_its_notes_open_from_a_file(folder, page):
    opened(page, folder / f"{Path(CHAPTERS['01']).stem}.html")
    page.keyboard.press("ArrowRight")
    with page.expect_popup() as popup:
        page.keyboard.press("s")
    notes = popup.value.locator(".speaker-controls-notes .value")
    notes.get_by_text("Most say 30").wait_for()
    page.keyboard.press("Space")
    answer = page.locator("section.present .fragment").first
    assert page.locator("section.present:not(.stack) h3").inner_text().startswith("Guessed?")
    assert "visible" not in answer.get_attribute("class")
    page.keyboard.press("Space")
    assert "visible" in answer.get_attribute("class")
    assert page.complaints == []


PLACE = """() => {
  const { h, v, f } = Reveal.getIndices();
  return [h, v ?? 0, f ?? -1, Reveal.getTotalSlides()];
}"""


def agreed(page, frame) -> list[int]:
    """Where both are, as soon as they are at the same place of the same deck."""
    for _ in range(60):
        places = page.evaluate(PLACE), frame.evaluate(PLACE)
        if places[0] == places[1]:
            break
        page.wait_for_timeout(50)
    assert places[0] == places[1]
    return places[0]


def walked(page, frame, pressed) -> int:
    """How many key presses lead through the deck, with both windows together at each."""
    page.evaluate("Reveal.slide(0, 0)")
    last, steps = agreed(page, frame), 0
    while not page.evaluate("Reveal.isLastSlide() && !Reveal.availableFragments().next"):
        pressed.keyboard.press("Space")
        page.wait_for_function(f"() => String(({PLACE})()) !== '{','.join(map(str, last))}'")
        last, steps = agreed(page, frame), steps + 1
    return steps


@pytest.mark.browser
@pytest.mark.skipif(bool(no_browser()), reason=no_browser())
@pytest.mark.parametrize("way", ["file", "http"])
def test_the_speaker_view_has_the_slides_of_the_projector(folder, page, way):
    """Whichever window is driven, and whatever shape it has or comes to have."""
    path = folder / f"{Path(CHAPTERS['03']).stem}.html"
    page.set_viewport_size({"width": 1280, "height": 720})
    with served(folder) if way == "http" else nullcontext() as address:
        page.goto(f"{address}/{path.name}" if address else path.as_uri())
        page.wait_for_selector("html[data-ready]", timeout=20000)
        with page.expect_popup() as popup:
            page.keyboard.press("s")
        speaker = popup.value
        speaker.set_viewport_size({"width": 1100, "height": 760})
        for name in ("current", "upcoming"):
            speaker.frame_locator(f"#{name}-slide iframe").locator("html[data-ready]").wait_for()
        current, upcoming = speaker.frames[1:]
        total = agreed(page, current)[-1]
        assert upcoming.evaluate(PLACE)[-1] == total
        page.set_viewport_size({"width": 1000, "height": 760})
        assert agreed(page, current)[-1] == total
        # Each way of opening it drives one of the two; what one says to the other is the same.
        assert walked(page, current, speaker if way == "file" else page) >= total - 1
    assert page.complaints == []


def source(number: str):
    return nbformat.read(ROOT / "notebooks" / CHAPTERS[number], as_version=4)


def shown(number: str):
    """Ids of the cells that stand on slides."""
    notebook = source(number)
    for cell in notebook.cells:
        cell.setdefault("outputs", [])
    return {cell.id for cell in on_slides(notebook).cells}


@pytest.mark.parametrize("number", CHAPTERS)
def test_notes_stand_on_slides_and_their_minutes_are_those_of_the_syllabus(number):
    notes = {name: text for name, text in NOTES.items() if name.startswith(f"{number}-")}
    assert notes.keys() <= shown(number)
    assert any("puzzle" in name for name in notes)
    page = nbformat.read(ROOT / "notebooks/for_instructors.ipynb", as_version=4)
    (minutes,) = re.findall(rf"^\| {number} [^|]*\|[^|]*\| (\d+) \|", page.cells[1].source, re.M)
    told = [re.match(r"\s*\*\*(\d+) minutes\.\*\*", text) for text in notes.values()]
    assert sum(int(each[1]) for each in told) == int(minutes)


def test_every_note_belongs_to_a_chapter():
    assert {name[:2] for name in NOTES} == set(CHAPTERS)


@pytest.mark.parametrize("number", CHAPTERS)
def test_every_cell_on_a_slide_shows_something_and_no_reading_is_left_unfolded(folder, number):
    notebook = nbformat.read(KEPT / CHAPTERS[number], as_version=4)
    on_them = on_slides(notebook).cells
    silent = {cell.id for cell in on_them if cell.cell_type == "code" and not cell.outputs}
    assert silent <= DEFINITIONS
    for cell in on_them:
        assert "solutions/" not in cell.source
        assert ".ipynb)" not in cell.source
        assert "student=" not in cell.source
        assert "For readers of the paper" not in cell.source
        assert "olded" not in cell.source, cell.id
        for output in cell.get("outputs", []):
            data = output.get("data", {})
            assert set(data) != {"text/plain"} or not BARE.match(data["text/plain"]), cell.id


def test_an_unknown_chapter_gets_one_sentence(capsys):
    assert main(["12"]) == 1
    said = capsys.readouterr().err
    assert said == f"No slides for 12; there are {', '.join(CHAPTERS)}.\n"
