"""Panels and scenes alive in a page, held to the package; pictures and refusals.

All in one page, of a site that needs no network: Python begins in it twice.
"""

import os
import re

import numpy as np
import pytest
from lively import (
    PATIENCE,
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
    AllanExplorer,
    DriftExplorer,
    ObservabilityExplorer,
    TurningBlock,
)
from driftlab.book.machinery.figure.csv_table import read_table
from driftlab.book.machinery.panel.still import plain_values
from driftlab.book.panels import EXPLORERS, SCENES
from grouped import opened
from support import ROOT

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("site-in-place")]
SAMPLE = (
    AlgorithmLaboratoryExplorer,
    AllanExplorer,
    DriftExplorer,
    ObservabilityExplorer,
    TurningBlock,
)
"""Panels that have every kind of control, and a scene."""
MOVED = 2
"""Controls of a panel that are moved."""
FIGURES = ("03-drift-map", "07-algorithm-orders", "15-damping")


def kinds(panels) -> set[str]:
    return {type(control.widget()).__name__ for each in panels for control in each.controls}


def test_the_sample_has_every_kind_of_control():
    assert kinds(SAMPLE) == kinds((*EXPLORERS, *SCENES))


@pytest.fixture(scope="module")
def lively(kept_page, own_address):
    """A page with the sample, one of it twice, which may ask nothing of the network."""
    kept_page.elsewhere = []

    def refuse(route) -> None:
        kept_page.elsewhere.append(route.request.url)
        route.abort()

    if "DRIFTLAB_PYODIDE" in os.environ:
        kept_page.route(re.compile(r"^https?://(?!127\.0\.0\.1[:/])"), refuse)
    show(kept_page, own_address, *map(opened, SAMPLE), DriftExplorer("Scale factor"))
    return kept_page


def test_without_its_packages_python_says_so_and_stop_ends_it(lively):
    """Whatever place the packages come from."""
    figure = figure_of(lively, AllanExplorer)
    note = figure.locator(".in-place-note")
    wheel = re.compile(r"/numpy-[^/]*\.whl")
    lively.route(wheel, lambda route: route.abort())
    figure.locator(".in-place-begin").click()
    missing = re.compile(r"numpy-\S+ could not be fetched from 127.0.0.1")
    note.filter(has_text=missing).wait_for(timeout=PATIENCE)
    lively.unroute(wheel)
    figure.locator(".in-place-begin").click()
    figure.locator(".in-place-waiting", has_text="MB").wait_for()
    figure.locator(".in-place-waiting button").click()
    note.filter(has_text="Python was stopped. It can be started again.").wait_for()
    assert figure.locator(":scope > img").is_visible()
    lively.complaints.clear()


AT_END = """control => control.options
  ? control.selectedIndex === control.options.length - 1
  : Number(control.value) === Number(control.min)"""
"""Whether the arrow down can move a control no further."""


@pytest.mark.parametrize("panel_class", SAMPLE, ids=lambda each: each.__name__)
def test_a_panel_lives_and_says_what_the_package_says(lively, panel_class):
    figure = figure_of(lively, panel_class)
    let_live(lively, figure)
    assert not figure.locator(":scope > img").is_visible()
    panel = opened(panel_class)
    assert values_of(figure) == plain_values(panel.values)
    same_as_native(lively, figure, panel)
    for fold in figure.locator("summary").all():
        fold.click()
    picture = "figure => figure.querySelector('img.driftlab-picture, .dl-views').outerHTML"
    before = figure.evaluate(picture)
    sliders = figure.locator(".in-place-slider input[type=range]")
    for control in sliders.all()[:MOVED]:
        control.focus()
        old = values_of(figure)
        lively.keyboard.press("ArrowUp" if control.evaluate(AT_END) else "ArrowDown")
        at_rest(lively, figure)
        assert values_of(figure) != old
        assert control.evaluate("control => control === document.activeElement")
    others = figure.locator(".driftlab-group :is(select, input[type=checkbox], input[type=text])")
    for control in others.all()[:MOVED]:
        control.evaluate("control => control.scrollIntoView()")
        old = values_of(figure)
        match control.get_attribute("type") or "select":
            case "checkbox":
                control.click()
            case "text":
                control.fill("+90X +90Y")
                control.press("Enter")
            case "select":
                last = control.evaluate("menu => menu.selectedIndex === menu.length - 1")
                control.select_option(index=0 if last else control.locator("option").count() - 1)
        at_rest(lively, figure)
        assert values_of(figure) != old
    same_as_native(lively, figure, panel)
    assert figure.evaluate(picture) != before
    assert figure.locator(".driftlab-error, .in-place-status:not(:empty)").count() == 0
    assert lively.complaints == []


def test_python_computes_the_published_numbers_and_has_no_notebook(lively):
    """Nor symbols: which would take seconds more to come."""
    let_live(lively, figure_of(lively, DriftExplorer))
    code = """import sys

def found(names):
    return [each for each in names if each in sys.modules]

def numbers(name):
    from driftlab.book.figures import figure_definitions
    from driftlab.book.machinery.figure.csv_table import as_words
    figure = figure_definitions(name[:2])[name]
    return {key: list(words) for key, words in as_words(figure.columns(figure.compute())).items()}
"""
    with probe(lively, code):
        assert ask(lively, "probe.found", ["numpy", "sympy", "IPython", "comm"]) == ["numpy"]
        for name in FIGURES:
            computed = ask(lively, "probe.numbers", name)
            published = read_table(ROOT / f"figures/{name}.csv")[1]
            assert list(computed) == list(published)
            for column, words in published.items():
                here, there = (
                    np.array([float(word or 0) for word in each])
                    for each in (computed[column], words)
                )
                # What is smaller than the first is rounding itself, in whatever units.
                least = max(1e-12, 1e-9 * np.abs(there).max())
                np.testing.assert_allclose(here, there, 0, least, err_msg=column)


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
    play.click()
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


def words_of(picture: str) -> list[str]:
    """What a picture says; where letters are drawn as outlines, a comment says what they are."""
    found = re.findall(r"<!--(.*?)-->|<text[^>]*>(.*?)</text>", picture, re.S)
    return [" ".join(re.sub("<[^>]*>", "", "".join(each)).split()) for each in found]


@pytest.mark.parametrize("panel_class", [ObservabilityExplorer, TurningBlock])
def test_the_saved_picture_shows_what_the_packages_does(lively, panel_class, tmp_path):
    figure = figure_of(lively, panel_class)
    let_live(lively, figure)
    panel = opened(panel_class)
    same_as_native(lively, figure, panel)
    with lively.expect_download() as download:
        figure.locator("button", has_text="Save the picture").click()
    assert download.value.suggested_filename == f"{panel_class.__name__}.svg"
    said = words_of(download.value.path().read_text("utf-8"))
    expected = words_of(panel.save(tmp_path / "own.svg").read_text("utf-8"))
    assert len(expected) > 10
    assert [pair for pair in zip(said, expected, strict=True) if not close(*pair)] == []


def test_a_refusal_is_a_sentence_and_what_nobody_foresaw_is_folded(lively):
    figure = figure_of(lively, DriftExplorer)
    let_live(lively, figure)
    broken = """from panels import OPEN

def breaks(error):
    def compute(values):
        raise error
    for each in OPEN:
        if type(each).__name__ == "DriftExplorer":
            each.compute = compute

def refuse(): breaks(ValueError("size: expected less."))

def fail(): breaks(ZeroDivisionError("on purpose"))
"""
    alert, slider = figure.locator("[role=alert]"), figure.locator("input[type=range]").last
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


SMALL_OR_NAMELESS = """figure =>
  [...figure.querySelectorAll('.in-place-live :is(button, input, select, summary)')]
    .filter(each => each.checkVisibility())
    .filter(each => {
      const target = each.type === 'checkbox' ? each.closest('label') : each;
      return target.getBoundingClientRect().height < 24 || !(each.ariaLabel || each.textContent);
    })
    .map(each => each.outerHTML)
"""


def test_panels_fit_the_page(lively):
    before = lively.viewport_size
    figures = [figure_of(lively, each) for each in (AlgorithmLaboratoryExplorer, TurningBlock)]
    for figure in figures:
        let_live(lively, figure)
        assert figure.locator(".driftlab-headline").get_attribute("aria-live") == "polite"
    for width in (390, 683, 1366):
        lively.set_viewport_size({"width": width, "height": 900})
        assert lively.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0
        assert [figure.evaluate(SMALL_OR_NAMELESS) for figure in figures] == [[], []]
    alt = figures[0].locator("img.driftlab-picture").get_attribute("alt")
    assert alt.startswith(AlgorithmLaboratoryExplorer.title)
    lively.set_viewport_size(before)


def test_python_that_dies_is_a_sentence_and_begins_again_where_it_stood(lively):
    """The last test of this page."""
    figure = figure_of(lively, TurningBlock)
    let_live(lively, figure)
    before = values_of(figure)
    assert before != plain_values(opened(TurningBlock).values)
    died = "import js\n\ndef now(): js.setTimeout(js.eval('() => { throw Error() }'), 0)"
    with probe(lively, died):
        ask(lively, "probe_of_death.now")
        figure.locator(".in-place-note", has_text="Python came to its end").wait_for()
    assert figure.locator(":scope > img").is_visible()
    assert lively.locator(".in-place-live").count() == 0
    awaken(lively, figure)
    assert values_of(figure) == before
    assert lively.elsewhere == []
