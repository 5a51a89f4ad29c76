// Lists what a reader has changed in the live chapters, of every version of the book, to download.
import { kept } from "./copies.js";
import { zip } from "./zip.js";
import { download, make } from "../in_place/elements.js";

const here = document.documentElement.dataset; // version, storage: written by lite.py
const FAMILY = "Drift Lab ";
const place = document.getElementById("work");

try {
  const stores = await everything();
  place.replaceChildren(...(stores.length ? stores.flatMap(shown) : [text("p", "Nothing yet.")]));
} catch (error) {
  place.textContent = `This browser lets the page keep nothing, so there is nothing to list (${error.message}).`;
}

// [{ title, files: [{ name, data, when, changed }] }], the present version first.
async function everything() {
  const listed = (await indexedDB.databases?.()) ?? [{ name: here.storage }];
  const found = [];
  for (const { name } of listed) {
    const models = name.startsWith(FAMILY) ? await kept(name) : [];
    const files = await Promise.all(models.map((model) => file(model, name === here.storage)));
    if (files.length) found.push({ title: name, files });
  }
  const answers = Object.entries({ ...localStorage }).filter(([name]) => name.startsWith(FAMILY));
  for (const [name, data] of answers) {
    found.push({ title: name, files: [{ name: "answers.json", data, when: "", changed: "" }] });
  }
  const rank = ({ title }) => (title.startsWith(here.storage) ? 0 : 1);
  return found.sort((a, b) => rank(a) - rank(b) || b.title.localeCompare(a.title));
}

async function file(model, present) {
  const when = new Date(model.last_modified).toLocaleString();
  const changed = present && model.type === "notebook" ? await changes(model) : "";
  return { name: model.path, data: contents(model), when, changed };
}

// Text, or the bytes of what is none, as a picture: JupyterLite keeps them in base64.
function contents({ format, content }) {
  if (format === "base64") return Uint8Array.from(atob(content), (byte) => byte.charCodeAt(0));
  return typeof content === "string" ? content : JSON.stringify(content, null, 1);
}

// How many cells are not as the book has them.
async function changes(model) {
  const answer = await fetch(`files/${model.path}`).catch(() => null);
  if (!answer?.ok) return "yours";
  const sources = ({ cells }) => new Map(cells.map(({ id, source }) => [id, [source].flat().join("")]));
  const [book, own] = [sources(await answer.json()), sources(model.content)];
  const count = [...own].filter(([id, source]) => book.get(id) !== source).length;
  return count ? `${count} cell${count > 1 ? "s" : ""} changed` : "run, not changed";
}

function shown({ title, files }) {
  const rows = files.map(({ name, data, when, changed }) => row(
    text("td", name), text("td", changed), text("td", when),
    make("td", {}, button("Download", `Download ${name}`, () => save(data, name))),
  ));
  const head = row(...["File", "Changes", "Last saved", ""].map((name) => text("th", name)));
  const named = Object.fromEntries(files.map(({ name, data }) => [name, data]));
  const all = () => save(zip(named), `${title}.zip`);
  return [
    text("h2", title), make("table", {}, head, ...rows),
    make("p", {}, button("Download all", `Download all of ${title}`, all)),
  ];
}

function save(data, name) {
  download(name.split("/").pop().replaceAll(":", ""), "application/octet-stream", data);
}

function text(tag, words) {
  return make(tag, {}, words);
}

function row(...cells) {
  return make("tr", {}, ...cells);
}

function button(words, name, action) {
  const made = text("button", words);
  made.ariaLabel = name;
  made.onclick = action;
  return made;
}
