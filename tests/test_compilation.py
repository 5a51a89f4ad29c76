"""The switch for compiled loops; what they compute is compared in tests/peers/test_compiled.py."""

import os

import pytest

from driftlab import use_compiled
from driftlab.core import compiled


@pytest.fixture(autouse=True)
def _as_before(monkeypatch):
    monkeypatch.setattr(compiled, "on", compiled.on)
    monkeypatch.setenv(compiled.VARIABLE, "0")


def test_without_numba_one_sentence_says_how_to_get_it(monkeypatch):
    monkeypatch.setattr(compiled, "available", lambda: False)
    with pytest.raises(
        ModuleNotFoundError, match=r"^use_compiled needs numba.*driftlab\[compiled\]"
    ):
        use_compiled()
    assert not compiled.on
    use_compiled(False)


def test_the_switch_tells_processes_that_are_started_later(monkeypatch):
    monkeypatch.setattr(compiled, "available", lambda: True)
    for on in (True, False):
        use_compiled(on)
        assert compiled.on is on
        assert os.environ[compiled.VARIABLE] == str(int(on))


def test_what_is_no_truth_value_is_refused():
    with pytest.raises(ValueError, match=r"^on: expected True or False"):
        use_compiled("yes")
