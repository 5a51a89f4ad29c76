"""What is in the way of a live panel: no network, an old browser, a file, and too much at once."""

import re
import shutil
import subprocess

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
OPENED = """workers[0].onmessage({ data: { id: workers[0].asked[0].id, result: {
  panel: 0, title: "", values: {}, refused: "",
  widget: {
    id: 1, kind: "HTML",
    state: { value: "It lives.", layout: { id: 2, kind: "Layout", state: { display: null } } },
  },
} } })"""
"""A panel of one paragraph."""
SCRIPT = {"content-type": "text/javascript"}


def test_two_links_at_once_make_one_panel(page, address):
    page.add_init_script(WORKERS)
    show(page, address, DriftExplorer(), link="#panel=DriftExplorer&azimuth=-30")
    page.wait_for_function("window.workers[0]?.asked.length")
    page.evaluate("location.hash = 'panel=DriftExplorer&azimuth=40'")
    page.wait_for_timeout(100)
    page.evaluate(OPENED)
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


@pytest.mark.parametrize("missing", ["pyodide-lock.json", "sympy.whl", "probe.py"])
def test_what_did_not_come_is_named_and_comes_when_the_network_is_back(page, address, missing):
    def say(name: str, body: str) -> None:
        page.route(f"**/{name}", lambda route: route.fulfill(body=body, headers=SCRIPT))

    say("pyodide.mjs", RUNTIME)
    say("pyodide-lock.json", '{"packages": {}}')
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
    say(missing, '{"packages": {}}')
    assert answer(page, asked, ["sympy"]) == "sympy"


def test_a_move_made_while_a_link_is_refused_is_sent_all_the_same(page, address):
    page.add_init_script(WORKERS)
    show(page, address)
    script = """async () => {
      const { Conversation } = await import(`${location.origin}/in_place/models.js`);
      const said = [];
      const widget = { id: 1, kind: "Slider", state: { value: 0 } };
      const conversation = new Conversation({ panel: 0, widget }, {
        onBusy: (busy) => said.push(busy),
        onNews() {},
        onTrouble: (error) => said.push(error.message),
      });
      conversation.goTo({ azimuth: "west" });
      conversation.root.set("value", 7);
      conversation.root.save_changes();
      const [{ asked, onmessage }] = workers;
      const done = () => new Promise((resolve) => setTimeout(resolve));
      onmessage({ data: { id: asked[0].id, error: { kind: "ValueError", says: "No." } } });
      await done();
      const news = { changed: {}, messages: [], values: {} };
      onmessage({ data: { id: asked[1].id, result: news } });
      await done();
      return [asked.map(({ call, args }) => [call, args[1]]), said];
    }"""
    asked, said = answer(page, script)
    assert asked == [["panels.set", {"azimuth": "west"}], ["panels.move", [[1, "value", 7]]]]
    assert said == [True, False, "No."], "and what was refused is the last word"


def test_with_the_end_of_python_nothing_waits_to_start_it_again(page, address):
    page.add_init_script(WORKERS)
    show(page, address, DriftExplorer())
    figure_of(page, DriftExplorer).locator(".in-place-begin").click()
    page.wait_for_function("window.workers[0]?.asked.length")
    page.evaluate(OPENED)
    page.locator(".in-place-live").wait_for()
    link = "location.hash = 'panel=DriftExplorer&azimuth={}'"
    page.evaluate(link.format(40))
    page.wait_for_function("workers[0].asked.length === 2")
    page.evaluate(link.format(50))
    page.wait_for_timeout(100)
    page.get_by_role("button", name="Stop").click()
    page.locator(".in-place-note", has_text="Python was stopped").wait_for()
    assert page.evaluate("workers.length") == 1
    assert page.complaints == []


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


OLD = """
window.Function = function (text) {
  if (text) throw new SyntaxError("this browser is old");
};"""


def test_a_browser_that_cannot_read_the_scripts_is_told_so_once_in_each_place(page, address):
    page.add_init_script(OLD)
    asked = []
    page.on("request", lambda request: asked.append(request.url))
    show(page, address, DriftExplorer(), CapstoneExplorer())
    note = page.locator(".in-place-note", has_text="needs a newer browser")
    note.wait_for()
    assert note.count() == 1
    assert figure_of(page, DriftExplorer).locator(".in-place-note").count() == 1
    assert figure_of(page, DriftExplorer).locator("img").is_visible()
    assert not any(name in url for url in asked for name in ("offer.js", "panels.js"))
    assert page.complaints == []


def test_scripts_that_do_not_come_are_told_of(page, address):
    page.route("**/in_place/offer.js", lambda route: route.abort())
    show(page, address, DriftExplorer())
    page.locator(".in-place-note", has_text="could not be fetched").wait_for()
    assert figure_of(page, DriftExplorer).locator("img").is_visible()


def test_an_old_browser_reads_the_first_script():
    """ECMAScript 5; the others are not, which shows that it was looked for."""
    if not (node := shutil.which("node")):
        pytest.skip("the parser is Node's own, and Node is not installed")
    parse = """
      const { parse } = require("internal/deps/acorn/acorn/dist/acorn");
      parse(require("fs").readFileSync(process.argv[1], "utf-8"), { ecmaVersion: 5 });
    """

    def reads(name: str) -> subprocess.CompletedProcess:
        command = [node, "--expose-internals", "-e", parse, str(ROOT / "site/in_place" / name)]
        return subprocess.run(command, capture_output=True, encoding="utf-8")

    assert reads("begin.js").stderr == ""
    assert "SyntaxError" in reads("offer.js").stderr


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
