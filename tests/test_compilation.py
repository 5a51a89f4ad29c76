"""The switch for compiled loops; benchmarks/peers/test_compiled.py compares what they compute."""

import os
import warnings

import pytest

from driftlab import is_compiled, use_compiled
from driftlab.core import loops


@pytest.fixture(autouse=True)
def _as_before(monkeypatch):
    monkeypatch.setattr(loops, "on", loops.on)
    monkeypatch.setenv(loops.VARIABLE, "0")


def test_without_numba_one_sentence_says_how_to_get_it(monkeypatch):
    monkeypatch.setattr(loops, "available", lambda: False)
    with pytest.raises(
        ModuleNotFoundError, match=r"^use_compiled needs numba.*driftlab\[compiled\]"
    ):
        use_compiled()
    assert not loops.on
    use_compiled(False)


def test_the_switch_tells_processes_that_are_started_later(monkeypatch):
    monkeypatch.setattr(loops, "available", lambda: True)
    for on in (True, False):
        use_compiled(on)
        assert is_compiled() is on
        assert os.environ[loops.VARIABLE] == str(int(on))


def test_what_is_no_truth_value_is_refused():
    with pytest.raises(ValueError, match=r"^on: expected True or False"):
        use_compiled("yes")


@pytest.mark.parametrize(
    ("said", "installed", "compiles", "warned"),
    [
        (None, True, False, None),
        ("", True, False, None),
        ("0", True, False, None),
        ("1", True, True, None),
        ("1", False, False, r"^DRIFTLAB_COMPILED is 1, but numba is not installed: pip install"),
        ("true", True, False, r"^DRIFTLAB_COMPILED: expected 0 or 1, got 'true'"),
        ("yes", False, False, r"^DRIFTLAB_COMPILED: expected 0 or 1, got 'yes'"),
    ],
)
def test_what_the_environment_asks_for_is_done_or_a_warning_says_why_not(
    said, installed, compiles, warned, monkeypatch
):
    monkeypatch.setattr(loops, "available", lambda: installed)
    if said is None:
        monkeypatch.delenv(loops.VARIABLE)
    else:
        monkeypatch.setenv(loops.VARIABLE, said)
    if warned is None:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            assert loops._asked() is compiles
    else:
        with pytest.warns(UserWarning, match=warned):
            assert loops._asked() is compiles


def test_a_report_can_say_what_computed(monkeypatch):
    monkeypatch.setattr(loops, "version", lambda name: f"9.9 of {name}")
    monkeypatch.setattr(loops, "on", False)
    assert loops.arithmetic() == "NumPy"
    monkeypatch.setattr(loops, "on", True)
    assert loops.arithmetic() == "Numba 9.9 of numba"
