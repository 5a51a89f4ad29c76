"""Threads that move one panel, or draw with the one style that Matplotlib has, wait in turn."""

import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import pytest

import driftlab
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


def drawn(task) -> bytes:
    name, width, path = task
    return driftlab.figure(name).save(path, width=width).read_bytes()


@pytest.mark.slow
def test_figures_of_two_styles_drawn_at_once_are_those_drawn_alone(tmp_path):
    kinds = [("03-drift-history", 3.5), ("02-roots", None)]
    alone = {kind: drawn((*kind, tmp_path / "alone.svg")) for kind in kinds}
    tasks = [(*kind, tmp_path / f"{i}.svg") for i in range(2) for kind in kinds]
    with ThreadPoolExecutor(4) as threads:
        found = list(threads.map(drawn, tasks))
    for (name, width, _), svg in zip(tasks, found, strict=True):
        assert svg == alone[name, width]
