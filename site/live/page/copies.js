// A reader's copies of the notebooks, which JupyterLite keeps in this browser under the version of
// the book. A copy in which nobody has written follows the book; from then on it is the reader's,
// and nothing here replaces it.
import { crc32 } from "./zip.js";

const STORAGE = document.documentElement.dataset.storage; // written by lite.py, as all data here
const MARK = "driftlab-text"; // in a notebook's metadata: the mark of the text that it began with

// The mark of the book's text for each of its notebooks, by path.
export const texts = await fetch(new URL("texts.json", import.meta.url), { cache: "no-cache" })
  .then((answer) => answer.json())
  .catch(() => ({}));

// Paths of copies that are the reader's and began with a text that the book has no more.
export const behind = new Set();

// Before JupyterLite looks for them: forget the copies that can be had anew.
export async function renew() {
  for (const { path, content } of await kept(STORAGE)) {
    const begun = content?.metadata?.[MARK];
    if (!begun || !texts[path] || begun === texts[path]) continue;
    if (begun === mark(content.cells)) await forget(path);
    else behind.add(path);
  }
}

// As lite.py computes it. What cells have put out is no part of it: running them is no change.
function mark(cells) {
  const parts = cells.flatMap(({ cell_type, source }) => [cell_type, [source].flat().join("")]);
  return crc32(new TextEncoder().encode(parts.join("\0"))).toString(16);
}

// What JupyterLite keeps under a name; nothing of a database that is not its own.
export async function kept(name) {
  const models = await inFiles(name, "readonly", (files) => files.getAll());
  return models.filter((model) => model.type !== "directory");
}

function forget(path) {
  return inFiles(STORAGE, "readwrite", (files) => files.delete(path));
}

function inFiles(name, mode, ask) {
  return new Promise((resolve, reject) => {
    const opening = indexedDB.open(name);
    opening.onupgradeneeded = () => opening.transaction.abort(); // it was not there
    opening.onerror = () => {
      if (opening.error.name === "AbortError") resolve([]);
      else reject(opening.error);
    };
    opening.onsuccess = () => {
      const database = opening.result;
      const close = (end, result) => {
        database.close(); // or JupyterLite could not change it
        end(result);
      };
      if (!database.objectStoreNames.contains("files")) return close(resolve, []);
      const asked = ask(database.transaction("files", mode).objectStore("files"));
      asked.transaction.oncomplete = () => close(resolve, asked.result);
      asked.transaction.onabort = () => close(reject, asked.error);
    };
  });
}
