"""Slides stand alone, fit every projector, show each proof, and have a lecturer's notes."""

import re
import subprocess
from pathlib import Path

import nbformat
import pytest

from executed import KEPT
from slides.cells import NOTES, on_slides
from slides.make import chapters, main
from slides.written import FOLDER as WRITTEN, SHOWN
from support import ROOT

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("site-pdf")]
CHAPTERS = chapters()
SAMPLE = ("06", "03")
"""Chapters that are looked at in a browser: cut from the book, and written."""
DEFINITIONS = {
    "09-ten-lines-2",
    "09-ten-lines-4",
    "09-zero-velocity-updates-2",
    "11-one-step-of-the-filter-ten-lines",
}
"""Cells that print nothing: their code is what they show, asked for or not."""
BARE = re.compile(r"[\d{\[(.-]|array|True|False|None|<")
"""What Python calls a value, without words and units."""
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
    """Slides of the sample, of the last with its code, too."""
    names = [CHAPTERS[number] for number in SAMPLE]
    if not all((KEPT / name).exists() for name in names):
        pytest.skip("'python3 lab.py site' has not run in this folder: the chapters' outputs")
    folder = tmp_path_factory.mktemp("slides")
    script = Path(__file__).with_name("build_slides.py")
    subprocess.run([site_python, script, folder, *names], check=True)
    return folder


def opened(page, folder: Path, number: str, code: str = "") -> None:
    page.goto((folder / f"{Path(CHAPTERS[number]).stem}{code}.html").as_uri())
    page.wait_for_selector("html[data-ready]", timeout=60000)


@pytest.mark.browser
@pytest.mark.parametrize(
    ("number", "code", "size", "count"),
    [
        ("06", "", (1280, 720), range(10, 60)),
        ("03", "", (1280, 720), range(5, 9)),
        ("03", "-code", (1024, 768), range(10, 80)),
    ],
)
def test_every_slide_fits_and_can_be_read(folder, page, number, code, size, count):
    """In the window that they are opened in, and on a screen that is plugged in later."""
    for place, (width, height) in enumerate((size, (1920, 1080))):
        page.set_viewport_size({"width": width, "height": height})
        if place == 0:
            opened(page, folder, number, code)
        page.evaluate("Reveal.layout()")
        slides = page.evaluate(ALL_SLIDES)
        assert len(slides) in count
        for slide in slides:
            assert slide["left"] >= 0, slide
            assert slide["right"] <= width, slide
            assert slide["top"] >= 0, slide
            assert slide["bottom"] <= height, slide
            assert slide["least"] >= LEAST, slide
            assert not slide["cut"], slide
            assert not slide["raw"], slide
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


@pytest.mark.browser
def test_the_speaker_view_has_the_slides_and_notes_of_the_projector(folder, page):
    """From a file; whichever window is driven, and whatever shape it has or comes to have."""
    page.set_viewport_size({"width": 1280, "height": 720})
    opened(page, folder, "06")
    page.keyboard.press("ArrowRight")
    with page.expect_popup() as popup:
        page.keyboard.press("s")
    speaker = popup.value
    speaker.set_viewport_size({"width": 1100, "height": 760})
    speaker.locator(".speaker-controls-notes .value", has_text="tangent of a quarter").wait_for()
    for name in ("current", "upcoming"):
        frame = speaker.frame_locator(f"#{name}-slide iframe")
        frame.locator("html[data-ready]").wait_for(timeout=60000)
    current, upcoming = speaker.frames[1:]
    last = agreed(page, current)
    assert upcoming.evaluate(PLACE)[-1] == last[-1]
    page.keyboard.press("Space")
    answer = page.locator("section.present .fragment").first
    assert page.locator("section.present:not(.stack) h3").inner_text().startswith("Guessed?")
    assert "visible" not in answer.get_attribute("class")
    page.keyboard.press("Space")
    assert "visible" in answer.get_attribute("class"), "the answer of a puzzle waits for a key"
    page.set_viewport_size({"width": 1000, "height": 760})
    for pressed in (speaker, page, speaker, page):
        last = agreed(page, current)
        pressed.keyboard.press("Space")
        page.wait_for_function(f"() => String(({PLACE})()) !== '{','.join(map(str, last))}'")
        assert agreed(page, current)[-1] == last[-1]
    assert page.complaints == []


@pytest.mark.parametrize("path", sorted(WRITTEN.glob("*.md")), ids=lambda path: path.stem)
def test_written_slides_have_one_idea_each_and_the_minutes_of_the_syllabus(path):
    slides = path.read_text("utf-8").split("\n---\n")
    assert 5 <= len(slides) <= 8
    cells = nbformat.read(ROOT / "notebooks" / CHAPTERS[path.stem], as_version=4).cells
    told = []
    for slide in slides:
        text, _, note = slide.partition("\nNotes:\n")
        assert len(text.split()) <= 60, text
        assert text.count("## ") == 1, text
        assert {*SHOWN.findall(text)} <= {cell.id for cell in cells}
        told.append(int(re.match(r"\*\*(\d+) minutes?\.\*\*", note)[1]))
    assert sum(told) == slide_minutes(path.stem)


def slide_minutes(number: str) -> int:
    """As the table for instructors has it."""
    page = nbformat.read(ROOT / "notebooks/for_instructors.ipynb", as_version=4)
    (minutes,) = re.findall(rf"^\| {number} [^|]*\|[^|]*\| (\d+) \|", page.cells[1].source, re.M)
    return int(minutes)


@pytest.mark.parametrize("number", CHAPTERS)
def test_notes_stand_on_slides_and_their_minutes_are_those_of_the_syllabus(number):
    notebook = nbformat.read(ROOT / "notebooks" / CHAPTERS[number], as_version=4)
    for cell in notebook.cells:
        cell.setdefault("outputs", [])
    notes = {name: text for name, text in NOTES.items() if name.startswith(f"{number}-")}
    assert notes.keys() <= {cell.id for cell in on_slides(notebook).cells}
    assert any("puzzle" in name for name in notes)
    told = [re.match(r"\s*\*\*(\d+) minutes\.\*\*", text) for text in notes.values()]
    assert sum(int(each[1]) for each in told) == slide_minutes(number)


@pytest.mark.parametrize("number", CHAPTERS)
def test_every_cell_on_a_slide_shows_something_and_no_reading_is_left_unfolded(site, number):
    if not (KEPT / CHAPTERS[number]).exists():
        pytest.skip("'python3 lab.py site' has not run in this folder: the chapters' outputs")
    on_them = on_slides(nbformat.read(KEPT / CHAPTERS[number], as_version=4)).cells
    silent = {cell.id for cell in on_them if cell.cell_type == "code" and not cell.outputs}
    assert silent <= DEFINITIONS
    for cell in on_them:
        for not_here in ("solutions/", ".ipynb)", "student=", "three dots", "olded"):
            assert not_here not in cell.source, cell.id
        for output in cell.get("outputs", []):
            data = output.get("data", {})
            assert set(data) != {"text/plain"} or not BARE.match(data["text/plain"]), cell.id


def test_an_unknown_chapter_gets_one_sentence_and_every_note_has_one(capsys):
    assert {name[:2] for name in NOTES} == set(CHAPTERS)
    assert main(["19"]) == 1
    said = capsys.readouterr().err
    assert said == f"No slides for 19; there are {', '.join(CHAPTERS)}.\n"
