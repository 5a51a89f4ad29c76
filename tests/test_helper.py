"""docs/helper.md names every function of ``import driftlab as dl``, and its examples run."""

import inspect
import re

import driftlab as dl
from support import ROOT

PAGE = (ROOT / "docs" / "helper.md").read_text("utf-8")


def test_every_function_is_explained_on_the_page():
    for name in dl.__all__:
        if inspect.isfunction(getattr(dl, name)):
            assert f"`dl.{name}" in PAGE, name


def test_examples_print_what_the_page_shows(capsys):
    namespace: dict[str, object] = {}
    for code, shown in re.findall(r"```python\n(.*?)```(?:\n\n```\n(.*?)```)?", PAGE, re.DOTALL):
        exec(compile(code, "docs/helper.md", "exec"), namespace)
        assert capsys.readouterr().out == shown, code
