// A panel or scene comes alive in the place of its still, and its state stands in the address.

import { linkTo } from "./address.js";
import { show } from "./controls.js";
import { download, make } from "./elements.js";
import { Conversation } from "./models.js";
import { ask, onStop, stop } from "./python.js";
import { Waiting } from "./waiting.js";

const SLOW = 300; // ms after which it is said that Python computes
const live = new Map(); // figure -> Panel
const opening = new Map(); // figure -> promise that it is, while Python opens it
const openings = new Map(); // figure -> the values in the chapter

// Make a figure live, or move it if it is, or will be soon; `link` has values as text.
export async function begin(figure, offered, link) {
  if (!live.has(figure) && !opening.has(figure)) {
    // Kept before it is awaited, or a second link would open a second panel in the figure.
    const opened = open(figure, offered, link);
    opening.set(figure, opened);
    try {
      await opened;
    } finally {
      opening.delete(figure);
    }
    return;
  }
  await opening.get(figure);
  if (link) live.get(figure)?.conversation.goTo(link);
}

async function open(figure, offered, link) {
  if (!openings.has(figure)) openings.set(figure, JSON.parse(figure.dataset.values));
  // Where it stood when Python was stopped, or where a link wants it.
  const now = JSON.parse(figure.dataset.values);
  const values = openings.get(figure);
  const moved = Object.keys(values).some((name) => values[name] !== now[name]);
  const from = link ?? (figure.dataset.link ? JSON.parse(figure.dataset.link) : null);
  delete figure.dataset.link;
  const waiting = new Waiting();
  offered.append(waiting.root);
  try {
    const opened = await ask(
      "panels.open",
      [figure.dataset.panel, values, from ?? (moved ? asText(now) : null), devicePixelRatio],
      { onProgress: waiting.show },
    );
    live.set(figure, new Panel(figure, offered, opened));
  } finally {
    waiting.root.remove();
  }
}

const asText = (values) =>
  Object.fromEntries(Object.entries(values).map(([name, value]) => [name, String(value)]));

class Panel {
  #ends = [];

  constructor(figure, offered, opened) {
    this.figure = figure;
    this.offered = offered;
    this.conversation = new Conversation(opened, {
      onBusy: (busy) => this.#busy(busy),
      onNews: ({ values }) => this.#news(values),
      onTrouble: (error) => this.#trouble(error),
    });
    this.status = make("span", { className: "in-place-status", role: "status" });
    this.root = make("div", { className: "in-place-live", role: "group", tabIndex: -1 });
    this.root.setAttribute("aria-label", opened.title);
    const copy = make("button", { type: "button", onclick: () => this.#copy() },
      "Copy a link to this state");
    const save = make("button", { type: "button", onclick: () => this.#save() },
      "Save the picture");
    const end = make("button", { type: "button", title: "End Python on this page",
      onclick: () => stop() }, "Stop");
    this.root.append(
      show(this.conversation.root, this.#ends),
      make("div", { className: "in-place-tools" }, copy, save, end, this.status),
    );
    figure.dataset.values = JSON.stringify(opened.values);
    figure.classList.add("in-place-is-live");
    figure.append(this.root);
    this.#say(opened.refused);
    if (offered.contains(document.activeElement) || document.activeElement === document.body) {
      this.root.focus({ preventScroll: true }); // the button that had it is gone
    }
    this.#ends.push(onStop((trouble) => this.#end(trouble)));
  }

  #say(words) {
    if (this.status.textContent !== words) this.status.textContent = words;
  }

  #busy(busy) {
    this.root.ariaBusy = String(busy);
    clearTimeout(this.slow);
    if (busy) {
      this.slow = setTimeout(() => {
        this.root.classList.add("in-place-busy");
        this.#say("Computing …");
      }, SLOW);
    } else if (this.root.classList.contains("in-place-busy")) {
      this.root.classList.remove("in-place-busy");
      this.#say("");
    }
  }

  #news(values) {
    this.figure.dataset.values = JSON.stringify(values);
    clearTimeout(this.later);
    // Browsers take few new addresses a second, and the reader none while dragging.
    this.later = setTimeout(() => history.replaceState(null, "", linkTo(this.figure)), 400);
  }

  async #copy() {
    const link = linkTo(this.figure);
    history.replaceState(null, "", link);
    try {
      await navigator.clipboard.writeText(link);
      this.#say("The link is copied. Who follows it sees the panel as it stands now.");
    } catch {
      this.#say("This page may not copy. Its address, above, is the link now: copy it from there.");
    }
  }

  async #save() {
    try {
      const picture = await ask("panels.picture", [this.conversation.number]);
      download(`${this.figure.dataset.panel}.svg`, "image/svg+xml", picture);
    } catch (error) {
      this.#trouble(error);
    }
  }

  #trouble(error) {
    if (live.get(this.figure) !== this) return; // its end has been told
    this.#say(error.message);
    if (error.trace) console.info(error.trace);
  }

  // Python has ended: the still comes back, and says why.
  #end(trouble) {
    live.delete(this.figure);
    this.conversation.end();
    clearTimeout(this.slow);
    clearTimeout(this.later);
    for (const end of this.#ends) end();
    const focused = this.root.contains(document.activeElement);
    this.root.remove();
    this.figure.classList.remove("in-place-is-live");
    this.offered.querySelector(".in-place-note").textContent = trouble.message;
    if (focused) this.offered.querySelector("button").focus({ preventScroll: true });
  }
}
