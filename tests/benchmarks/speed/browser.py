"""From a key to the new picture in a browser: printed, as the tests of the browser measure it."""

import sys
import tomllib
from pathlib import Path

_HOME = Path(__file__).parents[3]


def latencies() -> None:
    settings = tomllib.loads((_HOME / "pyproject.toml").read_text("utf-8"))
    folders = settings["tool"]["pytest"]["ini_options"]["pythonpath"]  # where the tests look, too
    sys.path += [str(_HOME / folder) for folder in folders]
    from latency import latencies as in_notebook
    from latency_in_page import page_latencies

    in_notebook()
    page_latencies(_HOME / "_site")
