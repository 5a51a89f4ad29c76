"""Without a network the book opens with what there is, and says what is missing."""

from pathlib import Path
from types import SimpleNamespace

import pytest
from tiny_project import listed

pytestmark = pytest.mark.xdist_group("lab")


def test_without_network_the_old_environment_stays_and_the_book_opens(
    modules: SimpleNamespace, copied: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    before = (copied / "environment.txt").read_text("utf-8")
    listed(copied, f"sixth-sense==1.0 --hash=sha256:{64 * '0'}\n")
    with pytest.raises(modules.lab.Trouble, match="The package index cannot be reached: "):
        modules.lab.main(["figures"])
    said = capfd.readouterr().out
    assert said.startswith("The project has changed since the last set-up; updating")
    assert "figures drawn" not in said

    assert modules.lab.main(["--no-browser"]) == 0
    said = capfd.readouterr().out
    assert "\nMeanwhile the book opens with the packages of the last set-up.\n" in said
    assert "Drift Lab is open at" in said

    (copied / "environment.txt").write_text(before, "utf-8")
    assert modules.lab.main(["figures"]) == 0
    assert capfd.readouterr().out.strip() == "figures drawn"
