"""The notebooks that the live book holds, and its settings."""

import json
import re
from pathlib import Path

from executed import published
from live.lite import STORAGE, settings, with_links, write_contents


def test_links_out_of_the_book_lead_to_the_site():
    text = "[a](../ERRATA.md) [b](../figures/README.md#x) ![c](../figures/p.svg) [d](03_x.ipynb)"
    assert with_links(text, "02_x.ipynb") == (
        "[a](#site/errata.html) [b](#site/gallery/index.html#x) ![c](figures/p.svg) [d](03_x.ipynb)"
    )
    assert with_links("[a](../docs/using.md)", "02_x.ipynb") == "[a](#site/docs/using.html)"


def test_every_notebook_is_live_and_links_to_what_is_there(tmp_path):
    write_contents(tmp_path)
    names = {Path(name) for name in published()}
    assert {path.relative_to(tmp_path) for path in tmp_path.rglob("*.ipynb")} == names
    for name in names:
        notebook = json.loads((tmp_path / name).read_text("utf-8"))
        text = "".join(
            "".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "markdown"
        )
        for link in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", text):
            assert ((tmp_path / name).parent / link).exists(), (name, link)


def test_work_is_kept_whatever_the_version_and_nothing_is_asked_of_a_registry():
    data = settings()["jupyter-config-data"]
    assert data["contentsStorageName"] == STORAGE == "Drift Lab"
    (kernel,) = data["litePluginSettings"].values()
    assert kernel["disablePyPIFallback"] is True
    assert kernel["pyodideUrl"].startswith("./")
