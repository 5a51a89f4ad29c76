"""A page may move sliders of one panel in several threads of the kernel."""

import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import pytest

from driftlab.book import DriftExplorer
from panel_numbers import results_of


@pytest.fixture
def threads_that_take_turns_often() -> Iterator[None]:
    usual = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    yield
    sys.setswitchinterval(usual)


@pytest.mark.usefixtures("threads_that_take_turns_often")
def test_a_panel_moved_in_two_threads_shows_what_its_controls_say() -> None:
    panel, alone = DriftExplorer(), DriftExplorer()
    sliders = [control for control in panel.controls if control.is_slider][:2]
    begin = Barrier(2, timeout=60)

    def move(control) -> None:
        begin.wait()
        for k in range(8):
            panel._widgets[control.name].value = control.low if k % 2 else control.high

    for _ in range(3):
        with ThreadPoolExecutor(2) as threads:
            list(threads.map(move, sliders))
        alone.set(**panel.values)
        assert panel.preset.value == alone.preset.value
        assert results_of(panel) == results_of(alone)
        assert panel.code.value == alone.code.value
        same = panel.view.widget.value == alone.view.widget.value
        assert same, "another picture than that of these values"
