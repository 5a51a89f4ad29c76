// Computes the numbers of figures in Pyodide under Node and prints them as CSV has them, as JSON.
// `node figures_in_pyodide.mjs FOLDER`: the folder holds the runtime, its lock and all wheels.
import { pathToFileURL } from "node:url";

const folder = process.argv[2];
const { loadPyodide } = await import(pathToFileURL(`${folder}/pyodide.mjs`));
const python = await loadPyodide({ indexURL: `${folder}/` });
const packages = ["anywidget", "driftlab", "ipywidgets", "sympy"];
await python.loadPackage(packages, { messageCallback() {} });
process.stdout.write(python.runPython(`
import json
from driftlab.book.figures import figure_definitions
from driftlab.book.machinery.figure.csv_table import as_words

json.dumps({
    name: as_words(each.columns(each.compute()))
    for name, each in figure_definitions().items()
    if each.columns and not each.is_kept
})
`));
