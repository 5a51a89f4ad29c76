"""In a column and on a page no words of a figure collide, none are cut off or too small to read."""

from collections.abc import Iterator
from itertools import combinations, islice
from pathlib import Path

import pytest
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from driftlab.book import figures
from driftlab.book.machinery.figure.publish import PublishedFigure
from driftlab.book.machinery.figure.sheet import COLUMN, PAGE, Sheet
from driftlab.book.machinery.panel.panel import Explorer
from grouped import every_panel, only_panel
from published import NAMES, published

LEAST_TYPE = 5.5
"""Points; journals ask for five to six at least."""
LEAST_PANEL = 0.5
"""Inches that a panel must have, both ways."""
TOUCHING = 1.5
"""Dots of a hundredth of an inch by which boxes around words may overlap: they have room inside."""


# A page is wider, so that what fits into a column has room there.
widths = pytest.mark.parametrize("width", [COLUMN, pytest.param(PAGE, marks=pytest.mark.long)])


def drawn_words(figure: Figure, monkeypatch: pytest.MonkeyPatch) -> list[tuple[Text, Bbox]]:
    """Every text that is drawn, with the box around it, in dots."""
    found = []
    draw = Text.draw

    def recorded(text: Text, renderer: object) -> None:
        draw(text, renderer)
        if text.get_visible() and text.get_text().strip():
            found.append((text, text.get_window_extent(renderer)))

    figure.dpi = 100
    with monkeypatch.context() as patch:
        patch.setattr(Text, "draw", recorded)
        figure.draw_without_rendering()  # finds the layout before it comes to any words
    return found


def collisions(figure: Figure, words: list[tuple[Text, Bbox]]) -> Iterator[str]:
    """Sentences on words that overlap, leave the figure, or are too small."""
    sheet = figure.bbox.padded(TOUCHING)
    for text, box in words:
        if not (sheet.containsx(box.x0) and sheet.containsx(box.x1)) or not (
            sheet.containsy(box.y0) and sheet.containsy(box.y1)
        ):
            yield f"{text.get_text()!r} leaves the figure"
        if text.get_fontsize() < LEAST_TYPE:
            yield f"{text.get_text()!r} is of {text.get_fontsize():.1f} points"
    for (one, a), (two, b) in combinations(words, 2):
        slanted = one.get_rotation() % 90 and one.get_rotation() == two.get_rotation()
        if not slanted and overlap(a, b):
            yield f"{one.get_text()!r} and {two.get_text()!r} overlap"
    for legend in figure.findobj(Legend):
        inside, frame = {id(text) for text in legend.findobj(Text)}, legend.get_window_extent()
        for text, box in words:
            if id(text) not in inside and overlap(box, frame):
                yield f"{text.get_text()!r} and a legend overlap"


def flaws(figure: Figure, width: float, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Sentences on what is wrong with a figure of so many inches."""
    found = list(collisions(figure, drawn_words(figure, monkeypatch)))
    if figure.get_figwidth() != width:
        found.append(f"it is {figure.get_figwidth():g} inches wide")
    for panel in (panel for panel in figure.axes if panel.get_label() != "<colorbar>"):
        box = panel.get_position()
        least = min(box.width * width, box.height * figure.get_figheight())
        if least < LEAST_PANEL:
            found.append(f"panel {panel.get_title('left')!r} is of {least:.2f} inches")
    return found


def overlap(a: Bbox, b: Bbox) -> bool:
    """Whether two boxes have more than a little in common."""
    both = Bbox.intersection(a, b)
    return both is not None and min(both.width, both.height) > TOUCHING


@published(*NAMES)
@widths
def test_no_words_collide(
    figure: PublishedFigure, width: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn = figure.definition.draw(figure.data, Sheet(width))
    drawn = getattr(drawn, "figure", drawn)
    assert isinstance(drawn, Figure)
    found = flaws(drawn, width, monkeypatch)
    assert not found, "; ".join(found)


@pytest.mark.slow
@every_panel
@pytest.mark.parametrize(
    ("width", "presets"),
    [(COLUMN, 1), *(pytest.param(width, None, marks=pytest.mark.long) for width in (COLUMN, PAGE))],
)
def test_no_words_of_a_panels_picture_collide(
    panel_class: type[Explorer], width: float, presets: int | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What it opens with, or shows with each preset."""
    panel = only_panel(panel_class)
    starts = {control.name: control.start for control in panel.controls}
    picture = panel.picture_class(Sheet(width))
    for name, preset in islice(panel.presets.items(), presets):
        picture.update(panel.compute({**starts, **preset}))
        found = flaws(picture.figure, width, monkeypatch)
        assert not found, f"{width} inches, {name}: {'; '.join(found)}"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ending", "begins"), [("pdf", b"%PDF"), ("svg", b"<?xml"), ("png", b"\x89PNG")]
)
def test_a_figure_is_saved_for_paper(tmp_path: Path, ending: str, begins: bytes) -> None:
    figure, width = figures.figure("06-cayley-map"), PAGE if ending == "pdf" else COLUMN
    one, two = (
        figure.save(tmp_path / f"{name}.{ending}", width=width).read_bytes() for name in "ab"
    )
    assert one.startswith(begins)
    assert one == two
    if ending == "pdf":
        assert b"/FontFile2" in one  # TrueType, embedded, as journals want it
        assert b"/Type3" not in one


def test_the_numbers_are_saved_too(tmp_path: Path) -> None:
    figure = figures.figure("03-drift-map", error_matrix=[[0, 0, 0], [1e-3, 0, 0], [0, 0, 0]])
    words = figure.save(tmp_path / "map.csv").read_text(encoding="utf-8")
    assert "figure('03-drift-map', error_matrix=[[0, 0, 0], [0.001, 0, 0], [0, 0, 0]])" in words


@pytest.mark.parametrize(
    ("path", "width", "sentence"),
    [
        ("map.jpeg", None, r"path: expected an ending of \.pdf, \.svg, \.png, \.csv, got 'map"),
        ("map.pdf", 2.0, r"width: expected inches between 3 and 12, such as 3\.5 .* got 2\."),
        ("map.pdf", 89.0, r"width: expected inches .* in mm\? 89 / 25\.4"),
        ("map.pdf", "column", r"width: "),
    ],
)
def test_refusals_of_save(path: str, width: object, sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        figures.figure("00-frames").save(path, width)


def test_a_drawing_has_no_numbers(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="00-frames is a drawing: it shows no numbers"):
        figures.figure("00-frames").save(tmp_path / "frames.csv")


def test_refusals_of_parameters() -> None:
    with pytest.raises(ValueError, match="03-drift-map: expected error_matrix, got 'matrix'"):
        figures.figure("03-drift-map", matrix=0)
    with pytest.raises(ValueError, match="03-drift-map: expected data or parameters, got both"):
        figures.figure("03-drift-map", 1, error_matrix=0)
