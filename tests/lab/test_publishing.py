"""What publishes the site may do no more than that, and GitHub takes what it is told."""

import re
import subprocess
import sys
import tomllib

import yaml
from tiny_project import ROOT

ACTION = r"actions/[\w-]+@v\d+"


def test_the_site_is_published_with_no_more_rights_than_that_takes() -> None:
    workflow = yaml.safe_load((ROOT / ".github/workflows/pages.yml").read_text("utf-8"))
    assert workflow["permissions"] == {"contents": "read"}
    jobs = workflow["jobs"]
    assert "permissions" not in jobs["build"]
    said = [step["run"] for step in jobs["build"]["steps"] if "run" in step]
    assert said == [
        "python3 lab.py site",
        "test -f _site/live/lab/index.html",
        'DRIFTLAB_BROWSER="$(command -v google-chrome)" python3 lab.py test --site',
    ]
    assert "upload-pages-artifact" in jobs["build"]["steps"][-1]["uses"], "tested before"
    assert jobs["publish"]["permissions"] == {"pages": "write", "id-token": "write"}
    used = [step["uses"] for job in jobs.values() for step in job["steps"] if "uses" in step]
    assert all(re.fullmatch(ACTION, action) for action in used)


def test_the_tests_run_with_the_oldest_and_the_newest_python() -> None:
    workflow = yaml.safe_load((ROOT / ".github/workflows/tests.yml").read_text("utf-8"))
    assert workflow["permissions"] == {"contents": "read"}
    job = workflow["jobs"]["tests"]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    versions = re.findall(r"Python :: (3\.\d+)", "\n".join(project["classifiers"]))
    assert job["strategy"]["matrix"]["python"] == [versions[0], versions[-1]]
    *used, first, second = job["steps"]
    assert all(re.fullmatch(ACTION, step["uses"]) for step in used)
    assert '"lab.py", "--no-browser"' in first["run"]
    assert second["run"] == "python lab.py test"


def test_the_workflows_have_the_form_that_github_asks_for() -> None:
    """By the schema that check-jsonschema brings along, so without a network."""
    check = [
        sys.executable,
        "-m",
        "check_jsonschema",
        "--builtin-schema",
        "vendor.github-workflows",
    ]
    done = subprocess.run(
        [*check, *(ROOT / ".github/workflows").glob("*.yml")], capture_output=True, encoding="utf-8"
    )
    assert done.returncode == 0, done.stdout + done.stderr
