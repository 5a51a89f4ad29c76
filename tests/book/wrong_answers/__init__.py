"""Wrong answers to every exercise, and words of what they must be told.

One module a chapter. The answers are made here, by hand or by a route of their own, as a student
would come to them; they do not come from the mistakes that the exercises know.
"""

from importlib import import_module
from pathlib import Path
from typing import Any

WRONG: dict[str, list[tuple[Any, str]]] = {
    number: answers
    for path in sorted(Path(__file__).parent.glob("ch*.py"))
    for number, answers in import_module(f"wrong_answers.{path.stem}").WRONG.items()
}
