"""Outputs of notebooks as pages have them: pictures, figures, exercises, puzzles, solutions."""

import base64
import io

import nbformat
from PIL import Image

from driftlab.book.machinery.exercise.card import Card
from driftlab.book.machinery.exercise.exercise import Verdict
from driftlab.book.machinery.exercise.hints import Help
from reading.outputs import Outputs
from reading.pictures import Pictures, size
from reading.solutions import link_back, link_to_solution

SVG = b'<svg xmlns="http://www.w3.org/2000/svg" width="72pt" height="36pt" viewBox="0 0 72 36"/>'


def shown(output, plain="", source="", page="03_systematic_drift"):
    """What a chapter's page has of one HTML output, and its pictures."""
    pictures = Pictures()
    cell = nbformat.v4.new_code_cell(source)
    cell.outputs = [
        nbformat.v4.new_output("display_data", {"text/html": output, "text/plain": plain})
    ]
    (made,) = Outputs(pictures, page, "03").shown(cell)
    return made.data["text/html"], pictures


def inlined(raw, kind):
    return (
        f'<img src="data:image/{kind};base64,{base64.b64encode(raw).decode()}" alt="two &amp; a">'
    )


def test_a_picture_becomes_one_file_however_often_it_is_shown():
    pictures = Pictures()
    twice = pictures.as_files(2 * inlined(SVG, "svg+xml"), "../")
    (name,) = pictures.files
    assert pictures.files[name] == SVG
    file = f"../_static/pictures/{name}"
    assert twice.count(f'src="{file}" alt="two &amp; a" loading="lazy"') == 2
    assert twice.count(f'<a class="picture" href="{file}"><img') == 2  # at its full size
    assert name.endswith(".svg")
    assert 'width="96" height="48"' in twice


def test_room_is_kept_for_every_kind_of_picture():
    file = io.BytesIO()
    Image.new("RGB", (30, 20)).save(file, "jpeg")
    assert size(file.getvalue()) == (30, 20)
    assert size(SVG) == (96, 48)
    assert size(b'<svg viewBox="0 0 640 310.5">') == (640, 310)


def test_a_figure_as_published_leads_to_its_numbers():
    figure = (
        f'<figure style="margin: 0">{inlined(SVG, "svg+xml")}<figcaption>x</figcaption></figure>'
    )
    page, _ = shown(figure, "driftlab.figure('03-drift-map')\nx")
    assert page.startswith('<figure class="driftlab-figure"><a class="picture"')
    assert 'href="gallery/index.html#figure-03-drift-map"' in page
    changed, _ = shown(figure, "driftlab.figure('03-drift-map', turns=2)\nx")
    assert "gallery" not in changed


def test_an_open_exercise_has_room_its_hints_and_its_solution():
    help_ = Help("Where it stands: (2.4)", "nudge", "idea")
    card = Card("3.2", Verdict(None, "not answered yet."), help_, (), "0 of 6 right")
    page, _ = shown(card._repr_html_())
    assert page.startswith('<div class="exercise" data-exercise="3.2"></div><div class="hints">')
    assert page.endswith(link_to_solution("3.2", "solutions/03_systematic_drift.html"))
    assert "href='#chapter-03-where-it-stands-2-4'" in page
    assert "nudge" in page
    assert "0 of 6 right" not in page


def test_a_puzzle_has_room_for_a_guess():
    asked = "<p><b>A guess first.</b></p><ul><li>How far?</li></ul>"
    page, _ = shown(f"{asked}<p>Run this cell in JupyterLab.</p>")
    assert page == f'<div class="guess" data-guess="03">{asked}</div>'


def test_what_needs_a_kernel_is_left_out():
    cell = nbformat.v4.new_code_cell()
    data = {"application/vnd.jupyter.widget-view+json": {"model_id": "1"}, "text/plain": "A panel"}
    cell.outputs = [nbformat.v4.new_output("display_data", data)]
    assert Outputs(Pictures(), "03_systematic_drift", "03").shown(cell) == []


def test_a_solution_is_a_place_and_leads_back():
    cell = nbformat.v4.new_markdown_cell("## 3.2 Slide\n\nThe coefficient.")
    link_back([cell], "03")
    assert cell.source == (
        "(solution-3-2)=\n## 3.2 Slide\n\n[To the exercise](#chapter-03-3-2-slide)\n\n"
        "The coefficient."
    )
