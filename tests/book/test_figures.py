"""All figures: they repeat, and the published files and captions are theirs."""

import base64
import html
import re
from pathlib import Path

import pytest

from driftlab.book import figures
from driftlab.book.__main__ import figures_that_begin, write_figures_on, write_gallery
from driftlab.book.machinery.figure.csv_table import as_words, read_table
from driftlab.book.machinery.figure.data_table import KEPT, DataTable
from driftlab.book.machinery.figure.publish import PublishedFigure, captions_in, gallery
from driftlab.book.machinery.figure.table_differences import Difference, table_differences
from driftlab.recordings.publishers import RecordingUnavailable
from published import NAMES, published

PUBLISHED = Path(__file__).parents[2] / "figures"


def published_captions() -> dict[str, str]:
    """Captions below the figures of the published gallery, by name."""
    return captions_in((PUBLISHED / "README.md").read_text(encoding="utf-8"))


@published(*NAMES)
def test_published_files_are_what_is_computed(figure: PublishedFigure, tmp_path: Path) -> None:
    """Numbers to rounding, the lines above them, the words of the picture, and the caption."""
    name, note = figure.definition.name, figures.not_at_hand(figure.definition)
    figure.write(tmp_path)
    written = {path.name for path in tmp_path.iterdir()}
    assert written == {path.name for path in PUBLISHED.glob(f"{name}.*")}
    if figure.definition.columns:
        (lines, table), (kept_lines, kept) = (
            read_table(folder / f"{name}.csv") for folder in (tmp_path, PUBLISHED)
        )
        assert other_numbers(kept, table) == []
        assert note or [*map(without_numbers, lines)] == [*map(without_numbers, kept_lines)]
        made = next(line for line in lines if line.startswith("made by: "))
        assert re.search(rf"driftlab \d+\.\d+\.\d+, driftlab\.figure\('{name}'\)", made)
    pictures = [(folder / f"{name}.svg").read_bytes() for folder in (tmp_path, PUBLISHED)]
    assert pictures[0].startswith(b"<?xml")
    assert words_of(pictures[0]) == words_of(pictures[1])
    caption = published_captions()[name]
    assert figure.definition.caption(figure.data) == caption
    assert caption.endswith(".")


def words_of(picture: bytes) -> list[tuple[str, str]]:
    """What is written in an SVG: Matplotlib notes it beside the shapes of its letters."""
    return re.findall(r"<!-- (.*?) -->|<text[^>]*>(.*?)</text>", picture.decode(), re.DOTALL)


def without_numbers(line: str) -> str:
    """A line without the version, and without the digits of facts, which processors round."""
    line = re.sub(r"driftlab \d+\.\d+\.\d+", "driftlab", line).rstrip()
    if line.startswith(KEPT):
        return KEPT
    is_fact = re.search(r"^[^\s,=\"]+.*: -?[\d.]+(e[-+]\d+)?\S*( \S+)?$", line)
    return line.rpartition(": ")[0] if is_fact else line


def other_numbers(kept: dict[str, list[str]], computed: dict[str, list[str]]) -> list[Difference]:
    """What differs between two tables by more than the rounding of other processors."""
    assert list(kept) == list(computed)
    return [each for each in table_differences(kept, computed) if not each.only_rounding]


@pytest.mark.parametrize(
    "name", [name for name, each in figures.figure_definitions().items() if each.is_kept]
)
def test_a_figure_that_is_read_from_its_csv_writes_it_again(name: str) -> None:
    """Without the recording, or the minutes, that it takes to compute it."""
    definition = figures.figure_definitions(name[:2])[name]
    comments, kept = read_table(PUBLISHED / f"{name}.csv")
    again = definition.columns(DataTable.of_csv(comments, kept))
    assert other_numbers(kept, as_words(again)) == []


@pytest.mark.slow
def test_a_page_shows_the_picture_drawn_again_to_the_byte() -> None:
    """And its caption, which is its alt text too."""
    for name in ("00-frames", "06-cayley-map"):
        first, again = figures.figure(name), figures.figure(name)
        page = again._repr_html_()
        (shown,) = re.findall(r'src="data:image/svg\+xml;base64,([^"]*)"', page)
        repeats = base64.b64decode(shown) == first.svg()
        assert repeats, f"{name}: another drawing of the same data is another picture"
        assert page.count(html.escape(again.caption)) == 2


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
        if name in ("00-frames", "06-cayley-map")
    }
    write_gallery(tmp_path, definitions)
    assert {path.name for path in tmp_path.iterdir()} == {
        "00-frames.svg",
        "06-cayley-map.svg",
        "06-cayley-map.csv",
        "04-larin-numbers.csv",
        "README.md",
    }
    captions = {name: each.caption(each.compute()) for name, each in definitions.items()}
    assert (tmp_path / "README.md").read_text(encoding="utf-8") == gallery(captions)
    for name in ("06-cayley-map.csv", "04-larin-numbers.csv"):
        tables = (read_table(folder / name)[1] for folder in (PUBLISHED, tmp_path))
        assert other_numbers(*tables) == []


def test_one_figure_brings_its_caption_into_the_gallery(tmp_path: Path) -> None:
    page = tmp_path / "README.md"
    page.write_text(gallery({"06-cayley-map": "Another caption."}), encoding="utf-8")
    write_figures_on(tmp_path, figures_that_begin(["00-frames"]), 1, None, None)
    captions = captions_in(page.read_text(encoding="utf-8"))
    assert list(captions) == ["00-frames", "06-cayley-map"]
    assert captions["06-cayley-map"] == "Another caption."


def test_without_its_recording_a_figure_is_restored_and_its_files_are_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def nowhere(name: str, download: bool = True) -> Path:
        raise RecordingUnavailable(name)

    monkeypatch.setattr(figures, "published_file", nowhere)
    name = "17-hand-turns"
    definition = figures.figure_definitions("17")[name]
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
