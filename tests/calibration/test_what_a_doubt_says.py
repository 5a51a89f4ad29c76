"""Which of the doubts about a record is told: the noise, slips, both, or that none is known.

What is found is given here, so that each way through the decision is one case.
"""

import warnings
from types import SimpleNamespace

import numpy as np
import pytest

from driftlab.calibration import InconsistentWarning, _doubt
from driftlab.imu import ImuNoise, PriorDeviations
from driftlab.increments import Increments

ROWS = np.zeros((4, 3))
DOOR = _doubt.Door(
    Increments(0.5, ROWS, ROWS),
    np.array([0.0, 0.0, 0.0, 1.0]),
    0.7,
    PriorDeviations(),
    ImuNoise(),
    np.array([[0.01, 0.0, 0.0], [0.0, -0.2, 0.03]]),
    np.array([2, 4]),
    (),
    True,
)
NONE_KNOWN = "no slip is known that explains it"


@pytest.fixture
def said(monkeypatch):
    """Call one of the two functions with what is found; return its sentence."""

    def call(*, slips=(), noise=(), doubt="", beyond=(), steps=None, squares=0.0, misfit=None):
        asked = []

        def likely_slips(*_):
            asked.append("slips")
            return list(slips)

        shown = None if misfit is None else SimpleNamespace(misfit=lambda *_: misfit)
        for name, made in {
            "evidence": lambda *_: shown,
            "told_noise": lambda *_: (list(noise), DOOR.noise),
            "likely_slips": likely_slips,
            "innovation_test": lambda _: None,
            "contradiction": lambda _: (0, doubt) if doubt else None,
            "beyond_prior": lambda *_: (0, list(beyond)),
            "second_order": lambda _: squares,
            "_judge": lambda *_: SimpleNamespace(steps=steps),
        }.items():
            monkeypatch.setattr(_doubt, name, made)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", InconsistentWarning)
            if misfit is None:
                _doubt.warn_if_inconsistent(SimpleNamespace(model=None), DOOR, None)
            else:
                _doubt.warn_if_impossible(DOOR, None, None)
        assert len(caught) <= 1
        return "".join(str(each.message) for each in caught), asked

    return call


@pytest.mark.parametrize(
    ("found", "ends"),
    [
        ({"slips": ["Is it A?", "Is it B?"], "noise": ["Is it N?"]}, ": Is it A; or Is it B?"),
        ({"noise": ["Is it M?", "Is it N?"]}, ": Is it M; and Is it N?"),
        ({}, "a second pass about this result."),
    ],
)
def test_before_the_filter_noise_is_asked_only_where_no_slip_explains(said, found, ends):
    sentence, _ = said(misfit=12.3, **found)
    assert "deviations, got 12.3" in sentence
    assert sentence.endswith(ends)


def test_before_the_filter_nothing_is_said_of_what_fits(said):
    assert said(misfit=_doubt.FITS, slips=["Is it A?"]) == ("", [])


@pytest.mark.parametrize("steps", [None, (0.1, 0.1)])
@pytest.mark.parametrize("noise", [[], ["Is it M?", "Is it N?"]])
@pytest.mark.parametrize("slips", [[], ["Is it A?", "Is it B?"]])
def test_slips_are_sought_unless_the_noise_explains_all(said, slips, noise, steps):
    sentence, asked = said(doubt="It is not right", slips=slips, noise=noise, steps=steps)
    # With the noise that it has, no step shows a contradiction.
    sought = not noise or steps is not None
    assert asked == ["slips"] * sought
    named = [*noise, *(slips if sought else [])]
    if not named:
        assert f"It is not right; {NONE_KNOWN}" in sentence
    elif named == slips:
        assert sentence.endswith("It is not right: Is it A; or Is it B?")
    elif named == noise:
        assert sentence.endswith("It is not right: Is it M; and Is it N?")
    else:
        assert sentence.endswith("It is not right: Is it M; and Is it N; and Is it A; or Is it B?")


def test_that_no_slip_is_known_is_said_of_the_innovations_alone(said):
    both, _ = said(doubt="It is not right", beyond=["9 of scale"])
    first, second = both.split(". Besides, ")
    assert NONE_KNOWN in first
    assert second.endswith("got 9 of scale.")
    alone, _ = said(beyond=["9 of scale"])
    assert NONE_KNOWN not in alone


def test_the_table_is_expected_to_be_as_fast_as_its_largest_velocity():
    assert _doubt._expected(DOOR).sway == 0.2
