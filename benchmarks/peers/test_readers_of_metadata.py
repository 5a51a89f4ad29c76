"""Programs that read the citation, the licences and the package's page accept them.

Each is fetched into an environment of its own; what it needs could not stand beside the book's.
"""

import subprocess
import sys

import pytest

import driftlab
from support import ROOT

UV = [sys.executable, "-m", "uv", "tool", "run", "--quiet", "--from"]


def ask(package: str, *command: object) -> str:
    """What a command of a package prints; skipped where the package cannot be had."""

    def run(*words: str) -> subprocess.CompletedProcess[str]:
        asked = [*UV, package, *words]
        return subprocess.run(asked, capture_output=True, encoding="utf-8", cwd=ROOT, timeout=900)

    if run("python", "-c", "").returncode:
        pytest.skip(f"{package} cannot be fetched.")
    done = run(*map(str, command))
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_cffconvert_makes_a_bibtex_entry_with_author_title_and_year():
    ask("cffconvert==2.0.0", "cffconvert", "--validate")
    entry = ask("cffconvert==2.0.0", "cffconvert", "--format", "bibtex")
    assert "author = {The Drift Lab authors}" in entry
    assert "title = {Drift Lab: an interactive textbook" in entry
    assert "year = {20" in entry
    # BibTeX has no version in its standard fields, and cffconvert writes none; CITATION.bib does.
    said = ask("cffconvert==2.0.0", "cffconvert", "-f", "apalike")
    assert f"(version {driftlab.__version__})" in said


def test_twine_accepts_wheel_and_source_distribution(tmp_path):
    for build in ("build_wheel", "build_sdist"):
        code = f"import sys; from flit_core import buildapi; buildapi.{build}(sys.argv[1])"
        subprocess.run([sys.executable, "-c", code, tmp_path], cwd=ROOT, check=True)
    wheel, source = sorted(tmp_path.iterdir())
    assert ask("twine", "twine", "check", "--strict", wheel, source).count("PASSED") == 2


def test_rattler_build_reads_the_conda_recipe():
    code = (
        "from rattler_build import Stage0Recipe, VariantConfig;"
        "[one] = Stage0Recipe.from_file('release/recipe.yaml').render(VariantConfig());"
        "print(one.recipe.package.version, *one.recipe.requirements.run, sep='|')"
    )
    version, *needs = ask("py-rattler-build", "python", "-c", code).strip().split("|")
    assert version == driftlab.__version__
    assert [need.split()[0] for need in needs] == ["python", "numpy", "scipy"]


def test_every_file_has_a_licence_for_reuse():
    if not (ROOT / ".git").exists():
        pytest.skip("without git, files of an environment are counted as the project's")
    ask("reuse", "reuse", "lint")
