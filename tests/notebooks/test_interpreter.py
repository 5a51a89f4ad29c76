"""Notebooks that are run in this process hide nothing, and leave nothing behind."""

from pathlib import Path

import pytest
from interpreter import run_here
from pages import notebook_of
from test_runs import hidden_errors

BROKEN_DISPLAY = """
class Broken:
    def _repr_html_(self):
        raise ZeroDivisionError("broken")
"""


@pytest.mark.parametrize(
    "cell",
    [f"{BROKEN_DISPLAY}Broken()", f"{BROKEN_DISPLAY}display(Broken())"],
    ids=["result", "display"],
)
def test_an_error_in_what_a_cell_shows_is_found_without_a_kernel(cell: str, tmp_path: Path) -> None:
    assert hidden_errors(run_here(notebook_of(cell), tmp_path)) == ["broken"]


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    ("cell", "error"),
    [
        ("1 / 0", ZeroDivisionError),
        ("1 +", SyntaxError),
        ("import warnings\nwarnings.warn('old', DeprecationWarning)", DeprecationWarning),
    ],
    ids=["error", "syntax", "warning"],
)
def test_a_cell_that_fails_ends_a_run_without_a_kernel(
    cell: str, error: type[Exception], tmp_path: Path
) -> None:
    with pytest.raises(error):
        run_here(notebook_of(cell), tmp_path)


def test_a_run_without_a_kernel_keeps_outputs_and_leaves_nothing_behind(tmp_path: Path) -> None:
    leaves = (
        "from matplotlib import pyplot, rcParams\nrcParams['font.size'] = 99\npyplot.figure()\n"
    )
    run_here(notebook_of(f"{leaves}kept = 1"), tmp_path)
    lines = "import sys\nprint('said')\ndisplay(2)\nprint('badly', file=sys.stderr)\n"
    cell = f"{lines}'kept' in globals(), pyplot.get_fignums(), rcParams['font.size'] == 99"
    notebook = run_here(notebook_of("from matplotlib import pyplot, rcParams", cell), tmp_path)
    shown = [
        (output.output_type, output.get("text") or output.data["text/plain"])
        for output in notebook.cells[1].outputs
    ]
    assert shown == [
        ("display_data", "2"),
        ("execute_result", "(False, [], False)"),
        ("stream", "said\n"),
        ("stream", "badly\n"),
    ]
