"""What is in the way of a live panel: an old browser, a file, and scripts that do not come."""

import pytest
from lively import figure_of, page_of, show

from driftlab.book import DriftExplorer, TurningBlock
from grouped import only_panel
from support import ROOT

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("site-in-place")]


@pytest.mark.parametrize(
    ("script", "says"),
    [
        ("delete window.WebAssembly", "This browser has no WebAssembly"),
        ("delete window.Worker", "Python could not be started"),
        ("", "could not be fetched"),
    ],
)
def test_whatever_is_in_the_way_is_one_sentence_and_the_picture_stays(page, address, script, says):
    page.add_init_script(script)
    if not script:
        page.route("**/in_place/panels.js", lambda route: route.abort())
    show(page, address, only_panel(DriftExplorer), only_panel(TurningBlock))
    figure = figure_of(page, DriftExplorer)
    figure.locator(".in-place-begin").click()
    note = figure.locator(".in-place-note", has_text=says)
    note.wait_for()
    assert page.locator(".in-place-note", has_text=says).count() == 1
    assert figure.locator("img").first.is_visible()
    assert page.complaints == [] or not script


def test_a_page_opened_as_a_file_says_what_it_needs(page, tmp_path):
    (tmp_path / "in_place").symlink_to(ROOT / "site/in_place")
    path = tmp_path / "page.html"
    path.write_text(page_of([only_panel(DriftExplorer)]), "utf-8")
    page.goto(path.as_uri())
    figure = figure_of(page, DriftExplorer)
    figure.locator(".in-place-begin").click()
    note = figure.locator(".in-place-note", has_text="needs a web server")
    assert note.locator("code").inner_text() == "python3 -m http.server"
    assert page.complaints == []
