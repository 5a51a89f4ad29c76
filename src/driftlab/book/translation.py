"""Catalogues for translators: ``python -m driftlab.book translation ru``.

What the book says to a reader stands in its code, as ``tr("...")``, or is data of its chapters:
exercises, hints, puzzles, panels. Both are gathered here into the catalogue of a language, in which
a translator writes with any editor for gettext, such as Poedit, and the catalogue is compiled.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cache
from io import BytesIO
from pathlib import Path
from string import Formatter
from typing import Any, NamedTuple

from .chapters import chapters_with, part_of
from .exercises import all_exercises, hints_of
from .machinery.answers import NOT_ALL, NOT_ONE, SAY_WHY
from .machinery.card import SECTION, SIGNS
from .machinery.exercise import key_of
from .machinery.formulas import EXCHANGED, Formula
from .machinery.guess import FIRST, HOW_TO_SEE, KEPT, UNANSWERED, UNITS as GUESS_UNITS
from .machinery.language import DOMAIN, ENGLISH, FOLDER, MODELS, Filled, speaking
from .machinery.matplotlib_view import MatplotlibView
from .machinery.panel import OWN_VALUES, Explorer
from .machinery.puzzle import PARTS, Number
from .machinery.reading import Slider
from .machinery.revealed import WITHOUT_GUESS
from .machinery.scene.spoken import words_of
from .machinery.scene.view import SceneView
from .machinery.sizes import NUMBERS, ORDINALS
from .machinery.slips import UNITS
from .panels import EXPLORERS, SCENES
from .translated_notebooks import Standing, standings

KEYWORDS: dict[str, Any] = {"tr": None, "tr_number": (1, 2)}
"""The functions whose first arguments are to be translated; the second one counts."""


class Coverage(NamedTuple):
    """How far a translation has come.

    Attributes
    ----------
    translated, total : int
        Texts of the catalogue.
    misplaced : tuple of str
        English texts whose translation has other places for values; it is not used.
    notebooks : dict of str to Standing
        How each notebook of the language stands beside the English one.
    """

    translated: int
    total: int
    misplaced: tuple[str, ...]
    notebooks: dict[str, Standing]

    def __str__(self) -> str:
        lines = [f"{self.translated} of {self.total} texts are translated."]
        lines += [f"Other places than in the English text: {text}" for text in self.misplaced]
        lines += [f"{name}: {standing}" for name, standing in self.notebooks.items()]
        return "\n".join(lines)


def texts() -> Iterator[tuple[str, str]]:
    """Yield what the chapters' data say to a reader, each with where it stands."""
    for number, exercise in all_exercises().items():
        where = f"exercise {number}"
        yield from ((exercise.remark, where), *((says, where) for says in _told(exercise)))
        if unit := getattr(exercise, "unit", ""):
            yield unit, where
        if isinstance(panel := getattr(exercise, "from_panel", None), Slider):
            yield panel.says, where
    for chapter in chapters_with("exercises"):
        for number, help_ in hints_of(chapter).items():
            yield from ((text, f"hint {number}") for text in help_._replace(model=""))
    for chapter in chapters_with("puzzle"):
        puzzle = part_of(chapter, "puzzle").PUZZLE
        for question in puzzle.questions:
            own = (question.unit,) if isinstance(question, Number) else question.options
            yield from ((text, f"puzzle {chapter}") for text in (question.asks, *own))
        yield puzzle.says, f"puzzle {chapter}"
    for panel in (*EXPLORERS, *SCENES):
        where = f"panel {panel.__name__}"
        # mypy takes the hash of a panel for that of its class, which has one.
        yield from ((text, where) for text in shown_by(panel))  # type: ignore[arg-type]
        yield from ((text, where) for text in (panel.title, *panel.presets))
        yield from ((text, where) for text in panel.look_for.values())
        for control in panel.controls:
            yield from ((text, where) for text in (control.label, control.group, *control.choices))
    constants = [*(f"{word}." for word in SIGNS), *(sign for sign, _ in SIGNS.values())]
    constants += [*PARTS.values(), WITHOUT_GUESS]
    constants += [HOW_TO_SEE, KEPT, UNANSWERED, OWN_VALUES, *GUESS_UNITS.values()]
    constants += [NOT_ALL, NOT_ONE, SAY_WHY, SECTION, FIRST, EXCHANGED, NUMBERS, *ORDINALS]
    constants += [unit for kind in UNITS.values() for unit in kind]
    yield from ((text, "machinery") for text in constants)


def models() -> Iterator[tuple[str, str]]:
    """Yield how the book answers in words, each with the exercise."""
    for chapter in chapters_with("exercises"):
        for number, help_ in hints_of(chapter).items():
            yield help_.model, f"exercise {number}"


@cache
def shown_by(panel: type[Explorer]) -> tuple[str, ...]:
    """Return the words that stand in a panel with any of its presets."""
    found: dict[str, None] = {}
    with speaking(ENGLISH):
        built = panel()
        if isinstance(built.view, MatplotlibView):
            found |= dict.fromkeys(built.view.words)
        starts = {control.name: control.start for control in panel.controls}
        for preset in panel.presets.values():
            data = built.compute({**starts, **preset})
            found |= dict.fromkeys(built.numbers(data).words())
            if isinstance(built.view, SceneView):
                found |= dict.fromkeys(words_of(built.view.stage(data)))
    return tuple(word for word in found if is_word(word))


def is_word(text: str) -> bool:
    """Whether there is something to translate: no number, sign or single letter."""
    return not isinstance(text, Filled) and bool(re.search(r"[^\W\d_]{2}", text))


def _told(exercise: Any) -> Iterator[str]:
    """What an exercise says of wrong answers."""
    mistakes = key_of(exercise).mistakes
    values = isinstance(exercise, Formula) or hasattr(exercise, "tolerance")
    yield from (mistakes if values else filter(None, mistakes.values()))


def gathered(domain: str = DOMAIN) -> dict[tuple[str, ...], list[str]]:
    """Return the texts of a catalogue, each with its plural if it counts, and where it stands."""
    from babel.messages.extract import extract_from_file

    if domain == MODELS:
        return {(text,): [where] for text, where in models() if text}
    found: dict[tuple[str, ...], list[str]] = {}
    for path in sorted(Path(__file__).parent.rglob("*.py")):
        where = path.relative_to(Path(__file__).parent).as_posix()
        for _, message, _, _ in extract_from_file("python", path, keywords=KEYWORDS):
            found.setdefault((message,) if isinstance(message, str) else message, []).append(where)
    for text, where in texts():
        if text.strip():
            found.setdefault((text,), []).append(where)
    return found


def update(language: str) -> Coverage:
    """Bring the catalogues of a language up to date, and compile them.

    Parameters
    ----------
    language : str
        Its code, as "ru"; one that is not there yet begins empty.

    Returns
    -------
    Coverage
        How far it has come. Texts that nobody says any more are dropped, and a text that has
        changed is to be translated anew.
    """
    both = [_updated(language, domain) for domain in (DOMAIN, MODELS)]
    done = sum(bool(message.id) and _is_done(message) for each in both for message in each)
    wrong = tuple(text for each in both for text in misplaced(each))
    return Coverage(done, sum(map(len, both)), wrong, standings(language))


def _updated(language: str, domain: str) -> Any:
    """Write one catalogue, and return it."""
    from babel.messages.catalog import Catalog
    from babel.messages.mofile import write_mo
    from babel.messages.pofile import read_po, write_po

    path = FOLDER / language / "LC_MESSAGES" / f"{domain}.po"
    template = Catalog(project="driftlab", charset="utf-8", fuzzy=False)
    for message, where in gathered(domain).items():
        places = [(place.replace(" ", "-"), 0) for place in dict.fromkeys(where)]
        flags = ["python-brace-format"] if "{" in message[0] else []
        template.add(message if len(message) > 1 else message[0], locations=places, flags=flags)
    catalog = Catalog(locale=language, project="driftlab", charset="utf-8", fuzzy=False)
    if path.exists():
        catalog = read_po(BytesIO(path.read_bytes()), locale=language, charset="utf-8")
    catalog.update(template, no_fuzzy_matching=True, update_creation_date=False)
    catalog.obsolete.clear()
    catalog.project, catalog.version = "Drift Lab", "book"
    catalog.last_translator = catalog.language_team = "Drift Lab"
    catalog.msgid_bugs_address = ""
    catalog.revision_date = catalog.creation_date
    path.parent.mkdir(parents=True, exist_ok=True)
    for suffix, write in ((".po", _po(write_po)), (".mo", write_mo)):
        made = BytesIO()
        write(made, catalog)
        path.with_suffix(suffix).write_bytes(made.getvalue())
    return catalog


def misplaced(messages: Iterable[Any]) -> Iterator[str]:
    """Yield the English texts whose translation has not the places for values that they have."""
    for message in messages:
        english = message.id if isinstance(message.id, tuple) else (message.id,)
        others = message.string if isinstance(message.string, tuple) else (message.string,)
        every = set().union(*map(_places, english))
        # One form of a text that counts may spell the number out: "a power of ten".
        least = every - {"count", "word"} if len(english) > 1 else every
        for text in filter(None, others if message.id else ()):
            if not least <= _places(text) <= every | ({"count"} if len(english) > 1 else set()):
                yield english[0]
                break


def _places(text: str) -> set[str]:
    """The places that a text names; a conversion or a format is the code's, not the text's."""
    try:
        found = [place for place in Formatter().parse(text) if place[1] is not None]
    except ValueError:
        return {text}
    return {"".join(filter(None, place[1:])) for place in found}


def _po(write: Any) -> Any:
    """Write without the date, which would make each catalogue another one."""
    return lambda file, catalog: write(
        file, catalog, width=100, omit_header=False, sort_output=True
    )


def _is_done(message: Any) -> bool:
    words = message.string if isinstance(message.string, tuple) else (message.string,)
    return all(words) and not message.fuzzy
