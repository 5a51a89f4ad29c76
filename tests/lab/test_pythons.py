"""Which Pythons run lab.py, and which are refused."""

import ast
import subprocess
import sys

from tiny_project import ROOT


def test_an_old_python_reads_lab_py_as_far_as_the_refusal() -> None:
    ast.parse((ROOT / "lab.py").read_text("utf-8"), feature_version=(3, 6))
    pretend = (
        "import platform, runpy, sys; sys.version_info = (3, 9, 18);"
        "platform.python_version = lambda: '3.9.18'; runpy.run_path(sys.argv[1])"
    )
    done = subprocess.run(
        [sys.executable, "-c", pretend, str(ROOT / "lab.py")], capture_output=True, text=True
    )
    assert done.returncode == 1
    assert done.stderr.startswith("Drift Lab needs Python 3.11 or newer; this is 3.9.18. Install")
    assert done.stderr.count("\n") == 1
