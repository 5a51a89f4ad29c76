"""What is in the way of a live panel: no network, an old browser, a file, and too much at once."""

import re

import pytest
from in_place_page import page_of
from lively import PATIENCE, at_rest, awaken, figure_of, show, values_of
from notebook_page import answer

from driftlab.book import CapstoneExplorer, DriftExplorer
from support import ROOT

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("site-in-the-way")]


def test_without_its_packages_python_says_so_and_stop_ends_it_for_a_while(page, address, packages):
    """Whatever place the packages come from. It begins again where it stood."""
    wheel = re.compile(r"/numpy-[^/]*\.whl")
    page.route(wheel, lambda route: route.abort())
    show(page, address, DriftExplorer(), CapstoneExplorer())
    figure, slow = figure_of(page, DriftExplorer), figure_of(page, CapstoneExplorer)
    note = figure.locator(".in-place-note")
    figure.locator(".in-place-begin").click()
    note.filter(has_text=re.compile(r"numpy-\S+ could not be fetched from")).wait_for(
        timeout=PATIENCE
    )
    page.unroute(wheel)
    figure.locator(".in-place-begin").click()
    figure.locator(".in-place-waiting", has_text="some 50 MB").wait_for()
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
SCRIPT = {"content-type": "text/javascript"}


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
    assert answer(page, script) == ["Stopped", "of the new one"]


RUNTIME = """
export async function loadPyodide() {
  const loadedPackages = {};
  return {
    loadedPackages, FS: { mkdir() {}, writeFile() {} }, ffi: { PyProxy: class {} }, runPython() {},
    toPy: (plain) => plain,
    pyimport: () => ({ install() {}, called: () => Object.keys(loadedPackages).join() }),
    async loadPackage(names) {
      for (const name of names) {
        const answer = await fetch(`../live/static/pyodide/${name}.whl`).catch(() => null);
        if (answer?.ok) loadedPackages[name] = ""; // of another it says nothing, as Pyodide
      }
    },
  };
}"""
"""In the place of Pyodide's: it fetches packages, and has no Python."""


@pytest.mark.parametrize("missing", ["sympy.whl", "probe.py"])
def test_what_did_not_come_is_named_and_comes_when_the_network_is_back(page, address, missing):
    def say(name: str, body: str) -> None:
        page.route(f"**/{name}", lambda route: route.fulfill(body=body, headers=SCRIPT))

    say("pyodide.mjs", RUNTIME)
    say("sympy.whl", "")
    say("probe.py", "")
    show(page, address)
    asked = """async (packages) => {
      const python = await import(`${location.origin}/in_place/python.js`);
      const answer = python.ask("probe.called", [], { packages });
      return answer.catch(({ kind, message }) => [kind, message]);
    }"""
    if missing != "probe.py":
        assert answer(page, asked, []) == "", "it has begun"
    page.route(f"**/{missing}", lambda route: route.abort())
    kind, message = answer(page, asked, ["sympy"])
    assert kind == "NotFetched"
    assert message.startswith(f"{missing} could not be fetched from 127.0.0.1")
    page.unroute(f"**/{missing}")
    say(missing, "")
    assert answer(page, asked, ["sympy"]) == "sympy"


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
