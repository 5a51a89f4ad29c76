// A panel or scene comes alive in the place of its still.

import { show } from "./controls.js";
import { download, make } from "./elements.js";
import { Conversation } from "./models.js";
import { ask, onStop, stop } from "./python.js";

const SLOW = 300; // ms after which it is said that Python computes
const openings = new Map(); // figure -> the values in the chapter

// Make a figure live, with the values that it has now: where it stood when Python was stopped.
export async function begin(figure, offered) {
  const now = JSON.parse(figure.dataset.values);
  if (!openings.has(figure)) openings.set(figure, now);
  const words = make("span", { role: "status" }, "Waiting for Python …");
  const waiting = make("div", { className: "in-place-waiting" }, words,
    make("button", { type: "button", onclick: () => stop() }, "Stop"));
  offered.append(waiting);
  try {
    const opened = await ask(
      "panels.open", [figure.dataset.panel, openings.get(figure), now, devicePixelRatio],
      { onProgress: (says) => (words.textContent = `${says} …`) },
    );
    new Panel(figure, offered, opened);
  } finally {
    waiting.remove();
  }
}

class Panel {
  #ends = [];

  constructor(figure, offered, opened) {
    this.figure = figure;
    this.offered = offered;
    this.conversation = new Conversation(opened, {
      onBusy: (busy) => this.#busy(busy),
      onNews: ({ values }) => (figure.dataset.values = JSON.stringify(values)),
      onTrouble: (error) => this.#trouble(error),
    });
    this.status = make("span", { className: "in-place-status", role: "status" });
    this.root = make("div", { className: "in-place-live", role: "group", tabIndex: -1 });
    this.root.setAttribute("aria-label", opened.title);
    const save = make("button", { type: "button", onclick: () => this.#save() },
      "Save the picture");
    const end = make("button", { type: "button", title: "End Python on this page",
      onclick: () => stop() }, "Stop");
    this.root.append(
      show(this.conversation.root, this.#ends),
      make("div", { className: "in-place-tools" }, save, end, this.status),
    );
    figure.dataset.values = JSON.stringify(opened.values);
    figure.classList.add("in-place-is-live");
    figure.append(this.root);
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

  async #save() {
    try {
      const picture = await ask("panels.picture", [this.conversation.number]);
      download(`${this.figure.dataset.panel}.svg`, "image/svg+xml", picture);
    } catch (error) {
      this.#trouble(error);
    }
  }

  #trouble(error) {
    if (!this.root.isConnected) return; // its end has been told
    this.#say(error.message);
    if (error.trace) console.info(error.trace);
  }

  // Python has ended: the still comes back, and says why.
  #end(trouble) {
    this.conversation.end();
    clearTimeout(this.slow);
    for (const end of this.#ends) end();
    const focused = this.root.contains(document.activeElement);
    this.root.remove();
    this.figure.classList.remove("in-place-is-live");
    this.offered.querySelector(".in-place-note").textContent = trouble.message;
    if (focused) this.offered.querySelector("button").focus({ preventScroll: true });
  }
}
