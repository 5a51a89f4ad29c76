"""What `diagnose` says: the noise, slips, both, a second pass, or that none is known.

What is found is given here, so that each way through the decision is one case.
"""

from types import SimpleNamespace

import numpy as np
import pytest

from driftlab import diagnosis
from driftlab.calibration import FULL
from driftlab.calibration._filter_inputs import FITS, FilterInputs
from driftlab.calibration.calibration_history import Calibration
from driftlab.calibration.filter import LARGE_BIAS, TAKE_THE_MEAN, FilterFailure
from driftlab.diagnosis import Diagnosis, diagnose
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.increments import Increments

ROWS = np.zeros((4, 3))
TOLD = FilterInputs(
    increments=Increments(0.5, ROWS, ROWS),
    start=np.array([0.0, 0.0, 0.0, 1.0]),
    latitude=0.7,
    model=FULL,
    prior=PriorStandardDeviations(),
    noise=ImuNoise(),
    reference=np.array([[0.01, 0.0, 0.0], [0.0, -0.2, 0.03]]),
    ends=np.array([2, 4]),
)
NOTHING = np.zeros(1)
FOUND = Calibration(FULL, *[NOTHING] * 6, inputs=TOLD)
NONE_KNOWN = "no slip is known that explains it"


@pytest.fixture
def said(monkeypatch):
    """Diagnose with what is found; return its text, and whether slips were sought."""

    def call(*, slips=(), noise=(), said=(), steps=None, large=(), misfit=None, found=FOUND):
        asked = []

        def likely_slips(_):
            asked.append("slips")
            return list(slips)

        seen = None if misfit is None else SimpleNamespace(misfit=lambda *_: misfit)
        monkeypatch.setattr("driftlab.calibration._filter_inputs.evidence", lambda _: seen)
        if misfit is None:
            monkeypatch.setattr(FilterInputs, "impossible", lambda _: None)
        monkeypatch.setattr(Calibration, "_contradictions", lambda *_: (0, list(said)))
        monkeypatch.setattr(Calibration, "_too_large", lambda _: list(large))
        monkeypatch.setattr(
            diagnosis, "assumed_noise_contradictions", lambda inputs: (list(noise), inputs.noise)
        )
        monkeypatch.setattr(diagnosis, "_likely_slips", likely_slips)
        monkeypatch.setattr(diagnosis, "_Judge", lambda _: SimpleNamespace(steps=steps))
        return str(diagnose(found)), asked

    return call


@pytest.mark.parametrize(
    ("found", "ends"),
    [
        ({"slips": ["Is it A?", "Is it B?"], "noise": ["Is it N?"]}, ": Is it A; or Is it B?"),
        ({"noise": ["Is it M?", "Is it N?"]}, ": Is it M; and Is it N?"),
        ({}, "a second pass with this result as linearization_point."),
    ],
)
def test_before_the_filter_noise_is_asked_only_where_no_slip_explains(said, found, ends):
    sentence, _ = said(misfit=12.3, **found)
    assert "deviations, got 12.3" in sentence
    assert sentence.endswith(ends)


def test_nothing_is_said_of_what_fits(said):
    nothing = "Nothing contradicts what the filter was told."
    assert said(misfit=FITS, slips=["Is it A?"]) == (nothing, [])


@pytest.mark.parametrize("steps", [None, (0.1, 0.1)])
@pytest.mark.parametrize("noise", [[], ["Is it M?", "Is it N?"]])
@pytest.mark.parametrize("slips", [[], ["Is it A?", "Is it B?"]])
def test_slips_are_sought_unless_the_noise_explains_all(said, slips, noise, steps):
    sentence, asked = said(said=["It is not right"], slips=slips, noise=noise, steps=steps)
    # With the noise that it has, no step shows a contradiction.
    sought = not noise or steps is not None
    assert asked == ["slips"] * sought
    named = [*noise, *(slips if sought else [])]
    if not named:
        assert f"It is not right; {NONE_KNOWN}" in sentence
    elif named == slips:
        assert sentence == "It is not right: Is it A; or Is it B?"
    elif named == noise:
        assert sentence == "It is not right: Is it M; and Is it N?"
    else:
        assert sentence == "It is not right: Is it M; and Is it N; and Is it A; or Is it B?"


def test_noise_alone_is_said_and_a_second_pass(said):
    assert said(noise=["gyros: noise 3 times what was told"])[0].endswith("got another: gyros: "
        "noise 3 times what was told?")  # fmt: skip
    assert said(large=["go over the record again"])[0] == "go over the record again."
    both, _ = said(said=["It is not right"], large=["go over the record again"])
    assert both.startswith("It is not right. Besides, go over the record again; " + NONE_KNOWN)
    # Errors that a slip makes say nothing of the unit.
    assert "again" not in said(said=["It"], slips=["Is it A?"], large=["again"])[0]
    second = FOUND._replace(inputs=TOLD._replace(first=False))
    assert said(large=["go over the record again"], found=second)[0].startswith("Nothing")


@pytest.mark.parametrize("share", [0.99, 1.0, 1.01])
def test_advice_for_large_biases_is_the_mean_at_rest(said, share):
    inputs = TOLD._replace(prior=PriorStandardDeviations(gyro_bias=share * LARGE_BIAS))
    text, _ = said(said=["It"], found=FOUND._replace(inputs=inputs))
    assert (TAKE_THE_MEAN in text) == (share > 1)
    stopped = FilterFailure("prior: it could not go on.", inputs)
    assert said(found=stopped)[0] == f"prior: it could not go on; {TAKE_THE_MEAN}."


def test_a_diagnosis_of_nothing_is_refused():
    for nothing in (FOUND._replace(inputs=None), FilterFailure("no"), ValueError("no"), 3.0):
        with pytest.raises(ValueError, match=r"^found: expected what calibrate returned"):
            diagnose(nothing)


def test_what_is_certain_comes_first():
    text = str(Diagnosis(("X",), ("c", "d"), ("a", "b"), ""))
    assert text == "X: c; and d; and a; or b?"
