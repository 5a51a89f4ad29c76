// Counts what the worker fetches, so that the reader sees how much of how much has come.

const PAUSE = 100; // ms between two reports

export function countFetches(report) {
  const files = new Map(); // address -> {loaded, total}
  const original = globalThis.fetch.bind(globalThis);
  let says = "";
  let failed = "";
  let last = 0;

  const tell = (now = false) => {
    if (!now && performance.now() - last < PAUSE) return;
    last = performance.now();
    let [loaded, total] = [0, 0];
    for (const file of files.values()) {
      loaded += file.loaded;
      total += Math.max(file.loaded, file.total);
    }
    report({ loaded, total, says });
  };

  globalThis.fetch = async (request, options) => {
    const address = new URL(request.url ?? request, location.href).href;
    let response;
    try {
      response = await original(request, options);
    } catch (error) {
      failed ||= address;
      throw error;
    }
    if (!response.ok) failed ||= address;
    if (!response.ok || !response.body) return response;
    const packed = response.headers.get("content-encoding"); // then its length is another one
    const length = packed ? 0 : Number(response.headers.get("content-length") ?? 0);
    const file = files.get(address) ?? { total: length };
    file.loaded = 0;
    files.set(address, file);
    const counted = response.body.pipeThrough(new TransformStream({
      transform(chunk, controller) {
        file.loaded += chunk.byteLength;
        tell();
        controller.enqueue(chunk);
      },
      flush() {
        file.total = file.loaded;
        tell();
      },
    }));
    const { status, statusText, headers } = response;
    return new Response(counted, { status, statusText, headers });
  };

  return {
    // What is being done now.
    say(words) {
      says = words;
      tell(true);
    },

    // Take into the total what packages and all that they need will weigh, where the lock says so.
    async expect(folder, names, loaded = []) {
      const lock = await (await fetch(`${folder}pyodide-lock.json`)).json();
      const normal = (name) => name.toLowerCase().replace(/[-_.]+/g, "-");
      const entries = new Map(
        Object.entries(lock.packages).map(([name, entry]) => [normal(name), entry]),
      );
      const seen = new Set(loaded.map(normal));
      const need = (name) => {
        if (seen.has(normal(name))) return;
        seen.add(normal(name));
        const entry = entries.get(normal(name));
        if (!entry) return;
        const address = new URL(entry.file_name, folder).href;
        if (entry.size) files.set(address, { loaded: 0, total: entry.size });
        entry.depends.forEach(need);
      };
      names.forEach(need);
      tell(true);
    },

    // Do something for which things are fetched. If one of them did not come, that is why it fails:
    // of what follows from it nothing is said, and Pyodide would go on without it.
    async during(work) {
      failed = "";
      let trouble = null;
      const result = await work().catch((error) => {
        trouble = error;
      });
      if (failed) throw notFetched(failed);
      if (trouble) throw trouble;
      return result;
    },
  };
}

function notFetched(address) {
  const { host, pathname } = new URL(address);
  const error = new Error(
    `${pathname.split("/").at(-1)} could not be fetched from ${host}. Are you offline, or is that ` +
      "place closed to your network? The text and the pictures need nothing of it.",
  );
  error.kind = "NotFetched";
  return error;
}
