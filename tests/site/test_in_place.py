"""Panels and scenes alive in a page, all held to the package; links, Stop and refusals."""

import json
import math
import re
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from in_place_page import page_of

from driftlab.book import (
    AlgorithmLaboratoryExplorer,
    CapstoneExplorer,
    DriftExplorer,
    RootsExplorer,
    TurningBlock,
)
from driftlab.book.machinery.panel import Explorer
from driftlab.book.machinery.still import plain_values
from driftlab.book.panels import EXPLORERS, SCENES
from grouped import opened, with_scenes
from support import ROOT

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("site-in-place")]
PATIENCE = 240_000
"""Milliseconds that Python may take to begin on a busy machine; it is waited for no longer."""
ALL = (*EXPLORERS, *SCENES)
MOVED = 3
"""Controls of a panel that are moved."""


def figure_of(page, panel_class: type[Explorer], number: int = 0):
    """The place of a panel in a page."""
    return page.locator(f"figure[data-panel={panel_class.__name__}]").nth(number)


def show(page, address: str, *panels: Explorer, link: str = "") -> None:
    """Go to a page with some panels, each as it stands."""
    name = f"{address}/panels-in-their-place.html"
    page.route(name, lambda route: route.fulfill(body=page_of(panels), content_type="text/html"))
    page.goto(f"{name}{link}")


def awaken(page, figure) -> None:
    """Make a panel live by its button."""
    figure.locator(".in-place-begin").click()
    at_rest(page, figure)


def let_live(page, figure) -> None:
    """Make a panel live if it is not."""
    if not figure.locator(".in-place-live").count():
        awaken(page, figure)


def at_rest(page, figure) -> None:
    """Wait until a panel lives, and Python has nothing more to do for it."""
    page.wait_for_function(
        """figure => {
          const note = figure.querySelector('.in-place-note').textContent;
          if (note) throw new Error(note);
          const live = figure.querySelector('.in-place-live');
          return live && live.ariaBusy !== 'true';
        }""",
        arg=figure.element_handle(),
        timeout=PATIENCE,
    )


def values_of(figure) -> dict:
    """The values of a live panel."""
    return json.loads(figure.get_attribute("data-values"))


def close(shown: str, expected: str) -> bool:
    """Whether two texts say the same, but for the last digits of their numbers."""
    number = r"[-+]?\d+(?:\.\d+)?"
    if re.sub(number, "#", shown) != re.sub(number, "#", expected):
        return False
    pairs = zip(re.findall(number, shown), re.findall(number, expected), strict=True)
    return all(
        math.isclose(float(a), float(b), abs_tol=1.5 * 10.0 ** -len(a.partition(".")[2]))
        for a, b in pairs
    )


def at_full(value: object) -> object:
    """A value as Python has it: JSON knows nothing infinite."""
    return float(value) if value in ("inf", "-inf", "nan") else value


def same_as_native(page, figure, panel: Explorer) -> None:
    """Compare what a page shows with the package's panel, brought to the same values."""
    panel.set(**{name: at_full(value) for name, value in values_of(figure).items()})
    assert values_of(figure) == plain_values(panel.values)
    for where, html in (
        (".driftlab-headline", panel.headline.value),
        (".driftlab-results > :last-child", panel.text.value),
        (".driftlab-panel > .in-place-html", panel.code.value),
        (".driftlab-title > :nth-child(2)", panel.guide.value),
    ):
        text = page.evaluate(
            "html => Object.assign(document.createElement('div'), {innerHTML: html}).textContent",
            html,
        )
        shown = figure.locator(where).first.text_content()
        assert close(shown, text), f"{where}: {shown!r} for {text!r}"


@pytest.fixture(scope="module")
def lively(kept_page, address):
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


@contextmanager
def probe(page, text: str) -> Iterator[None]:
    """Let a Python file stand beside those of the site."""
    place = "**/in_place/probe*.py"
    page.route(place, lambda route: route.fulfill(body=text))
    yield
    page.unroute(place)


def ask(page, call: str, *args: object) -> object:
    """Ask the page's Python something, as the scripts of the site do."""
    script = """async ([call, args]) => {
      const python = await import(`${location.origin}/in_place/python.js`);
      return python.ask(call, args);
    }"""
    return page.evaluate(script, [call, args])


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
    address, entries = lively.url, lively.evaluate("history.length")
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
    lively.wait_for_function("() => location.hash.startsWith('#panel=DriftExplorer.2&')")
    lively.wait_for_function("() => location.hash.endsWith('&elevation=-90')")
    assert lively.evaluate("history.length") == entries
    assert lively.url != address
    figure.locator("button", has_text="Reset").click()
    at_rest(lively, figure)
    assert values_of(figure) == beginning
    assert figure.locator("select").evaluate("menu => menu.value") == "Scale factor"
    assert values_of(other) == theirs


def test_a_link_moves_a_panel_and_can_be_copied(lively):
    figure = figure_of(lively, DriftExplorer, 1)
    lively.evaluate("location.hash = 'panel=DriftExplorer.2&azimuth=-30&m12=0.35'")
    stands = "figure => JSON.parse(figure.dataset.values).azimuth === -30"
    lively.wait_for_function(stands, arg=figure.element_handle(), timeout=PATIENCE)
    at_rest(lively, figure)
    expected = {**DriftExplorer("Scale factor").values, "azimuth": -30.0, "m12": 0.35}
    assert values_of(figure) == expected
    same_as_native(lively, figure, opened(DriftExplorer))
    lively.context.grant_permissions(["clipboard-read", "clipboard-write"])
    figure.locator("button", has_text="Copy a link").click()
    status = figure.locator(".in-place-status")
    status.filter(has_text="The link is copied").wait_for()
    copied = lively.evaluate("navigator.clipboard.readText()")
    assert "azimuth=-30&" in copied
    assert copied == lively.url
    lively.evaluate("location.hash = 'panel=DriftExplorer.2&azimuth=west'")
    status.filter(has_text="azimuth: expected a number, got 'west'.").wait_for()
    assert values_of(figure) == expected
    assert lively.complaints == []


def test_the_picture_can_be_saved(lively):
    for panel_class in (RootsExplorer, TurningBlock):
        figure = figure_of(lively, panel_class)
        let_live(lively, figure)
        with lively.expect_download() as download:
            figure.locator("button", has_text="Save the picture").click()
        assert download.value.suggested_filename == f"{panel_class.__name__}.svg"
        assert "</svg>" in download.value.path().read_text("utf-8")


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


def test_without_its_packages_python_says_so_and_stop_ends_it_for_a_while(page, address):
    """Whatever place the packages come from. It begins again where it stood."""
    wheel = re.compile(r"/numpy-[^/]*\.whl")
    page.route(wheel, lambda route: route.abort())
    show(
        page, address, DriftExplorer(), CapstoneExplorer(), link="#panel=DriftExplorer&azimuth=-30"
    )
    figure, slow = figure_of(page, DriftExplorer), figure_of(page, CapstoneExplorer)
    note = figure.locator(".in-place-note")  # the link began without a click
    note.filter(has_text=re.compile(r"numpy-\S+ could not be fetched from")).wait_for(
        timeout=PATIENCE
    )
    page.unroute(wheel)
    figure.locator(".in-place-begin").click()
    figure.locator(".in-place-amount", has_text=re.compile(r"\d+ of \d\d MB")).wait_for()
    figure.locator(".in-place-waiting button").click()
    stopped = note.filter(has_text="Python was stopped. It can be started again.")
    stopped.wait_for()
    awaken(page, figure)
    still = figure.locator(":scope > img")
    assert not still.is_visible()
    figure.locator("input[type=range]").last.press("Home")
    at_rest(page, figure)
    slow.locator(".in-place-begin").click()
    slow.locator(".in-place-waiting button").click()
    stopped.wait_for()
    assert still.is_visible()
    assert slow.locator(".in-place-note").inner_text() == note.inner_text()
    awaken(page, figure)
    assert values_of(figure) == {**DriftExplorer().values, "elevation": -90.0}


WORKERS = """
  window.workers = [];
  window.Worker = class {
    asked = [];
    constructor() { workers.push(this); }
    postMessage(message) { this.asked.push(message); }
    terminate() {}
  };
"""
"""Workers that say what a test lets them say."""


def test_two_links_at_once_make_one_panel(page, address):
    page.add_init_script(WORKERS)
    show(page, address, DriftExplorer(), link="#panel=DriftExplorer&azimuth=-30")
    page.wait_for_function("window.workers[0]?.asked.length")
    page.evaluate("location.hash = 'panel=DriftExplorer&azimuth=40'")
    page.evaluate("new Promise((done) => setTimeout(done, 100))")
    paragraph = {"id": 1, "kind": "HTML", "state": {"value": "It lives."}}
    paragraph["state"]["layout"] = {"id": 2, "kind": "Layout", "state": {"display": None}}
    opened = {"panel": 0, "title": "", "widget": paragraph, "values": {}, "refused": ""}
    answer = "(result) => workers[0].onmessage({ data: { id: workers[0].asked[0].id, result } })"
    page.evaluate(answer, opened)
    page.wait_for_function("workers[0].asked.length === 2")
    asked = page.evaluate("workers[0].asked.map(({ call, args }) => [call, args.at(-1).azimuth])")
    assert [call for call, _ in asked] == ["panels.open", "panels.set"]
    assert asked[1][1] == "40"
    assert page.locator(".in-place-live").count() == 1
    assert page.complaints == []


def test_what_a_stopped_python_had_still_to_say_is_not_heard(page, address):
    page.add_init_script(WORKERS)
    show(page, address, DriftExplorer())
    script = """async () => {
      const { ask, stop } = await import(`${location.origin}/in_place/python.js`);
      const first = ask("a.first").catch((trouble) => trouble.kind);
      stop();
      const second = ask("a.second").catch((trouble) => trouble.kind);
      const [old, begun] = workers;
      const { id } = begun.asked[0];
      old.onmessage({ data: { id, result: "of the old one" } });
      old.onerror({ preventDefault() {} });
      begun.onmessage({ data: { id, result: "of the new one" } });
      return [await first, await second];
    }"""
    assert page.evaluate(script) == ["Stopped", "of the new one"]


@pytest.mark.parametrize(
    ("missing", "says"),
    [("WebAssembly", "This browser has no WebAssembly"), ("Worker", "Python could not be started")],
)
def test_an_old_browser_is_told_so(page, address, missing, says):
    page.add_init_script(f"delete window.{missing}")
    show(page, address, DriftExplorer())
    figure = figure_of(page, DriftExplorer)
    figure.locator(".in-place-begin").click()
    figure.locator(".in-place-note", has_text=says).wait_for()
    assert figure.locator(":scope > img").is_visible()
    assert page.complaints == []


def test_a_page_opened_as_a_file_says_what_it_needs(page, tmp_path):
    (tmp_path / "in_place").symlink_to(ROOT / "site/in_place")
    path = tmp_path / "page.html"
    path.write_text(page_of([DriftExplorer()]), "utf-8")
    page.goto(path.as_uri())
    figure = figure_of(page, DriftExplorer)
    figure.locator(".in-place-begin").click()
    note = figure.locator(".in-place-note", has_text="needs a web server")
    assert note.locator("code").inner_text() == "python3 -m http.server"
    assert page.complaints == []
