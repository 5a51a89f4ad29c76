// The one Python of a page: a module worker that loads Pyodide and the book's package, and answers
// calls of functions in the Python files beside it.
//
// In:  {id, call: "panels.open", args: [...], packages: ["sympy"]}
// Out: {id, result} or {id, error: {kind, says, trace, ends}}; `ends` if this worker is of no use any
//      more. And {progress: "Fetching Python"}: what is being done.
// Arguments and results are plain data: numbers, text, lists, objects, and bytes as Uint8Array.

const HERE = new URL(".", import.meta.url).href;
const RUNTIME = new URL("../live/static/pyodide/", HERE).href;
const FOLDER = "/in_place"; // of the Python files, in the file system that Python sees

const say = (progress) => postMessage({ progress });
const modules = new Map(); // name -> promise that it lies in FOLDER
let python;
let begun = false;
let failed = ""; // the first address of which nothing came

const fetched = globalThis.fetch.bind(globalThis);
globalThis.fetch = async (request, options) => {
  const response = await fetched(request, options).catch(() => Response.error());
  if (!response.ok) failed ||= request.url ?? String(request);
  return response;
};

// Do something for which things are fetched. If one of them did not come, that is why it fails: of
// what follows from it nothing is said, and Pyodide would go on without it.
async function fetching(work) {
  failed = "";
  const done = await work().catch((error) => {
    if (!failed) throw error;
  });
  if (!failed) return done;
  const { host, pathname } = new URL(failed, HERE);
  const says = `${pathname.split("/").at(-1)} could not be fetched from ${host}. Are you offline, or ` +
    "is that place closed to your network? The text and the pictures need nothing of it.";
  throw Object.assign(new Error(says), { kind: "NotFetched" });
}

async function start() {
  say("Fetching Python and the book's package; the first time that is some 50 MB");
  const py = await fetching(begin);
  begun = true;
  return py;
}

async function begin() {
  const { loadPyodide } = await import(`${RUNTIME}pyodide.mjs`);
  const py = await loadPyodide({
    indexURL: RUNTIME,
    packages: ["driftlab"],
    env: { HOME: "/home/pyodide", MPLBACKEND: "agg" },
    stdout: () => {},
    stderr: (line) => console.info(line),
  });
  say("Starting the book's package");
  py.FS.mkdir(FOLDER);
  py.runPython(`import sys; sys.path.insert(0, "${FOLDER}")`);
  await write(py, "widgets_standin");
  py.pyimport("widgets_standin").install();
  return py;
}

// Put a Python file from beside this script where Python finds it.
function bring(py, name) {
  if (!modules.has(name)) {
    const written = fetching(() => write(py, name));
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
    say(`Fetching ${missing.join(", ")}`);
    await fetching(() => py.loadPackage(missing, { messageCallback() {}, errorCallback() {} }));
    say("Computing");
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
