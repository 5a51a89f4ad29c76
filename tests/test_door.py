"""``import driftlab`` is instant, loads nothing, and offers everything that is public."""

import inspect
import operator
import subprocess
import sys
from functools import cache
from importlib import import_module

import pytest

import driftlab
from driftlab.__main__ import overview
from driftlab.book.chapters import CHAPTERS
from driftlab.book.panels import EXPLORERS
from support import ROOT, helper_modules

SUBJECTS = ("motion", "drift", "attitude", "recordings", "calibration", "gyrocompass")


def printed_by(*arguments, code=0):
    done = subprocess.run(
        [sys.executable, *arguments], capture_output=True, text=True, check=False, timeout=120
    )
    assert done.returncode == code, done.stderr
    return done.stdout.strip()


def test_importing_the_package_loads_no_library():
    heavy = {"matplotlib", "ipywidgets", "IPython", "sympy", "scipy", "numpy", "driftlab.earth"}
    code = f"import sys, driftlab; print(sorted({heavy!r} & sys.modules.keys()))"
    assert printed_by("-c", code) == "[]"


def test_integrate_needs_numpy_alone():
    heavy = {"scipy", "numba", "numpy.ma", "numpy.polynomial"}
    used = "integrate([[0.0, 0.0, 0.1]] * 8, 'rotation-vector-2')"
    code = f"import sys; from driftlab import integrate; {used}; print({heavy} & {{*sys.modules}})"
    assert printed_by("-c", code) == "set()"


def test_panels_ask_for_no_more_than_a_page_has():
    """A page runs them in a browser, where SymPy, JupyterLab and IPython would be far too much.

    IPython is a part of the real ipywidgets, so that it is taken away when these are there.
    """
    code = """
import sys
import anywidget, ipywidgets
for name in [*sys.modules]:
    if name.partition(".")[0] == "IPython":
        sys.modules[name] = None
import driftlab.book.panels as panels
assert panels.EXPLORERS and panels.SCENES
late = {"scipy.stats", "scipy.signal"}  # they take a third of a second or more
print(sorted({"sympy", "jupyterlab", "tqdm", "pooch", "nbformat", *late} & sys.modules.keys()))
"""
    assert printed_by("-c", code) == "[]"


def test_nothing_loads_the_statistics_of_scipy_before_it_needs_them():
    loaded = "sorted({'scipy.stats', 'scipy.signal'} & sys.modules.keys())"
    names = "[getattr(driftlab, name) for name in driftlab.__all__]"
    assert printed_by("-c", f"import sys, driftlab; {names}; print({loaded})") == "[]"


def test_one_subject_loads_no_other():
    code = "import sys, driftlab as dl; dl.align; print('driftlab.calibration' in sys.modules)"
    assert printed_by("-c", code) == "False"


@pytest.mark.parametrize("package", ["", *SUBJECTS, "book"])
def test_every_name_on_offer_is_there(package):
    module = import_module(f"driftlab.{package}".rstrip("."))
    assert dir(module) == sorted(dir(module)) == module.__all__
    for name in module.__all__:
        first = getattr(module, name)
        # A module of the same name would take the place of a function when it is imported.
        assert inspect.ismodule(first) == (f"{module.__name__}.{name}" in sys.modules)
        assert getattr(module, name) is first


def test_names_mean_what_the_modules_say():
    from driftlab.drift.systematic_drift import drift_per_revolution
    from driftlab.gyrocompass.alignment import align

    assert driftlab.align is driftlab.gyrocompass.align is align
    assert (
        driftlab.drift.drift_per_revolution is driftlab.drift_per_revolution is drift_per_revolution
    )


def test_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match=r"^module 'driftlab.drift' has no attribute 'drfit'$"):
        driftlab.drift.drfit  # noqa: B018


@pytest.mark.parametrize(
    "name",
    [
        "recordings.read_csv",
        "attitude.step_quaternions",
        "earth.EARTH_RATE",
        "checks.UnusualWarning",
    ],
)
def test_a_name_that_is_deeper_is_told_where(name):
    with pytest.raises(AttributeError, match=rf"; did you mean driftlab\.{name}\?$"):
        getattr(driftlab, name.split(".")[1])
    assert operator.attrgetter(name)(driftlab) is not None


@pytest.mark.parametrize("subject", SUBJECTS)
def test_subject_offers_all_its_public_functions_and_classes(subject):
    package = import_module(f"driftlab.{subject}")
    public = {
        name
        for module in helper_modules()
        if module.__name__.startswith(f"driftlab.{subject}.")
        for name, thing in vars(module).items()
        if inspect.isfunction(thing)
        and thing.__module__ == module.__name__
        and not name.startswith(("_", "checked_"))
    }
    assert public - set(package.__all__) == set()


def test_the_book_offers_every_panel():
    names = {explorer.__name__ for explorer in EXPLORERS}
    assert names <= set(driftlab.book.__all__)


def test_overview_names_every_module():
    text = printed_by("-m", "driftlab")
    for module in helper_modules():
        assert f"{module.__name__}: " in text


@pytest.mark.parametrize(
    ("word", "module"),
    [
        ("boresight", "body_frames"),
        ("nis", "calibration.kalman"),
        ("ISO 8728", "gyrocompass.type_test"),
        ("lever arm", "higher_order_errors"),
        ("frequency response", "gyrocompass.levelling_loop"),
    ],
)
def test_overview_leads_from_a_word_of_the_field_to_its_module(word, module):
    found = "\n".join(overview(word))
    assert f"driftlab.{module}: " in found
    assert found.count("driftlab.") < 0.4 * whole_overview().count("driftlab.")


@cache
def whole_overview() -> str:
    return "\n".join(overview())


def test_overview_says_that_it_does_not_know_a_word():
    text = printed_by("-m", "driftlab", "flux", "capacitor", code=2)
    assert text.splitlines()[-1].startswith("Nothing here speaks of 'flux capacitor'.")


def test_each_chapter_has_a_folder_of_its_name():
    notebooks = {path.stem for path in (ROOT / "notebooks").glob("[0-9][0-9]_*.ipynb")}
    assert {folder.removeprefix("ch") for folder in CHAPTERS.values()} == notebooks
