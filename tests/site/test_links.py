"""Links of the site lead somewhere, and nothing is asked of other places."""

import re
from html.parser import HTMLParser
from urllib.parse import unquote

import pytest
from requests_of import requests_of

from addresses import DOCS, LINK, file_of, page_of
from reading.links import with_links
from reading.make import docs_page


@pytest.mark.parametrize(
    ("link", "led"),
    [
        ("03_systematic_drift.ipynb", "03_systematic_drift.ipynb"),
        ("03_systematic_drift.ipynb#Derive", "03_systematic_drift.ipynb#derive"),
        ("#Where-axes,-signs%20and-names-differ", "#where-axes-signs-and-names-differ"),
        ("../ERRATA.md", "/errata.md"),
        ("../README.md", "/index.md"),
        ("../figures/README.md", "/gallery/index.md"),
        ("../docs/using.md#As-a-web-site", "/docs/using.md#as-a-web-site"),
        ("../figures/03-drift-map.svg", "/gallery/03-drift-map.svg"),
        ("https://example.org/a.ipynb", "https://example.org/a.ipynb"),
        ("picture.svg", "picture.svg"),
    ],
)
def test_links_of_the_notebooks_lead_to_places_of_the_site(link, led):
    assert with_links(f"See [it]({link}).", "02_x.ipynb") == f"See [it]({led})."


def test_links_of_solutions_begin_in_their_folder():
    text = "[a](../../ERRATA.md#x) ![b](../../figures/p.svg) [c](../03_x.ipynb#Bend,-too) [d](#E)"
    name = "solutions/02_x.ipynb"
    assert with_links(text, name) == (
        "[a](/errata.md#x) ![b](/gallery/p.svg) [c](../03_x.ipynb#bend-too) [d](#e)"
    )
    assert file_of("../03_x.ipynb", name) == "notebooks/03_x.ipynb"
    assert page_of(file_of("", name)) == "solutions/02_x"
    assert page_of(file_of("../../figures/README.md", name)) == "gallery/index"


def test_links_of_pages_for_users_begin_in_their_folder():
    text = "[a](commands.md#x) [b](../notebooks/02_x.ipynb) ![c](../figures/p.svg) [d](#E) `e`"
    assert with_links(text, "../docs/using.md") == (
        "[a](/docs/commands.md#x) [b](/02_x.ipynb) ![c](/gallery/p.svg) [d](#e) `e`"
    )


def test_pages_for_users_link_to_nothing_that_the_site_has_not():
    for name in DOCS:
        for link in LINK.findall(docs_page(name)):
            assert link.startswith(("/", "#")), (name, link)
    assert "deployment/README.md is for a class" in docs_page("docs/platforms")


def test_names_in_the_notebooks_lead_to_the_reference():
    text = "`driftlab.align`, `driftlab.x`, ``driftlab.align``, `align`"
    assert with_links(text, "02_x.ipynb") == "{py:obj}" + text


def test_what_a_page_would_fetch_from_elsewhere_is_found(tmp_path):
    (tmp_path / "quiet.html").write_text(
        '<a href="https://example.org">a link</a><script src="own.js"></script>'
        '<link rel="stylesheet" href="own.css"><img src="data:image/png;base64,">',
        "utf-8",
    )
    assert requests_of(tmp_path) == []
    (tmp_path / "loud.html").write_text(
        '<img src="//a.example/x.png"><link rel="preload" href="https://b.example/f.woff2">',
        "utf-8",
    )
    (tmp_path / "loud.css").write_text("@import url('https://c.example/f.css');", "utf-8")
    assert requests_of(tmp_path) == [
        "loud.html: //a.example/x.png",
        "loud.html: https://b.example/f.woff2",
        "loud.css: https://c.example/f.css",
    ]


def test_pages_ask_nothing_of_other_places_and_tables_are_tables(site):
    assert requests_of(site) == []
    for path in site.rglob("*.html"):
        if "_modules" not in path.parts:
            assert "| --- |" not in path.read_text("utf-8"), path


class Links(HTMLParser):
    """Places of a page, and the addresses that it links to or shows."""

    def __init__(self, path):
        super().__init__()
        self.places, self.links = set(), set()
        self.feed(path.read_text("utf-8"))

    def handle_starttag(self, tag, attrs):
        for key, value in attrs:
            if key == "id":
                self.places.add(value)
            elif key in ("href", "src") and not re.match(r"[a-z]+:", value):
                self.links.add(unquote(value))


def test_every_link_on_the_site_leads_somewhere(site):
    pages = {path.resolve(): Links(path) for path in site.rglob("*.html")}
    dead = []
    for path, page in pages.items():
        for link in page.links:
            file, _, place = link.partition("#")
            target = (path.parent / file.partition("?")[0]).resolve() if file else path
            there = target.exists() and (not place or place in pages[target].places)
            if notebook := re.search(r"live/lab/index\.html\?path=(.+)$", link):
                there = there and (site / "live/files" / notebook[1]).exists()
            dead += [] if there else [f"{path.relative_to(site)}: {link}"]
    assert dead == []
