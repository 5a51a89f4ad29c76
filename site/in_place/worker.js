// The one Python of a page: a module worker that loads Pyodide and the book's package, and answers
// calls of functions in the Python files beside it.
//
// In:  {id, call: "panels.open", args: [...], packages: ["sympy"]}
// Out: {id, result} or {id, error: {kind, says, trace, ends}}; `ends` if this worker is of no use any
//      more. And while things are fetched
//      {progress: {loaded, total, says}}, in bytes; total is 0 as long as it is not known.
// Arguments and results are plain data: numbers, text, lists, objects, and bytes as Uint8Array.

import { countFetches } from "./fetches.js";

const HERE = new URL(".", import.meta.url).href;
const RUNTIME = new URL("../live/static/pyodide/", HERE).href;
const FOLDER = "/in_place"; // of the Python files, in the file system that Python sees

const fetches = countFetches((progress) => postMessage({ progress }));
const modules = new Map(); // name -> promise that it lies in FOLDER
let python;
let begun = false;

async function start() {
  fetches.say("Fetching Python and the book's package");
  const py = await fetches.during(begin);
  begun = true;
  return py;
}

async function begin() {
  await fetches.expect(RUNTIME, ["driftlab"]);
  const { loadPyodide } = await import(`${RUNTIME}pyodide.mjs`);
  const py = await loadPyodide({
    indexURL: RUNTIME,
    packages: ["driftlab"],
    env: { HOME: "/home/pyodide", MPLBACKEND: "agg" },
    stdout: () => {},
    stderr: (line) => console.info(line),
  });
  fetches.say("Starting the book's package");
  py.FS.mkdir(FOLDER);
  py.runPython(`import sys; sys.path.insert(0, "${FOLDER}")`);
  await write(py, "widgets_standin");
  py.pyimport("widgets_standin").install();
  return py;
}

// Put a Python file from beside this script where Python finds it.
function bring(py, name) {
  if (!modules.has(name)) {
    const written = fetches.during(() => write(py, name));
    written.catch(() => modules.delete(name)); // it may be tried again
    modules.set(name, written);
  }
  return modules.get(name);
}

async function write(py, name) {
  const response = await fetch(`${HERE}${name}.py`);
  py.FS.writeFile(`${FOLDER}/${name}.py`, await response.text());
}

async function answer({ call, args = [], packages = [] }) {
  python ??= start();
  const py = await python;
  const missing = packages.filter((name) => !(name in py.loadedPackages));
  if (missing.length) {
    fetches.say(`Fetching ${missing.join(", ")}`);
    await fetches.during(async () => {
      await fetches.expect(RUNTIME, missing, Object.keys(py.loadedPackages));
      await py.loadPackage(missing, { messageCallback() {}, errorCallback() {} });
    });
    fetches.say("Computing");
  }
  const [module, name] = call.split(".");
  await bring(py, module);
  const given = args.map((each) => py.toPy(each));
  const result = py.pyimport(module)[name](...given);
  given.forEach((each) => each?.destroy?.());
  if (!(result instanceof py.ffi.PyProxy)) return result;
  const plain = { dict_converter: Object.fromEntries, create_pyproxies: false };
  const data = result.toJs(plain);
  result.destroy();
  return data;
}

// What went wrong: its kind (of Python's exceptions the type), a sentence, and Python's traceback.
function told(error) {
  if (error.type) {
    const lines = error.message.trimEnd().split("\n");
    const says = lines.at(-1).replace(/^[\w.]+: /, "");
    return { kind: error.type, says, trace: error.message };
  }
  const died = error.pyodide_fatal_error || error instanceof WebAssembly.RuntimeError;
  const kind = died ? "Died" : error.kind ?? error.name;
  return { kind, says: error.message, trace: error.stack, ends: died || !begun };
}

onmessage = async ({ data }) => {
  try {
    postMessage({ id: data.id, result: await answer(data) });
  } catch (error) {
    postMessage({ id: data.id, error: told(error) });
  }
};
