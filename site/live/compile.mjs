// Compiles wheels with the Python that will run them, Pyodide under Node: .pyc in place of .py,
// without tests and without what only a desktop installs. `node compile.mjs PYODIDE IN OUT KEEP`:
// of the packages named in KEEP (by commas) the source stays beside the compiled files.

import { mkdirSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [pyodide, source, target, keep] = process.argv.slice(2);
const { loadPyodide } = await import(pathToFileURL(`${pyodide}/pyodide.mjs`));
mkdirSync(target, { recursive: true });
const python = await loadPyodide({ indexURL: `${pyodide}/` });
python.mountNodeFS("/in", source);
python.mountNodeFS("/out", target);
python.globals.set("KEEP", keep.split(","));

await python.runPythonAsync(`
import base64
import hashlib
import importlib.util
import os
import re
import sys
import warnings
import zipfile
from importlib._bootstrap_external import _code_to_hash_pyc

warnings.simplefilter("ignore")
LEFT_OUT = re.compile(r"/$|(^|/)tests?/|\\.data/data/(share|etc)/")


def compiled(path, data):
    """Not checked against its source when it is loaded: that is what takes time, or is not there."""
    code = compile(data, f"/lib/python3.12/site-packages/{path}", "exec", dont_inherit=True)
    return bytes(_code_to_hash_pyc(code, importlib.util.source_hash(data), False))


def files_of(wheel, keep):
    for path in sorted(wheel.namelist()):
        if LEFT_OUT.search(path) or path.endswith(".dist-info/RECORD"):
            continue
        data = wheel.read(path)
        try:
            code = compiled(path, data) if path.endswith(".py") else None
        except SyntaxError:  # a template, or for another Python
            code = None
        if code is None or keep:
            yield path, data
        if code is not None and keep:
            folder, _, name = path.rpartition("/")
            cached = f"{name[:-3]}.{sys.implementation.cache_tag}.pyc"
            yield f"{folder}/__pycache__/{cached}".lstrip("/"), code
        elif code is not None:
            yield f"{path}c", code


for name in sorted(os.listdir("/in")):
    with zipfile.ZipFile(f"/in/{name}") as old, zipfile.ZipFile(f"/out/{name}", "w") as new:
        (record,) = (p for p in old.namelist() if re.fullmatch(r"[^/]+\\.dist-info/RECORD", p))
        rows = []

        def put(path, data):
            info = zipfile.ZipInfo(path, (2020, 1, 1, 0, 0, 0))
            info.compress_type = zipfile.ZIP_DEFLATED
            new.writestr(info, data, compresslevel=9)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            rows.append(f"{path},sha256={digest},{len(data)}")

        for path, data in files_of(old, name.split("-")[0] in KEEP):
            put(path, data)
        put(record, "\\n".join([*rows, f"{record},,", ""]).encode())
`);
