"""What lecturers keep for themselves is in the folder of the book and not on its site."""

import json
import re

import pytest

from executed import FOLDER, notebooks, published
from pdf.contents import PARTS, chosen

NOT_PUBLISHED = "instructors"
"""Folder of what students should not find, the examination above all."""


def test_the_examination_is_there_to_be_printed_and_not_among_the_pages():
    assert "instructors/examination.ipynb" in notebooks()
    assert set(notebooks()) - set(published()) == {
        path.relative_to(FOLDER).as_posix() for path in (FOLDER / NOT_PUBLISHED).rglob("*.ipynb")
    }


def test_nothing_of_it_is_in_the_book_on_paper():
    assert not any(name.startswith(NOT_PUBLISHED) for part in PARTS
                   for name in chosen(part, notebooks()))  # fmt: skip


@pytest.mark.parametrize("name", published())
def test_no_page_leads_to_it_nor_shows_its_answers(name):
    cells = json.loads((FOLDER / name).read_text("utf-8"))["cells"]
    text = "\n".join("".join(cell["source"]) for cell in cells)
    assert not re.search(rf"\]\([^)]*{NOT_PUBLISHED}/", text)
    assert "exam_paper" not in text
