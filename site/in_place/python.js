// The page's side of its Python: `ask` calls a function in the worker, `stop` ends the worker.
// The worker does one thing at a time. What waits, waits here, and what was asked last goes first:
// it is what the reader looks at.

export class Trouble extends Error {
  // kind: the type of Python's exception, or "Stopped", "NoWorker", "NotFetched", "Died", ...
  // trace: the traceback, if there is one.
  constructor({ kind, says, trace = "" }) {
    super(says);
    this.kind = kind;
    this.trace = trace;
  }
}

const SENTENCES = {
  NoWebAssembly:
    "This browser has no WebAssembly, which Python in a page needs; a current Firefox, Chrome, " +
    "Edge or Safari has it, unless it is switched off.",
  NoWorker:
    "Python could not be started: this browser does not run module workers, or a file of the " +
    "site is missing. A current Firefox, Chrome, Edge or Safari will do.",
  Died:
    "Python came to its end, most likely because the tab had no memory left. It can be started " +
    "again; other tabs closed before will help.",
  Stopped: "Python was stopped. It can be started again.",
};

let worker = null;
let running = null;
let waiting = [];
let count = 0;
let alive = false; // whether the worker has said anything yet
const watchers = new Set();

// Call "module.function" of a Python file in this folder with plain arguments.
// packages: names in the lock that the call needs besides the book's package.
// onProgress: told what is being done while something is fetched.
export function ask(call, args = [], { onProgress, packages = [] } = {}) {
  return new Promise((resolve, reject) => {
    const request = { id: ++count, call, args, packages, onProgress, resolve, reject };
    waiting.push(request);
    next();
  });
}

// End Python; whatever was asked is refused with this kind of sentence.
export function stop(kind = "Stopped", says = SENTENCES[kind]) {
  worker?.terminate();
  worker = null;
  alive = false;
  const left = [running, ...waiting].filter(Boolean);
  running = null;
  waiting = [];
  const trouble = new Trouble({ kind, says });
  for (const request of left) request.reject(trouble);
  for (const watcher of [...watchers]) watcher(trouble);
}

// Be told of the end of Python, with its Trouble; returns what ends that.
export function onStop(watcher) {
  watchers.add(watcher);
  return () => watchers.delete(watcher);
}

function next() {
  if (running || !waiting.length) return;
  running = waiting.pop();
  if (typeof WebAssembly !== "object") {
    stop("NoWebAssembly");
    return;
  }
  try {
    worker ??= begin();
  } catch {
    stop("NoWorker");
    return;
  }
  const { id, call, args, packages } = running;
  worker.postMessage({ id, call, args, packages });
}

function begin() {
  const begun = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
  // What one that was stopped had said before may still come, and is of no use any more.
  begun.onmessage = ({ data }) => {
    if (worker !== begun) return;
    alive = true;
    if (data.progress) {
      for (const each of [running, ...waiting]) each?.onProgress?.(data.progress);
      return;
    }
    const request = running;
    if (data.id !== request?.id) return;
    if (data.error?.ends) {
      stop(data.error.kind, SENTENCES[data.error.kind] ?? data.error.says);
      return;
    }
    running = null;
    if (data.error) request.reject(new Trouble(data.error));
    else request.resolve(data.result);
    next();
  };
  begun.onerror = (event) => {
    event.preventDefault();
    if (worker !== begun) return;
    stop(alive ? "Died" : "NoWorker");
  };
  return begun;
}
