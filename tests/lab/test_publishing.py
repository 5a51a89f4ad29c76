"""What publishes the site may do no more than that."""

import re

import yaml
from tiny_project import ROOT, load

ACTION = r"actions/[\w-]+@v\d+"


def test_the_site_is_published_with_no_more_rights_than_that_takes() -> None:
    workflow = yaml.safe_load((ROOT / ".github/workflows/pages.yml").read_text("utf-8"))
    assert workflow["permissions"] == {"contents": "read"}
    jobs = workflow["jobs"]
    assert "permissions" not in jobs["build"]
    said = [step["run"] for step in jobs["build"]["steps"] if "run" in step]
    assert said[0] == "python3 lab.py site"
    assert said[-1].endswith("python3 lab.py test --site")
    assert "upload-pages-artifact" in jobs["build"]["steps"][-1]["uses"], "tested before"
    assert jobs["publish"]["permissions"] == {"pages": "write", "id-token": "write"}
    used = [step["uses"] for job in jobs.values() for step in job["steps"] if "uses" in step]
    assert all(re.fullmatch(ACTION, action) for action in used)


def test_the_tests_run_with_the_oldest_and_the_newest_python() -> None:
    workflow = yaml.safe_load((ROOT / ".github/workflows/tests.yml").read_text("utf-8"))
    assert workflow["permissions"] == {"contents": "read"}
    classifiers = load(ROOT).environment.project()["project"]["classifiers"]
    versions = re.findall(r"Python :: (3\.\d+)", "\n".join(classifiers))
    assert workflow["jobs"]["tests"]["strategy"]["matrix"]["python"] == [versions[0], versions[-1]]
