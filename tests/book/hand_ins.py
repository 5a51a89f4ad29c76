"""What the tests of the class report hand in."""

import io
import json
import zipfile

from driftlab.book import class_report

RIGHT, WRONG = "Exercise 3.1: right.", "Exercise 3.1: not yet. Close."


def notebook(said=RIGHT, title=""):
    cells = [
        {"cell_type": "markdown", "source": title},
        {"cell_type": "code", "source": "", "outputs": [{"text": said}]},
    ]
    return json.dumps({"cells": cells}).encode()


def zipped(files, **options):
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED, **options) as opened:
        for name, content in files.items():
            opened.writestr(name, content)
    return archive.getvalue()


def put(folder, files):
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def rows(folder, **options):
    report = class_report(folder, **options)
    return {student.name: student for student in report.students}
