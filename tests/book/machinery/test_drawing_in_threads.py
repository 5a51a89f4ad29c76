"""Matplotlib has one style for a process; threads that draw wait for each other."""

from concurrent.futures import ThreadPoolExecutor

import pytest

import driftlab


def drawn(task) -> bytes:
    name, width, path = task
    return driftlab.figure(name).save(path, width=width).read_bytes()


@pytest.mark.slow
def test_figures_of_two_styles_drawn_at_once_are_those_drawn_alone(tmp_path):
    kinds = [("03-drift-history", 3.5), ("03-drift-history", None), ("02-roots", 7.2)]
    alone = {kind: drawn((*kind, tmp_path / "alone.svg")) for kind in kinds}
    tasks = [(*kind, tmp_path / f"{i}.svg") for i in range(4) for kind in kinds]
    with ThreadPoolExecutor(4) as threads:
        found = list(threads.map(drawn, tasks))
    for (name, width, _), svg in zip(tasks, found, strict=True):
        assert svg == alone[name, width]
