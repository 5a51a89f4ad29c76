"""Panels and scenes alive in a page, all held to the package; pictures and refusals."""

import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from lively import (
    ask,
    at_rest,
    awaken,
    close,
    figure_of,
    let_live,
    probe,
    same_as_native,
    show,
    values_of,
)

from driftlab.book import (
    AlgorithmLaboratoryExplorer,
    DriftExplorer,
    RootsExplorer,
    TurningBlock,
)
from driftlab.book.machinery.panel.still import plain_values
from driftlab.book.panels import EXPLORERS, SCENES
from grouped import opened, with_scenes

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("site-in-place")]
ALL = (*EXPLORERS, *SCENES)
MOVED = 3
"""Controls of a panel that are moved."""
SVG = "{http://www.w3.org/2000/svg}"
POINTS = 20
"""What is drawn through more of them is a curve, and no mark or frame."""


@pytest.fixture(scope="module")
def lively(kept_page, address, packages):
    """A page with every panel and scene of the book, one of them twice."""
    show(kept_page, address, *(opened(each) for each in ALL), DriftExplorer("Scale factor"))
    return kept_page


AT_END = """control => control.options
  ? control.selectedIndex === control.options.length - 1
  : Number(control.value) === Number(control.min)"""
"""Whether the arrow down can move a control no further."""


@with_scenes
@pytest.mark.xdist_group("site-in-place")
def test_every_panel_lives_and_says_what_the_package_says(lively, panel_class):
    figure = figure_of(lively, panel_class)
    awaken(lively, figure)
    panel = opened(panel_class)
    assert values_of(figure) == plain_values(panel.values)
    same_as_native(lively, figure, panel)
    for fold in figure.locator("summary").all():
        fold.click()
    picture = "figure => figure.querySelector('img.driftlab-picture, .dl-views').outerHTML"
    before = figure.evaluate(picture)
    sliders = figure.locator(".in-place-slider input[type=range]")
    controls = sliders if sliders.count() else figure.locator(".driftlab-group select")
    assert controls.count()
    for control in controls.all()[:MOVED]:
        control.focus()
        old = values_of(figure)
        lively.keyboard.press("ArrowUp" if control.evaluate(AT_END) else "ArrowDown")
        at_rest(lively, figure)
        assert values_of(figure) != old
        assert control.evaluate("control => control === document.activeElement")
    same_as_native(lively, figure, panel)
    assert figure.evaluate(picture) != before
    assert figure.locator(".driftlab-error, .in-place-status:not(:empty)").count() == 0
    assert lively.complaints == []


def test_python_has_neither_symbols_nor_a_notebook(lively):
    """Which would take seconds more to come."""
    let_live(lively, figure_of(lively, RootsExplorer))
    names = ["numpy", "sympy", "IPython", "comm"]
    with probe(
        lively, "import sys\n\ndef found(n): return [each for each in n if each in sys.modules]"
    ):
        assert ask(lively, "probe.found", names) == ["numpy"]


def test_a_scene_is_dragged_by_keys_and_plays(lively):
    figure = figure_of(lively, TurningBlock)
    let_live(lively, figure)
    figure.locator("button", has_text="Reset").click()
    at_rest(lively, figure)
    headline = figure.locator(".driftlab-headline")
    before = headline.inner_text()
    handle = figure.locator('[data-handle="axis of the turns"]')
    handle.focus()
    for _ in range(8):
        lively.keyboard.press("ArrowUp")
    changed = "([element, old]) => element.innerText !== old"
    lively.wait_for_function(changed, arg=[headline.element_handle(), before])
    at_rest(lively, figure)
    assert handle.evaluate("element => document.activeElement === element")
    assert figure.locator("select").evaluate("menu => menu.value") == "own values"
    same_as_native(lively, figure, opened(TurningBlock))
    clock, play = figure.locator(".dl-bar output"), figure.locator(".dl-bar button")
    if "Pause" in play.inner_text():
        play.click()
    stands = clock.inner_text()
    play.click()
    lively.wait_for_function(changed, arg=[clock.element_handle(), stands])
    assert lively.complaints == []


def test_two_panels_of_one_class_are_two_and_reset_goes_back_to_their_chapter(lively):
    other, figure = (figure_of(lively, DriftExplorer, number) for number in (0, 1))
    let_live(lively, other)
    let_live(lively, figure)
    theirs, beginning = values_of(other), DriftExplorer("Scale factor").values
    assert values_of(figure) == beginning
    number = figure.locator("input[type=number]").last
    for typed, taken in (("31.5", 31.5), ("400", 90.0), ("", 90.0)):
        number.fill(typed)
        number.press("Enter")
        at_rest(lively, figure)
        assert values_of(figure)["elevation"] == taken
        assert number.input_value() == f"{taken:.2f}"
    slider = figure.locator("input[type=range]").last
    assert slider.get_attribute("aria-valuetext") == "90.00"
    assert slider.get_attribute("aria-label") == "axis of rotation: elevation, °"
    slider.press("Home")
    at_rest(lively, figure)
    assert values_of(figure)["elevation"] == -90
    figure.locator("button", has_text="Reset").click()
    at_rest(lively, figure)
    assert values_of(figure) == beginning
    assert figure.locator("select").evaluate("menu => menu.value") == "Scale factor"
    assert values_of(other) == theirs


def words_and_curves(path: Path) -> tuple[list[str], int]:
    """What a picture says, and how many lines of many points it has; it must be well-formed."""
    # Where letters are drawn as outlines, what they say stands in a comment.
    parser = ET.XMLParser(target=ET.TreeBuilder(insert_comments=True))
    root = ET.parse(path, parser).getroot()
    assert root.tag == f"{SVG}svg"
    said = [
        " ".join("".join(each.itertext() if each.tag != ET.Comment else [each.text]).split())
        for each in root.iter()
        if each.tag in (ET.Comment, f"{SVG}text")
    ]
    drawn = [path.get("d", "") for path in root.iter(f"{SVG}path")]
    straight = [path for path in drawn if not re.search("[CQ]", path)]  # no letters, no circles
    return said, sum(len(re.findall(r"[\d.]+", path)) > 2 * POINTS for path in straight)


@pytest.mark.parametrize("panel_class", [RootsExplorer, TurningBlock])
def test_the_saved_picture_shows_what_the_packages_does(lively, panel_class, tmp_path):
    figure = figure_of(lively, panel_class)
    let_live(lively, figure)
    panel = opened(panel_class)
    same_as_native(lively, figure, panel)
    with lively.expect_download() as download:
        figure.locator("button", has_text="Save the picture").click()
    assert download.value.suggested_filename == f"{panel_class.__name__}.svg"
    said, curves = words_and_curves(download.value.path())
    expected, drawn = words_and_curves(panel.save(tmp_path / "own.svg"))
    assert curves == drawn > 0
    assert len(expected) > 10
    assert all(close(*pair) for pair in zip(said, expected, strict=True))


def test_a_refusal_is_a_sentence_and_what_nobody_foresaw_is_folded(lively):
    figure = figure_of(lively, RootsExplorer)
    let_live(lively, figure)
    broken = """from panels import OPEN

def breaks(error):
    def compute(values):
        raise error
    (panel,) = (each for each in OPEN if type(each).__name__ == "RootsExplorer")
    panel.compute = compute

def refuse(): breaks(ValueError("size: expected less."))

def fail(): breaks(ZeroDivisionError("on purpose"))
"""
    alert, slider = figure.locator("[role=alert]"), figure.locator("input[type=range]").last
    slider.press("Home")
    with probe(lively, broken):
        ask(lively, "probe_of_errors.refuse")
        slider.press("ArrowRight")
        at_rest(lively, figure)
        assert alert.inner_text().endswith("size: expected less.")
        ask(lively, "probe_of_errors.fail")
        slider.press("ArrowRight")
        at_rest(lively, figure)
    assert alert.inner_text() == "This should not have happened. ZeroDivisionError: on purpose"
    trace = figure.locator(".driftlab-error")
    assert not trace.is_visible()
    figure.locator("summary", has_text="Traceback").click()
    assert "in compute" in trace.inner_text()
    assert lively.complaints == []


@pytest.mark.parametrize("width", [390, 768, 1280])
def test_panels_fit_the_page(lively, width):
    before = lively.viewport_size
    lively.set_viewport_size({"width": width, "height": 900})
    for panel_class in (AlgorithmLaboratoryExplorer, TurningBlock):
        figure = figure_of(lively, panel_class)
        let_live(lively, figure)
        assert lively.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0
        small = figure.evaluate(SMALL_OR_NAMELESS)
        assert small == []
        assert figure.locator(".driftlab-headline").get_attribute("aria-live") == "polite"
    picture = figure_of(lively, AlgorithmLaboratoryExplorer).locator("img.driftlab-picture")
    assert picture.get_attribute("alt").startswith(AlgorithmLaboratoryExplorer.title)
    lively.set_viewport_size(before)


SMALL_OR_NAMELESS = """figure =>
  [...figure.querySelectorAll('.in-place-live :is(button, input, select, summary)')]
    .filter(each => each.checkVisibility())
    .filter(each => {
      const target = each.type === 'checkbox' ? each.closest('label') : each;
      return target.getBoundingClientRect().height < 24 || !(each.ariaLabel || each.textContent);
    })
    .map(each => each.outerHTML)
"""


def test_python_that_dies_is_a_sentence(lively):
    """The last test of this page."""
    figure = figure_of(lively, TurningBlock)
    let_live(lively, figure)
    died = "import js\n\ndef now(): js.setTimeout(js.eval('() => { throw Error() }'), 0)"
    with probe(lively, died):
        ask(lively, "probe_of_death.now")
        figure.locator(".in-place-note", has_text="Python came to its end").wait_for()
    assert figure.locator(":scope > img").is_visible()
    assert lively.locator(".in-place-live").count() == 0
