"""All figures: they repeat, and the published files and captions are theirs."""

import base64
import html
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from driftlab.book import figures
from driftlab.book.__main__ import figures_that_begin, write_figures_on, write_gallery
from driftlab.book.machinery.figure.csv_table import as_words, numbers, read_table
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.publish import PublishedFigure, captions_in, gallery
from driftlab.book.machinery.figure.table_differences import table_differences
from driftlab.recordings.publishers import RecordingUnavailable
from published import NAMES, published

PUBLISHED = Path(__file__).parents[2] / "figures"


def published_captions() -> dict[str, str]:
    """Captions below the figures of the published gallery, by name."""
    return captions_in((PUBLISHED / "README.md").read_text(encoding="utf-8"))


@published(*NAMES)
def test_published_numbers_are_what_is_computed(figure: PublishedFigure) -> None:
    path = PUBLISHED / f"{figure.definition.name}.csv"
    if figure.definition.columns is None:
        assert not path.exists()
        return
    if missing := figures.not_at_hand(figure.definition):
        pytest.skip(missing)
    assert_same_table(path, figure.table())


@pytest.mark.parametrize(
    "name", [name for name, each in figures.figure_definitions().items() if each.is_kept]
)
def test_a_figure_that_is_read_from_its_csv_writes_it_again(name: str) -> None:
    """Without the recording, or the minutes, that it takes to compute it."""
    definition = figures.figure_definitions(name[:2])[name]
    path = PUBLISHED / f"{name}.csv"
    assert_same_table(path, definition.columns(DataTable.of_csv(*read_table(path))))


def assert_same_table(path: Path, columns: Mapping[str, Any]) -> None:
    """Fail unless a published CSV is what is computed, but for rounding of other processors."""
    published, computed = read_table(path)[1], as_words(columns)
    assert list(published) == list(computed)
    assert [each for each in table_differences(published, computed) if not each.only_rounding] == []


@published(*NAMES)
def test_picture_repeats_byte_by_byte_and_has_a_caption(
    figure: PublishedFigure, tmp_path: Path
) -> None:
    """Drawn twice from the same data, once for a file and once for a page."""
    name = figure.definition.name
    figure.write(tmp_path)
    written = {path.name for path in tmp_path.iterdir()}
    assert written == {path.name for path in PUBLISHED.glob(f"{name}.*")}
    picture = (tmp_path / f"{name}.svg").read_bytes()
    assert picture.startswith(b"<?xml")
    note = figures.not_at_hand(figure.definition)
    page = PublishedFigure(figure.definition, figure.data, None, note)._repr_html_()
    (shown,) = re.findall(r'src="data:image/svg\+xml;base64,([^"]*)"', page)
    repeats = base64.b64decode(shown) == picture
    assert repeats, "another drawing of the same data is another picture"
    assert figure.caption.endswith(".")
    assert page.count(html.escape(figure.caption)) == 2  # alt text and caption


@published(*NAMES)
def test_the_gallery_has_the_caption_that_is_computed(figure: PublishedFigure) -> None:
    caption = figure.definition.caption(figure.data)
    assert published_captions()[figure.definition.name] == caption


def test_the_folder_holds_the_catalogue_and_nothing_else() -> None:
    captions = published_captions()
    assert list(captions) == list(figures.figure_definitions())
    assert (PUBLISHED / "README.md").read_text(encoding="utf-8") == gallery(captions)
    definitions = figures.figure_definitions()
    names = {f"{name}.svg" for name in definitions}
    names |= {f"{name}.csv" for name, each in definitions.items() if each.columns}
    names |= {"04-larin-numbers.csv", "README.md"}
    assert {path.name for path in PUBLISHED.iterdir()} == names


def test_a_rebuild_writes_every_entry_the_gallery_and_larins_numbers(tmp_path: Path) -> None:
    definitions = {
        name: each
        for name, each in figures.figure_definitions().items()
        if name in ("00-frames", "05-cayley-map")
    }
    write_gallery(tmp_path, definitions)
    assert {path.name for path in tmp_path.iterdir()} == {
        "00-frames.svg",
        "05-cayley-map.svg",
        "05-cayley-map.csv",
        "04-larin-numbers.csv",
        "README.md",
    }
    captions = {name: each.caption(each.compute()) for name, each in definitions.items()}
    assert (tmp_path / "README.md").read_text(encoding="utf-8") == gallery(captions)
    for name in ("05-cayley-map.csv", "04-larin-numbers.csv"):
        written = read_table(tmp_path / name)[1]
        values = {title: numbers(column) for title, column in written.items()}
        computed = {
            title: written[title] if each is None else each for title, each in values.items()
        }
        assert_same_table(PUBLISHED / name, computed)


def test_one_figure_brings_its_caption_into_the_gallery(tmp_path: Path) -> None:
    page = tmp_path / "README.md"
    page.write_text(gallery({"05-cayley-map": "Another caption."}), encoding="utf-8")
    write_figures_on(tmp_path, figures_that_begin(["00-frames"]), 1, None, None)
    captions = captions_in(page.read_text(encoding="utf-8"))
    assert list(captions) == ["00-frames", "05-cayley-map"]
    assert captions["05-cayley-map"] == "Another caption."


def test_without_its_recording_a_figure_is_restored_and_its_files_are_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def nowhere(name: str, download: bool = True) -> Path:
        raise RecordingUnavailable(name)

    monkeypatch.setattr(figures, "published_file", nowhere)
    name = "13-hand-turns"
    definition = figures.figure_definitions("13")[name]
    shown, caption = figures.figure(name), published_captions()[name]
    assert shown.caption == f"{caption} {figures.not_at_hand(definition)}"
    assert "github.com/mad-lab-fau/imucal was not at hand" in shown.caption
    write_gallery(tmp_path, {name: definition})
    for path in PUBLISHED.glob(f"{name}.*"):
        assert (tmp_path / path.name).read_bytes() == path.read_bytes()
    assert (tmp_path / "README.md").read_text(encoding="utf-8") == gallery({name: caption})
    assert f"not at hand: {name}.\n" in capsys.readouterr().out


def test_unknown_figure() -> None:
    with pytest.raises(ValueError, match=r"name: expected one of 00-map-of-ideas.* got 'none'"):
        figures.figure("none")


def test_a_figure_draws_the_numbers_that_it_is_given() -> None:
    definition = figures.figure_definitions("02")["02-roots"]
    data = definition.compute()
    assert figures.figure("02-roots", data).data is data


def test_a_figure_at_a_prompt_says_what_it_is():
    figure = figures.figure("03-drift-map")
    assert repr(figure).startswith("driftlab.figure('03-drift-map')\n")
    assert figure.caption in repr(figure)
