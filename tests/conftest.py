"""Settings of all tests: property tests draw the same examples everywhere, without a clock.

Several processes may share the tests. What uses the same runs is one group and stays in one of
them: the tests of a published figure, those of a panel, and of the rest those of a file.
"""

import gc
import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings

from limits import at_most, limit_of

settings.register_profile("driftlab", derandomize=True, deadline=None, max_examples=40)
settings.register_profile("quick", settings.get_profile("driftlab"), max_examples=20)
settings.load_profile("driftlab")

# Matrices as small as the book's are done sooner by one thread, as lab.py knows of the kernels;
# and the threads of several processes would wait for each other. NumPy is not imported yet.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# What tests start says all in UTF-8, and reads the scripts that they write, on Windows too.
if os.name == "nt":
    os.environ.setdefault("PYTHONUTF8", "1")

# Kernels of notebooks run in other folders.
if folder := os.environ.get("DRIFTLAB_RECORDINGS"):
    os.environ["DRIFTLAB_RECORDINGS"] = str(Path(folder).absolute())

# What nbformat imports for schemas builds grammars of addresses with this package, for two seconds
# in each process, if it is there; nothing of a notebook is checked with it.
sys.modules.setdefault("rfc3987_syntax", None)

# The groups that take longest, the longest first: begun last, one of them would run alone. One
# process drives the browser for all panels while the others compute.
HEAVY = (
    "browser",
    "notebook-12_calibration_consistency.ipynb",
    "book",
    "notebook-15_gyrocompass_trials.ipynb",
    "notebook-09_strapdown_navigation.ipynb",
    "notebook-13_finding_north.ipynb",
    "notebook-11_kalman_calibration.ipynb",
    "CapstoneExplorer",
    "GyrocompassExplorer",
    "TurnCalibrationExplorer",
    "notebook-14_gyrocompass_under_way.ipynb",
    "CalibrationRunExplorer",
    "notebook-07_coning.ipynb",
    "DriftExplorer",
    "AlgorithmLaboratoryExplorer",
    "AlignmentBudgetExplorer",
    "TypeTestExplorer",
    "MissionExplorer",
    "notebook-05_rate_table_on_earth.ipynb",
    "figure-12-in-place-claim",
    "AllanExplorer",
    "ObservabilityExplorer",
)


TESTS = Path(__file__).parent
# Only some change the site or what a class uses: .ci/run names these folders, others need not.
collect_ignore = ["class", "site"]
STDERR = pytest.StashKey[int]()


def pytest_configure(config: pytest.Config) -> None:
    """Note where errors are printed, as long as nothing is captured."""
    config.stash[STDERR] = os.dup(sys.__stderr__.fileno())


@pytest.hookimpl(wrapper=True)
def limited(item: pytest.Item) -> Iterator[None]:
    """Let no test wait without an end, nor what is set up before it or taken down after it."""
    with at_most(limit_of(item), item.config.stash[STDERR]):
        return (yield)


pytest_runtest_setup = pytest_runtest_call = pytest_runtest_teardown = limited


def group_of(item: pytest.Item) -> str:
    """Name of the group of a test, empty if it is alone."""
    mark = item.get_closest_marker("xdist_group")
    return mark.args[0] if mark else ""


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Group what is left by files, and begin with what takes longest."""
    for item in items:
        if not group_of(item):
            # Examples in src may be tried along with tests.
            name = Path(os.path.relpath(item.path, TESTS)).with_suffix("").as_posix()
            item.add_marker(pytest.mark.xdist_group(name))
    ranks = {name: rank for rank, name in enumerate(HEAVY)}
    items.sort(key=lambda item: ranks.get(group_of(item), len(HEAVY)))


def pytest_collection_finish() -> None:
    """Leave out of all later searches for garbage what has been imported: it stays to the end."""
    gc.collect()
    gc.freeze()


@pytest.fixture(scope="session")
def started_browser() -> Iterator:
    """The one browser of a process, which cannot drive two; its contexts share nothing."""
    from chromium import chromium  # most tests need none of this

    with chromium() as started:
        yield started


@pytest.fixture(scope="session")
def browser(started_browser):
    """A window of the browser; its pages share what they have loaded already."""
    return started_browser.new_context(viewport={"width": 1366, "height": 768})


@pytest.fixture(scope="session")
def server(browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator:
    """A JupyterLab with a copy of the book."""
    from book_server import book_server

    with book_server(tmp_path_factory.mktemp("book")) as started:
        yield started


@pytest.fixture(scope="session")
def chapter_page(browser, server) -> Iterator:
    """The page of JupyterLab, for one notebook after the other."""
    from notebook_page import new_page

    with new_page(browser, server) as page:
        yield page


@pytest.fixture(scope="module")
def notebook(chapter_page, server):
    """The same page, with a notebook of one cell for code that a test brings along."""
    from pages import notebook_of

    chapter_page.open(server.add_notebook("panel.ipynb", notebook_of("")))
    return chapter_page
