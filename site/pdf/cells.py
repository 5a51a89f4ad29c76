"""A notebook as Markdown for pandoc, with calls of the template's functions where it has cells.

On paper nothing answers: cells that only wait for an answer are left out, and their cards; a
guess is a question with room for it.
"""

from __future__ import annotations

import html
import json
import re
import unicodedata
from collections.abc import Iterator
from pathlib import Path

from nbformat import NotebookNode

from pdf.pictures import paper_width, picture, plain_svg

ROOT = Path(__file__).resolve().parent.parent.parent

FENCE = "`" * 12
CARD = "<div role='status'"
FORMULA = re.compile(r"`[^`]*`|\$([^$\n]+)\$")
IMAGE = re.compile(r"^!\[([^\]]*)\]\(\.\./(figures/([\w-]+)\.svg)\)$", re.M)
WAY_ON = re.compile(r"(Next|Back|Contents): \[")
"""The last line of a chapter, which leads to the next one."""
PROGRESS = re.compile(r"\r *\d+%\|[^\r\n]*")
QUESTIONS = re.compile(r"<li>(.*?)</li>", re.S)
WAITS = re.compile(r"answer = \.\.\.$|because = \.\.\.|check\(|guess\(|(from|import) |$")
"""Lines of a cell that only waits for the reader."""
ASKS = re.compile(
    r"^((answer|because) = \.\.\..*|check\(.*|from driftlab\.book import check)\n*", re.M
)
"""Lines of a cell that waits, but also names the letters in which it is to be answered."""
NO_FONT = re.compile(r"[\u0590-\u0dff\u3040-\ud7af]")
"""Letters of a name, say, in an alphabet that no font of the book has."""
REMARK = re.compile(r"</div><div>(.*?)</div>", re.S)
SAID_TO_THE_READER = ("You had it", "Your first guess", "The section that helps", "<details>")
ON_PAPER = (
    (r"The answer is collapsed, so that[^\n]*", ""),
    (
        r"Put your answer in place of the three dots [^.]*\. (\[How exercises work\])",
        r"Answers are checked in the notebook, or on the web page of this chapter. \1",
    ),
    (
        r"In a notebook, put it in place of the three dots and run the cell; on a [^.]*\.",
        "Answers are checked in the notebook, or on the web page of the chapter.",
    ),
)
"""What the text says of a screen, and what it says here."""
STATEMENTS = re.compile(r"(?:^- \([a-z]\) .*\n?)+", re.M)
FIGURE = re.compile(r'\bfigure\("([\w-]+)"')


def call(function: str, *arguments: str | float, **options: str | float) -> str:
    """Return a block of Markdown that calls a function of the template."""
    # Typst writes strings as JSON does, but for control characters, of which there are none.
    said = [json.dumps(argument, ensure_ascii=False) for argument in arguments]
    said += [f"{key}: {json.dumps(value, ensure_ascii=False)}" for key, value in options.items()]
    return typst(f"#{function}({', '.join(said)})")


def typst(text: str) -> str:
    """Return a block of Markdown that is Typst."""
    return f"{FENCE}{{=typst}}\n{text}\n{FENCE}"


def markdown_of(notebook: NotebookNode, name: str, folder: Path, *, with_code: bool = True) -> str:
    """Return a notebook as Markdown.

    `name` and a number name each picture, which is written into the folder.
    """
    blocks: list[str] = []
    for number, cell in enumerate(notebook.cells):
        if cell.cell_type == "markdown":
            if not WAY_ON.match(cell.source):
                blocks.append(IMAGE.sub(lambda found: _drawn(found, folder), said(cell.source)))
        elif cell.cell_type == "code":
            if with_code:
                blocks += _code(cell)
            for place, output in enumerate(cell.outputs):
                blocks += _output(output, cell.source, f"{name}-{number}-{place}", folder)
    return "\n\n".join(blocks) + "\n"


def said(text: str) -> str:
    """Return a cell's Markdown as paper says it."""
    for on_screen, on_paper in ON_PAPER:
        text = re.sub(on_screen, on_paper, text)
    return STATEMENTS.sub(lambda found: "\n\n".join(within("statements", found[0])), text)


def within(function: str, text: str) -> list[str]:
    """Return blocks of Markdown that give a text to a function of the template."""
    return [typst(f"#{function}["), text, typst("]")]


def _drawn(image: re.Match[str], folder: Path) -> str:
    """A picture of the gallery that stands in the text."""
    content = plain_svg((ROOT / image[2]).read_text("utf-8")).encode()
    (folder / f"{image[3]}.svg").write_bytes(content)
    shown = f"pictures/{image[3]}.svg"
    return call("drawing", shown, image[1], width=paper_width(content), name=image[3])


def _code(cell: NotebookNode) -> Iterator[str]:
    if not all(WAITS.match(line) for line in cell.source.splitlines()):
        is_short = cell.source.count("\n") < 3
        shows = any(
            "<figure" in output.get("data", {}).get("text/html", "")
            or (is_short and output.get("data", {}).get("text/markdown", "").startswith("|"))
            for output in cell.outputs
        )
        source = ASKS.sub("", cell.source) if "answer = ..." in cell.source else cell.source
        yield call("code", source.rstrip(), sticky=shows)


def _output(output: NotebookNode, source: str, name: str, folder: Path) -> Iterator[str]:
    data = output.get("data", {})
    if output.output_type == "stream":
        if words := PROGRESS.sub("", output.text).rstrip("\n"):
            yield call("output", NO_FONT.sub(_box, words))
    elif "text/html" in data:
        yield from _html(data["text/html"], source, name, folder)
    elif "text/latex" in data:
        formula = re.sub(r"^\$+\s*(\\displaystyle\s*)?|\$+$", "", data["text/latex"].strip())
        yield from within("result", f"$${formula}$$")
    elif "text/markdown" in data:
        yield tight(data["text/markdown"])
    elif "text/plain" in data and not any("widget-view" in kind for kind in data):
        yield call("output", data["text/plain"])


def _box(letter: re.Match[str]) -> str:
    """A box in place of a letter, as wide as it would be; an accent has no width."""
    if unicodedata.combining(letter[0]) or unicodedata.category(letter[0]) == "Mc":
        return ""
    return "□ " if unicodedata.east_asian_width(letter[0]) == "W" else "□"


def _html(markup: str, source: str, name: str, folder: Path) -> Iterator[str]:
    shown = picture(markup, folder, name)
    if shown is not None:
        called = FIGURE.search(source)
        yield call(
            "still" if shown.is_still else "drawing",
            f"pictures/{shown.file}",
            shown.caption,
            width=shown.width,
            name=called[1] if called else "",
        )
    elif markup.startswith(CARD):
        remarks = [plain(remark) for remark in REMARK.findall(markup) if _is_kept(remark)]
        if "Right</b>" in markup and remarks:
            yield call("remark", " ".join(remarks))
    elif questions := QUESTIONS.findall(markup):
        yield call("guess", *(plain(question) for question in questions))


def tight(text: str) -> str:
    """Return Markdown whose formulas have no blanks at their ends, or pandoc sees none."""
    return FORMULA.sub(lambda found: f"${found[1].strip()}$" if found[1] else found[0], text)


def _is_kept(remark: str) -> bool:
    return not remark.startswith(SAID_TO_THE_READER)


def plain(markup: str) -> str:
    """Return HTML as plain words."""
    return html.unescape(re.sub(r"<[^>]+>", "", markup)).replace("\xa0", " ").strip()
