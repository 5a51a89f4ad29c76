"""The front door: the page explains every function that ``import driftlab as dl`` offers."""

import inspect
import re

import driftlab as dl
from support import ROOT

PAGE = (ROOT / "docs" / "helper.md").read_text("utf-8")
FUNCTIONS = [name for name in dl.__all__ if inspect.isfunction(getattr(dl, name))]


def test_every_function_is_explained_on_the_page():
    assert not [name for name in FUNCTIONS if f"`dl.{name}" not in PAGE]


def test_examples_print_what_the_page_shows(capsys):
    namespace: dict[str, object] = {}
    for code, shown in re.findall(r"```python\n(.*?)```(?:\n\n```\n(.*?)```)?", PAGE, re.DOTALL):
        exec(compile(code, "docs/helper.md", "exec"), namespace)
        assert capsys.readouterr().out == shown, code
