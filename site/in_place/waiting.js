// What a reader sees while Python comes or works: what is done, how much of how much, and Stop.

import { make } from "./elements.js";
import { stop } from "./python.js";

const MEGABYTE = 1e6;

export class Progress {
  #words = make("span", { role: "status" });
  // Apart from the words, which a screen reader reads out when they change.
  #amount = make("span", { className: "in-place-amount", ariaHidden: "true" });
  #bar = make("progress", { ariaLabel: "Fetched", hidden: true });
  parts = [this.#words, this.#amount, this.#bar];

  say(words) {
    if (this.#words.textContent !== words) this.#words.textContent = words;
  }

  // To be handed to `ask` as its onProgress.
  show = ({ says, loaded, total }) => {
    const fetching = loaded < total;
    const megabytes = (bytes) => Math.round(bytes / MEGABYTE);
    this.say(`${says} …`);
    this.#amount.textContent = fetching ? ` ${megabytes(loaded)} of ${megabytes(total)} MB ` : "";
    this.#bar.hidden = !fetching;
    Object.assign(this.#bar, { max: total || 1, value: loaded });
  };

  end() {
    this.#amount.textContent = "";
    this.#bar.hidden = true;
  }
}

export class Waiting {
  #progress = new Progress();
  show = this.#progress.show;
  root = make("div", { className: "in-place-waiting" }, ...this.#progress.parts,
    make("button", { type: "button", onclick: () => stop() }, "Stop"));

  constructor() {
    this.#progress.say("Waiting for Python …");
  }
}
